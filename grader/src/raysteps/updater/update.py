"""Brings the kit's files up to date and leaves alone what the student wrote.

All that may stand in the way is looked for before the first file is written. Each file is replaced in one go, and the
list of files last of all: an update that was interrupted is finished by calling it again.
"""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import Enum, auto
from pathlib import Path

from raysteps.common.errors import UsageError, reason_and_place
from raysteps.common.files import content_hash
from raysteps.updater import repository as unfinished
from raysteps.updater.release_list import PLACE, ListedFile, Release
from raysteps.updater.repository import Repository
from raysteps.updater.source import Source

# What becomes of a file when a newer kit is taken in.

# A student may want these otherwise, and no step needs them: editors, git and the workflow, and the page that GitHub
# shows first.
_SETTINGS = (".vscode/", ".github/", ".devcontainer/", ".gitignore", ".gitattributes", ".editorconfig", ".clang-format",
             "README.md")  # fmt: skip


class Action(Enum):
    """What to do with one path."""

    NOTHING = auto()
    ADD = auto()
    REPLACE = auto()
    SET_ASIDE_AND_REPLACE = auto()
    LEAVE = auto()  # what lies there is the student's
    REMOVE = auto()
    SET_ASIDE_AND_REMOVE = auto()


@dataclass(frozen=True)
class FileState:
    """What lies at a path of the repository. Nobody looks behind a link."""

    data: bytes | None
    is_link: bool = False


class KnownVersions:
    """What a repository got so far: by the release that was taken in last, and by updates that were interrupted."""

    def __init__(self, old: Release, begun: Iterable[Release]) -> None:
        self._old = old.by_path()
        self._all = [*old.files, *(file for release in begun for file in release.files)]
        self._marks = {(file.path, file.mark) for file in self._all}
        self._students = {file.path for file in self._all if file.owner == "student"}

    @property
    def paths(self) -> set[str]:
        return {file.path for file in self._all}

    def old(self, path: str) -> ListedFile | None:
        return self._old.get(path)

    def is_students(self, path: str, new: ListedFile | None) -> bool:
        """Once the student's, always the student's."""
        return path in self._students or (new is not None and new.owner == "student")

    def _is_own_setting(self, path: str, new: ListedFile | None) -> bool:
        """Nothing new from the kit: then what the student made of it stays."""
        old = self._old.get(path)
        same = new is None or (old is not None and old.mark == new.mark)
        return same and path.startswith(_SETTINGS)

    def decide(self, path: str, new: ListedFile | None, found: FileState) -> Action:
        """`new` is None where the newer kit does not have the file."""
        if found.is_link:
            return Action.LEAVE  # only a student's own file may be one
        if found.data is None:
            return Action.NOTHING if new is None or self._is_own_setting(path, new) else Action.ADD
        now = content_hash(found.data)
        if new is not None and now == new.mark:
            return Action.NOTHING
        if (path, now) in self._marks:
            return Action.REMOVE if new is None else Action.REPLACE
        if self.is_students(path, new) or self._is_own_setting(path, new):
            return Action.LEAVE
        return Action.SET_ASIDE_AND_REMOVE if new is None else Action.SET_ASIDE_AND_REPLACE


_QUIET = (Action.NOTHING, Action.LEAVE)
_UNFINISHED = f"{unfinished.FOLDER}/list.json"  # stands for all that may lie there


@dataclass
class Changes:
    """What was done, by path."""

    replaced: list[str] = field(default_factory=list)
    added: list[str] = field(default_factory=list)
    removed: list[str] = field(default_factory=list)
    kept: list[str] = field(default_factory=list)  # what a file of the kit had become, under a new name
    outdated: list[str] = field(default_factory=list)  # the same, of files that the kit no longer has
    put_back: list[str] = field(default_factory=list)  # stubs of steps whose file was gone
    left: list[str] = field(default_factory=list)  # the student's, and the kit no longer has it
    stubs: list[str] = field(default_factory=list)  # steps that were begun, and whose stub is another one now
    met: list[str] = field(default_factory=list)  # the student's, where the kit has a new step

    @property
    def any(self) -> bool:
        return any((self.replaced, self.added, self.removed, self.kept, self.outdated, self.put_back))


