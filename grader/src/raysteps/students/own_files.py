"""Which files of a repository are the student's, by what they hold."""

from pathlib import Path

from raysteps.students.listing import PLACE, Listed, Release
from raysteps.students.set_up import all_places


def _is_as_released(path: Path, file: Listed | None) -> bool:
    """What cannot be read is the student's own."""
    try:
        return file is not None and file.is_at(path)
    except OSError:
        return False


def own_files(root: Path, kit: Release) -> list[str]:
    """All that is not as in this kit, steps first."""
    listed = kit.by_path()
    files = [place for place in all_places(root) if place.path.is_symlink() or not place.path.is_dir()]
    found = [it.name for it in files if it.name != PLACE and not _is_as_released(it.path, listed.get(it.name))]
    return sorted(found, key=lambda name: (not name.startswith("steps/"), name))
