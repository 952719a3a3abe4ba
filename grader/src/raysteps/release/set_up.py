"""What setting up and trying a kit makes in its folder: no part of a release, and too large to be searched."""

import os
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from raysteps.common.errors import UsageError
from raysteps.common.text import count, listed

FOLDERS = (".venv", "build")  # in the root
_CACHE = "__pycache__"


def is_made_anew(place: PurePosixPath) -> bool:
    """What Python makes wherever there is a package, and makes again when it is gone."""
    return any(part == _CACHE or part.endswith(".egg-info") for part in place.parts)


def _is_made(path: Path, place: PurePosixPath) -> bool:
    return (place.as_posix() in FOLDERS or is_made_anew(place)) and path.is_dir() and not path.is_symlink()


def _unreadable(error: OSError) -> None:
    raise UsageError(f"{error.filename}: cannot be looked through: {error.strerror or error}") from error


def _walk(folder: Path) -> Iterator[tuple[Path, PurePosixPath, bool]]:
    """Each path with its place from the root, and whether it is a folder that was made: nobody goes into such a one."""
    for root, names, files in os.walk(folder, onerror=_unreadable):
        for name in sorted([*names, *files]):
            path = Path(root, name)
            place = PurePosixPath(path.relative_to(folder).as_posix())
            made = _is_made(path, place)
            if name in names and (made or place.as_posix() == ".git"):
                names.remove(name)
            if place.as_posix() != ".git":
                yield path, place, made


def to_search(folder: Path) -> list[Path]:
    """All that may be of a release: no history, and nothing that setting up made."""
    return sorted(path for path, _, made in _walk(folder) if not made)


def not_searched(folder: Path) -> str:
    """The folders that `to_search` leaves out, in words; nothing where there are none."""
    made = sorted(place.as_posix() for _, place, made in _walk(folder) if made)
    caches = [name for name in made if name.rpartition("/")[2] == _CACHE]
    named = [name for name in made if name not in caches]
    if len(caches) > 1:
        caches = [f"{count(len(caches), 'folder')} {_CACHE}"]
    return listed([*named, *caches]) if made else ""
