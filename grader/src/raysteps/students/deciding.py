"""What becomes of a file when a newer kit is taken in."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum, auto

from raysteps.common.marks import mark
from raysteps.students.listing import Listed, Release

# A student may want these otherwise, and no step needs them: editors, git and the workflow, and the page that GitHub
# shows first.
_SETTINGS = (".vscode/", ".github/", ".devcontainer/", ".gitignore", ".gitattributes", ".editorconfig", ".clang-format",
             "README.md")  # fmt: skip


class What(Enum):
    """What to do with one path."""

    NOTHING = auto()
    ADD = auto()
    REPLACE = auto()
    SET_ASIDE_AND_REPLACE = auto()
    LEAVE = auto()  # what lies there is the student's
    REMOVE = auto()
    SET_ASIDE_AND_REMOVE = auto()


@dataclass(frozen=True)
class Found:
    """What lies at a path of the repository. Nobody looks behind a link."""

    data: bytes | None
    is_link: bool = False


class Known:
    """What a repository got so far: by the release that was taken in last, and by updates that were interrupted."""

    def __init__(self, old: Release, begun: Iterable[Release]) -> None:
        self._old = old.by_path()
        self._all = [*old.files, *(file for release in begun for file in release.files)]
        self._marks = {(file.path, file.mark) for file in self._all}
        self._students = {file.path for file in self._all if file.owner == "student"}

    @property
    def paths(self) -> set[str]:
        return {file.path for file in self._all}

    def old(self, path: str) -> Listed | None:
        return self._old.get(path)

    def is_students(self, path: str, new: Listed | None) -> bool:
        """Once the student's, always the student's."""
        return path in self._students or (new is not None and new.owner == "student")

    def _is_own_setting(self, path: str, new: Listed | None) -> bool:
        """Nothing new from the kit: then what the student made of it stays."""
        old = self._old.get(path)
        same = new is None or (old is not None and old.mark == new.mark)
        return same and path.startswith(_SETTINGS)

    def decide(self, path: str, new: Listed | None, found: Found) -> What:
        """`new` is None where the newer kit does not have the file."""
        if found.is_link:
            return What.LEAVE  # only a student's own file may be one
        if found.data is None:
            return What.NOTHING if new is None or self._is_own_setting(path, new) else What.ADD
        now = mark(found.data)
        if new is not None and now == new.mark:
            return What.NOTHING
        if (path, now) in self._marks:
            return What.REMOVE if new is None else What.REPLACE
        if self.is_students(path, new) or self._is_own_setting(path, new):
            return What.LEAVE
        return What.SET_ASIDE_AND_REMOVE if new is None else What.SET_ASIDE_AND_REPLACE
