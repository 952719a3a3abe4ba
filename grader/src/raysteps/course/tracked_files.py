"""Which files of the kit git knows; without git, all that lie there."""

from collections.abc import Iterable
from pathlib import Path, PurePosixPath

from raysteps.common.process import run

_SECONDS = 60
_MAX_OUTPUT = 16 << 20


def _listed(root: Path, *which: str) -> list[PurePosixPath] | None:
    if not (root / ".git").exists():
        return None
    command: list[str | Path] = ["git", "-C", root, "ls-files", "-z", "--exclude-standard", *which]
    try:
        outcome = run(command, seconds=_SECONDS, cap=_MAX_OUTPUT)
    except OSError:
        return None
    if outcome.code != 0:
        return None
    return [PurePosixPath(name) for name in outcome.stdout.split("\0") if name]


def list_files(root: Path, folders: Iterable[str] = (".",)) -> list[PurePosixPath]:
    """What git tracks, and new files that it does not ignore; without git, files and folders in these folders."""
    listed = _listed(root, "--cached", "--others")
    if listed is not None:
        return listed
    found = [path for folder in folders for path in (root / folder).rglob("*")]
    return [PurePosixPath(path.relative_to(root).as_posix()) for path in found]


def untracked_files(root: Path) -> set[str]:
    """New files that git does not ignore; none where there is no git."""
    return {place.as_posix() for place in _listed(root, "--others") or ()}