@contextmanager
def _told(what_now: str) -> Iterator[None]:
    """Whatever goes wrong is said together with how things stand now."""
    try:
        yield
    except (UsageError, OSError) as error:
        raise UsageError(f"{reason_and_place(error)}. {what_now}") from error


def _refuse(obstacle: str) -> None:
    if obstacle:
        raise UsageError(obstacle)


class Update:
    """Of one repository, from one release to another."""

    def __init__(self, root: Path, old: Release, source: Source) -> None:
        self._place = Repository(root)
        self._resumed = unfinished.journal_exists(root)
        self._known = KnownVersions(old, unfinished.read_journal(root))
        self._source = source
        self._new = source.release.by_path()
        self._folded = {name.lower(): name for name in self._new}
        self.changes = Changes()

    def _decide(self, name: str) -> Action:
        link = self._place.is_link(name)
        return self._known.decide(name, self._new.get(name), FileState(None if link else self._place.read(name), link))

    def _gone(self) -> list[str]:
        """What the new kit no longer has."""
        dropped = sorted(self._known.paths - set(self._new))
        return [name for name in dropped if not self._is_renamed(name)]

    def _is_renamed(self, name: str) -> bool:
        """In the case of letters only, where that makes no other file."""
        new = self._folded.get(name.lower())
        return new is not None and self._place.is_same(name, new)

    def _look(self) -> bool:
        """Whether there is anything to do. What stands in the way is told while nothing is changed."""
        _refuse(self._place.obstacle(PLACE) or self._place.obstacle(_UNFINISHED))
        wanted = self._place.read(PLACE) != self._source.listing
        for name in [*self._new, *self._gone()]:
            own = self._known.is_students(name, self._new.get(name))
            _refuse(self._place.obstacle(name, may_be_link=own))
            if self._decide(name) not in _QUIET:
                _refuse(self._place.lock_out(name))
                wanted = True
        if wanted:
            _refuse(self._place.lock_out(PLACE))
        return wanted

    def _take(self, file: ListedFile, data: bytes) -> None:
        name, old, done = file.path, self._known.old(file.path), self.changes
        match self._decide(name):  # once more: the student may have saved a file meanwhile
            case Action.NOTHING:
                return
            case Action.LEAVE:
                if self._known.is_students(name, file) and (old is None or old.mark != file.mark):
                    (done.met if old is None else done.stubs).append(name)
                return
            case Action.ADD:
                own = old is not None and old.owner == "student"
                (done.put_back if own else done.added).append(name)
            case Action.SET_ASIDE_AND_REPLACE:
                done.kept.append(self._place.set_aside(name, self._place.read(name) or b""))
                done.replaced.append(name)
            case _:
                done.replaced.append(name)
        self._place.write(name, data, executable=file.executable)

    def _drop(self, name: str) -> None:
        match self._decide(name):
            case Action.LEAVE:
                self.changes.left.append(name)
            case Action.SET_ASIDE_AND_REMOVE:
                self.changes.outdated.append(self._place.set_aside(name, self._place.read(name) or b""))
                self._place.remove(name)
            case Action.REMOVE:
                self._place.remove(name)
                self.changes.removed.append(name)
            case _:
                return

    def run(self) -> Changes:
        """Reads all of the new kit before the first file is written."""
        with _told("Nothing was changed"):
            data = {name: self._source.data(file) for name, file in self._new.items()}
            wanted = self._look()
        with _told("Your work is as it was. Mend that, then call update again: it goes on where it stopped"):
            if wanted:
                unfinished.begin_journal(self._place.root, self._place.read(PLACE) or b"", self._source.listing)
            for name, file in self._new.items():
                self._take(file, data[name])
            for name in self._gone():
                self._drop(name)
            if wanted:
                self._place.write(PLACE, self._source.listing)
            self._clear()
        return self.changes

    def _clear(self) -> None:
        """What an update that was interrupted had begun to write, and whatever it set aside and could not tell."""
        paths = {*self._new, *self._known.paths}
        self._place.forget_unfinished({*paths, PLACE})
        for name in self._gone():
            self._place.prune(name)
        unfinished.end_journal(self._place.root)
        for name in sorted(paths) if self._resumed else ():
            if not self._known.is_students(name, self._new.get(name)):
                told = self.changes.kept if name in self._new else self.changes.outdated
                told += [kept for kept in self._place.aside(name) if kept not in told]
