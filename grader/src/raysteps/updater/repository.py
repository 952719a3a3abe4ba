"""The student's folder: how a file of the kit is looked at, replaced, set aside and taken away there."""

import os
import re
import stat
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.files import content_hash, write_bytes
from raysteps.updater.release_list import Release, parse

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

FOLDER = ".raysteps/unfinished"


def begin_journal(root: Path, *lists: bytes) -> None:
    """Before the first file is written: the list that was there, which goes, and the one that comes."""
    for data in lists:
        write_bytes(root / FOLDER / f"{content_hash(data)[:16]}.json", data)


def journal_exists(root: Path) -> bool:
    """Whether an update was interrupted."""
    return (root / FOLDER).is_dir()


def read_journal(root: Path) -> list[Release]:
    """Those of an update that did not come to its end. One that cannot be read says nothing: then a file that it wrote
    counts as the student's, which loses nothing."""
    found = []
    for path in sorted((root / FOLDER).glob("*.json")):
        try:
            found.append(parse(path.read_bytes(), str(path)))
        except (OSError, UsageError):
            continue
    return found


def end_journal(root: Path) -> None:
    """After the last file is written."""
    folder = root / FOLDER
    if journal_exists(root):
        for path in [*folder.glob("*.json"), *folder.glob(".*.json.*")]:
            path.unlink()
        if not any(folder.iterdir()):
            folder.rmdir()
