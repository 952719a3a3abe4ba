"""Brings the kit's files up to date and leaves alone what the student wrote.

Each file is replaced in one go, and the list of files last of all: an update that was interrupted is finished by
calling it again."""

from dataclasses import dataclass, field
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.files import write_bytes
from raysteps.students.listing import PLACE, Listed, Release, encoded, mark
from raysteps.students.source import Source


@dataclass
class Changes:
    """What was done, by path."""

    replaced: list[str] = field(default_factory=list)
    added: list[str] = field(default_factory=list)
    removed: list[str] = field(default_factory=list)
    kept: list[str] = field(default_factory=list)  # the student's own version of a file of the kit, under a new name
    left: list[str] = field(default_factory=list)  # the kit no longer has it, but the student changed it
    stubs: list[str] = field(default_factory=list)  # steps that were begun, and whose stub is another one now

    @property
    def any(self) -> bool:
        return any((self.replaced, self.added, self.removed, self.kept, self.left))


def _own_name(path: Path, data: bytes) -> Path:
    """A free name, or the one that holds just this already."""
    names = [f"{path.name}.mine", *(f"{path.name}.mine{number}" for number in range(2, 1000))]
    for name in names:
        kept = path.with_name(name)
        if not kept.exists() or (kept.is_file() and kept.read_bytes() == data):
            return kept
    raise UsageError(f"{path}.mine: there are too many of them; take some away")


class Update:
    """Of one repository, from one release to another."""

    def __init__(self, root: Path, old: Release, source: Source) -> None:
        self._root = root
        self._old = old.by_path()
        self._source = source
        self.changes = Changes()

    def _path(self, file: Listed) -> Path:
        """Not by way of a link: that might lead out of the repository."""
        path = self._root / file.path
        for part in (path, *path.parents):
            if part == self._root:
                return path
            if part.is_symlink():
                raise UsageError(f"{part}: is a link; expected a file or a folder of the kit. Take it away first")
        return path

    def _write(self, file: Listed, data: bytes) -> None:
        path = self._path(file)
        write_bytes(path, data)
        path.chmod(0o755 if file.executable else 0o644)

    def _keep(self, path: Path, data: bytes) -> None:
        kept = _own_name(path, data)
        write_bytes(kept, data)
        self.changes.kept.append(kept.relative_to(self._root).as_posix())

    def _take(self, file: Listed, data: bytes) -> None:
        path, old = self._path(file), self._old.get(file.path)
        if path.is_dir():
            raise UsageError(f"{path}: is a folder; expected a file of the kit. Take it away first")
        if not path.exists():
            self._write(file, data)
            self.changes.added.append(file.path)
            return
        mine = path.read_bytes()
        if mark(mine) == file.mark:
            return
        untouched = old is not None and mark(mine) == old.mark
        if file.owner == "student" and not untouched:
            if old is None or old.mark != file.mark:
                self.changes.stubs.append(file.path)
            return
        if not untouched:
            self._keep(path, mine)
        self._write(file, data)
        self.changes.replaced.append(file.path)

    def _drop(self, file: Listed) -> None:
        """A file that the new kit does not have."""
        path = self._path(file)
        if not path.is_file():
            return
        if file.owner == "student" or mark(path.read_bytes()) != file.mark:
            self.changes.left.append(file.path)
            return
        path.unlink()
        self.changes.removed.append(file.path)

    def run(self) -> Changes:
        """Reads all of the new kit before the first file is written."""
        new = self._source.release
        data = {file.path: self._source.data(file) for file in new.files}
        for file in new.files:
            self._path(file)
        for file in new.files:
            self._take(file, data[file.path])
        known = new.by_path()
        for file in self._old.values():
            if file.path not in known:
                self._drop(file)
        write_bytes(self._root / PLACE, encoded(new))
        return self.changes
