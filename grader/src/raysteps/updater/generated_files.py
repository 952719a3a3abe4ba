"""What setting up and trying a kit makes in its folder: no part of a release, and none of a student's own files."""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

FOLDERS = (".venv", "build")  # in the root
CACHE = "__pycache__"
HISTORY = ".git"


@dataclass(frozen=True)
class Place:
    """A path, how it is called from the root of the kit, and whether it is a folder that was made."""

    path: Path
    name: str
    made: bool


def is_made_anew(name: str) -> bool:
    """What Python makes wherever there is a package, and makes again when it is gone."""
    return any(part == CACHE or part.endswith(".egg-info") for part in PurePosixPath(name).parts)


def all_places(folder: Path, unreadable: Callable[[OSError], None] | None = None) -> Iterator[Place]:
    """Files and folders, but not the history. Nobody goes into a folder that was made; one that cannot be read is
    passed over, or told to `unreadable`."""
    for root, names, files in os.walk(folder, onerror=unreadable):
        for last in sorted([*names, *files]):
            path = Path(root, last)
            name = path.relative_to(folder).as_posix()
            made = (name in FOLDERS or is_made_anew(name)) and path.is_dir() and not path.is_symlink()
            if last in names and (made or name == HISTORY):
                names.remove(last)
            if name != HISTORY:
                yield Place(path, name, made)
