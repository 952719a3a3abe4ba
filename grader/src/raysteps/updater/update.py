"""Brings the kit's files up to date and leaves alone what the student wrote.

All that may stand in the way is looked for before the first file is written. Each file is replaced in one go, and the
list of files last of all: an update that was interrupted is finished by calling it again.
"""

import os
import re
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import Enum, auto
from pathlib import Path

from raysteps.common.errors import UsageError, reason_and_place
from raysteps.common.files import content_hash, write_bytes
from raysteps.updater.release_list import PLACE, ListedFile, Release, parse
from raysteps.updater.source import Source

# The student's folder: how a file of the kit is looked at, replaced, set aside and taken away there.

_ENDING = ".raysteps-update"  # of what is not written to its end yet; no student names a file so


def _is_link(path: Path) -> bool:
    """Or what Windows has for one; Python knows that since 3.12."""
    return path.is_symlink() or bool(getattr(path, "is_junction", bool)())


def _is_there(path: Path) -> bool:
    return path.exists() or path.is_symlink()


class Repository:
    """Files are named by their path from the root, with /."""

    def __init__(self, root: Path) -> None:
        self.root = root

    def path(self, name: str) -> Path:
        return self.root / name

    def is_link(self, name: str) -> bool:
        return _is_link(self.path(name))

    def read(self, name: str) -> bytes | None:
        """None where there is nothing."""
        path = self.path(name)
        return path.read_bytes() if path.is_file() else None

    def obstacle(self, name: str, *, may_be_link: bool = False) -> str:
        """Why the kit's file cannot be put or taken there; nothing when it can. A link might lead out of the
        repository."""
        path = self.path(name)
        folders = [folder for folder in reversed(path.parents) if folder.is_relative_to(self.root)]
        for folder in folders:
            if folder != self.root and _is_link(folder):
                return f"{folder}: is a link; expected a folder of the kit. Put a copy of what it leads to in its place"
            if _is_there(folder) and not folder.is_dir():
                return f"{folder}: is a file; expected a folder of the kit. Give your file another name"
        if _is_link(path):
            return "" if may_be_link else f"{path}: is a link; expected a file of the kit. Give the link another name"
        if _is_there(path) and not path.is_file():
            return f"{path}: is a folder; expected a file of the kit. Give your folder another name"
        return ""

    def lock_out(self, name: str) -> str:
        """Why nothing can be written there; nothing when something can."""
        folder = next(folder for folder in self.path(name).parents if folder.is_dir())
        return "" if os.access(folder, os.W_OK) else f"{folder}: cannot be written to; allow that first"

    def write(self, name: str, data: bytes, *, executable: bool = False) -> None:
        """In one go."""
        self._allow(name)
        write_bytes(self.path(name), data, mode=0o755 if executable else 0o644, ending=_ENDING)

    def _allow(self, name: str) -> None:
        """On Windows a file that may only be read can be neither replaced nor removed."""
        path = self.path(name)
        if path.is_file() and not path.stat().st_mode & stat.S_IWRITE:
            path.chmod(0o644)

    def set_aside(self, name: str, data: bytes) -> str:
        """Under a free name, or the one that holds just this already."""
        for number in range(1, 1000):
            kept = f"{name}.mine{number if number > 1 else ''}"
            if not _is_there(self.path(kept)):
                self.write(kept, data)
                return kept
            if not self.is_link(kept) and self.read(kept) == data:
                return kept
        raise UsageError(f"{self.path(name)}.mine: there are too many of them; take some away")

    def aside(self, name: str) -> list[str]:
        """What was set aside of it, whenever that was."""
        found = [path.name for path in self.path(name).parent.glob(f"{self.path(name).name}.mine*")]
        folder = name[: name.rfind("/") + 1]
        return sorted(folder + kept for kept in found if re.fullmatch(r".*\.mine\d*", kept))

    def remove(self, name: str) -> None:
        self._allow(name)
        self.path(name).unlink()

    def prune(self, name: str) -> None:
        """Takes away the folders of a file that is gone, where they are empty."""
        for folder in self.path(name).parents:
            if folder == self.root or (folder.is_dir() and any(folder.iterdir())):
                return
            if folder.is_dir():
                folder.rmdir()

    def is_same(self, name: str, other: str) -> bool:
        """As where names that differ in case only are one file."""
        try:
            return self.path(name).samefile(self.path(other))
        except OSError:
            return False

    def forget_unfinished(self, names: set[str]) -> None:
        """What an update that was killed had begun to write for these."""
        for name in names:
            path = self.path(name)
            for begun in path.parent.glob(f".{path.name}.*{_ENDING}"):
                begun.unlink(missing_ok=True)


# The lists of releases of an update that was interrupted: what it wrote until then is no student's.

_JOURNAL = ".raysteps/unfinished"


def _begin_journal(root: Path, *lists: bytes) -> None:
    """Before the first file is written: the list that was there, which goes, and the one that comes."""
    for data in lists:
        write_bytes(root / _JOURNAL / f"{content_hash(data)[:16]}.json", data)


def _journal_exists(root: Path) -> bool:
    """Whether an update was interrupted."""
    return (root / _JOURNAL).is_dir()


def _read_journal(root: Path) -> list[Release]:
    """Those of an update that did not come to its end. One that cannot be read says nothing: then a file that it wrote
    counts as the student's, which loses nothing."""
    found = []
    for path in sorted((root / _JOURNAL).glob("*.json")):
        try:
            found.append(parse(path.read_bytes(), str(path)))
        except (OSError, UsageError):
            continue
    return found


def _end_journal(root: Path) -> None:
    """After the last file is written."""
    folder = root / _JOURNAL
    if _journal_exists(root):
        for path in [*folder.glob("*.json"), *folder.glob(".*.json.*")]:
            path.unlink()
        if not any(folder.iterdir()):
            folder.rmdir()


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
_UNFINISHED = f"{_JOURNAL}/list.json"  # stands for all that may lie there


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
        self._resumed = _journal_exists(root)
        self._known = KnownVersions(old, _read_journal(root))
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
                _begin_journal(self._place.root, self._place.read(PLACE) or b"", self._source.listing)
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
        _end_journal(self._place.root)
        for name in sorted(paths) if self._resumed else ():
            if not self._known.is_students(name, self._new.get(name)):
                told = self.changes.kept if name in self._new else self.changes.outdated
                told += [kept for kept in self._place.aside(name) if kept not in told]
