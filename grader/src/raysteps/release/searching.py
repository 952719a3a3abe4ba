"""Which files of a folder are searched for leaks, and what is left out."""

from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.text import count, listed
from raysteps.students.set_up import CACHE, HISTORY, all_places


def _refuse(error: OSError) -> None:
    raise UsageError(f"{error.filename}: cannot be looked through: {error.strerror or error}") from error


def to_search(folder: Path, *, tried: bool) -> list[Path]:
    """All files and folders but the history; where the kit was set up and tried, without what that makes."""
    if not tried:
        return sorted(path for path in folder.rglob("*") if path.relative_to(folder).parts[0] != HISTORY)
    return sorted(place.path for place in all_places(folder, _refuse) if not place.made)


def not_searched(folder: Path) -> str:
    """The folders that `to_search` leaves out, in words; nothing where there are none."""
    made = sorted(place.name for place in all_places(folder) if place.made)
    caches = [name for name in made if name.rpartition("/")[2] == CACHE]
    named = [name for name in made if name not in caches]
    if len(caches) > 1:
        caches = [f"{count(len(caches), 'folder')} {CACHE}"]
    return listed([*named, *caches]) if made else ""
