"""Reads a submission that is a folder. No link is followed, at no depth, even when the folder changes meanwhile."""

import os
import stat
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

from raysteps.common.errors import reason
from raysteps.submission import entries
from raysteps.submission.entries import FileEntry, RejectedFile, check_size, is_out_of_sight, not_a_file, split

# Without O_NONBLOCK, opening a pipe that nobody writes to would wait for ever.
_FILE = sum(getattr(os, name, 0) for name in ("O_RDONLY", "O_NOFOLLOW", "O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC"))
_FOLDER = sum(getattr(os, name, 0) for name in ("O_RDONLY", "O_NOFOLLOW", "O_DIRECTORY", "O_CLOEXEC"))

_NOT_READ, _NOT_FOLLOWED = "cannot be read", "is a link and was not followed"


def _leads_out(root: Path, path: tuple[str, ...]) -> bool:
    """Whether a link leads out of the submission: what is inside is read where it lies."""
    return not Path(os.path.realpath(root.joinpath(*path))).is_relative_to(os.path.realpath(root))


def what_is(mode: int) -> str:
    """What somebody gave in place of a file."""
    names: dict[Callable[[int], bool], str] = {
        stat.S_ISLNK: "a link",
        stat.S_ISDIR: "a folder",
        stat.S_ISFIFO: "a pipe",
        stat.S_ISSOCK: "a socket",
    }
    return next((name for is_kind, name in names.items() if is_kind(mode)), "a device")


def _read(folder: int, name: str) -> bytes:
    try:
        handle = os.open(name, _FILE, dir_fd=folder)
    except OSError as error:
        raise RejectedFile(f"cannot be read ({reason(error)}) and was not taken.") from error
    with os.fdopen(handle, "rb") as file:
        status = os.fstat(handle)
        if not stat.S_ISREG(status.st_mode):
            raise RejectedFile(f"is {what_is(status.st_mode)}, not a file, and was not taken.")
        check_size(status.st_size)
        try:
            data = file.read(entries.MAX_SOURCE + 1)
        except OSError as error:
            raise RejectedFile(f"cannot be read ({reason(error)}) and was not taken.") from error
    check_size(len(data))
    return data


class _Reader:
    """The entries of a folder, and the folders below it that could not be looked into."""

    def __init__(self, root: Path) -> None:
        self._root = root
        self._seen = 0
        self.closed: dict[tuple[str, ...], str] = {}  # and why


class FolderReader(_Reader):
    """Opens folders by the handle of the one above, so that none is another one meanwhile."""

    def entries(self) -> Iterator[FileEntry]:
        followed = _FOLDER & ~getattr(os, "O_NOFOLLOW", 0)  # the folder itself was named by whoever grades
        handle = os.open(self._root, followed)
        try:
            yield from self._below(handle, ())
        finally:
            os.close(handle)

    def _names(self, folder: int) -> list[str]:
        names = []
        with os.scandir(folder) as listing:
            for child in listing:
                self._seen += 1
                if self._seen > entries.MAX_ENTRIES:
                    raise entries.too_many(self._root)
                names.append(child.name)
        return sorted(names)

    def _below(self, folder: int, parts: tuple[str, ...]) -> Iterator[FileEntry]:
        for name in self._names(folder):
            inner = split(name)  # a zip with backslashes, unpacked on Linux, leaves them in the names
            if inner is None:
                continue
            path = (*parts, *inner)
            try:
                mode = os.stat(name, dir_fd=folder, follow_symlinks=False).st_mode
            except OSError:
                continue  # it is gone
            if stat.S_ISREG(mode):
                yield FileEntry(path, partial(_read, folder, name))
            else:
                yield FileEntry(path, not_a_file(what_is(mode)))
            if stat.S_ISLNK(mode) and _leads_out(self._root, path):
                self.closed[path] = _NOT_FOLLOWED
            if stat.S_ISDIR(mode) and not is_out_of_sight(path):
                yield from self._into(folder, name, path)

    def _into(self, folder: int, name: str, path: tuple[str, ...]) -> Iterator[FileEntry]:
        try:
            handle = os.open(name, _FOLDER, dir_fd=folder)
        except OSError:
            self.closed[path] = _NOT_READ
            return
        try:
            yield from self._below(handle, path)
        finally:
            os.close(handle)


# Reads a submission that is a folder where folders cannot be opened, as on Windows. Links are left out, too; but
# nothing keeps a folder from being changed meanwhile: it is one's own, there is no sandbox either.


def _read_by_path(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            check_size(os.fstat(file.fileno()).st_size)
            data = file.read(entries.MAX_SOURCE + 1)
    except OSError as error:
        raise RejectedFile(f"cannot be read ({reason(error)}) and was not taken.") from error
    check_size(len(data))
    return data


def _is_link(child: "os.DirEntry[str]") -> bool:
    """A junction is Windows' other kind of link to a folder (known since Python 3.12)."""
    is_junction = getattr(child, "is_junction", None)
    return child.is_symlink() or bool(is_junction is not None and is_junction())


class PlainFolderReader(_Reader):
    """The same where a folder cannot be opened by a handle, as on Windows."""

    def entries(self) -> Iterator[FileEntry]:
        yield from self._below(self._root, ())

    def _children(self, folder: Path) -> list["os.DirEntry[str]"]:
        with os.scandir(folder) as listing:
            children = list(listing)
        self._seen += len(children)
        if self._seen > entries.MAX_ENTRIES:
            raise entries.too_many(self._root)
        return sorted(children, key=lambda child: child.name)

    def _below(self, folder: Path, parts: tuple[str, ...]) -> Iterator[FileEntry]:
        for child in self._children(folder):
            path = (*parts, child.name)
            if _is_link(child):
                if _leads_out(self._root, path):
                    self.closed[path] = _NOT_FOLLOWED
                yield FileEntry(path, not_a_file("a link"))
            elif child.is_file():
                yield FileEntry(path, partial(_read_by_path, Path(child.path)))
            elif child.is_dir():
                yield FileEntry(path, not_a_file("a folder"))
                yield from self._into(Path(child.path), path)

    def _into(self, folder: Path, path: tuple[str, ...]) -> Iterator[FileEntry]:
        if is_out_of_sight(path):
            return
        try:
            yield from self._below(folder, path)
        except PermissionError:
            self.closed[path] = _NOT_READ
