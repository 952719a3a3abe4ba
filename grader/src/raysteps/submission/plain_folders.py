"""Reads a submission that is a folder where folders cannot be opened, as on Windows. Links are left out, too; but
nothing keeps a folder from being changed meanwhile: it is one's own, there is no sandbox either."""

import os
from collections.abc import Iterator
from functools import partial
from pathlib import Path

from raysteps.submission import entries
from raysteps.submission.entries import Entry, NotTaken, check_size, is_out_of_sight, not_a_file


def _read(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            check_size(os.fstat(file.fileno()).st_size)
            data = file.read(entries.MAX_SOURCE + 1)
    except OSError as error:
        raise NotTaken(f"cannot be read ({error.strerror}) and was not taken.") from error
    check_size(len(data))
    return data


def _is_link(child: "os.DirEntry[str]") -> bool:
    """A junction is Windows' other kind of link to a folder (known since Python 3.12)."""
    is_junction = getattr(child, "is_junction", None)
    return child.is_symlink() or bool(is_junction is not None and is_junction())


class PlainFolderReader:
    """The entries of a folder, and the folders below it that could not be looked into."""

    def __init__(self, root: Path) -> None:
        self._root = root
        self._seen = 0
        self.closed: list[tuple[str, ...]] = []

    def entries(self) -> Iterator[Entry]:
        yield from self._below(self._root, ())

    def _children(self, folder: Path) -> list["os.DirEntry[str]"]:
        with os.scandir(folder) as listing:
            children = list(listing)
        self._seen += len(children)
        if self._seen > entries.MAX_ENTRIES:
            raise entries.too_many(self._root)
        return sorted(children, key=lambda child: child.name)

    def _below(self, folder: Path, parts: tuple[str, ...]) -> Iterator[Entry]:
        for child in self._children(folder):
            path = (*parts, child.name)
            if _is_link(child):
                yield Entry(path, not_a_file("a link"))
            elif child.is_file():
                yield Entry(path, partial(_read, Path(child.path)))
            elif child.is_dir():
                yield Entry(path, not_a_file("a folder"))
                yield from self._into(Path(child.path), path)

    def _into(self, folder: Path, path: tuple[str, ...]) -> Iterator[Entry]:
        if is_out_of_sight(path):
            return
        try:
            yield from self._below(folder, path)
        except PermissionError:
            self.closed.append(path)
