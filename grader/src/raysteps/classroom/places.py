"""The folders and files that a class is graded from, and into."""

import os
from pathlib import Path

from raysteps.classroom.database import FILE, LOCK
from raysteps.common.errors import UsageError


def _inside(path: Path, folder: Path) -> bool:
    return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def check_places(folder: Path, out: Path, *, resume: bool) -> None:
    """Results must not come to lie among the submissions."""
    if not folder.is_dir():
        raise UsageError(f"{folder}: expected a folder with one entry per submission")
    if _inside(out, folder):
        raise UsageError(f"--out {out}: lies in the folder of the submissions; name another folder")
    if _inside(folder, out / "submissions"):
        raise UsageError(f"--out {out}: its results would go into the folder of the submissions")
    # A run that was ended while the kit was built has left nothing but its lock.
    others = [path for path in out.iterdir() if path.name != LOCK] if out.is_dir() else []
    if resume and others and not (out / FILE).is_file():
        raise UsageError(f"--resume: {out} holds no {FILE} to go on from")


def read_text(path: Path) -> str:
    """The late policy."""
    try:
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        why = "is not UTF-8" if isinstance(error, UnicodeDecodeError) else error.strerror
        raise UsageError(f"{path}: the late policy cannot be read: {why}") from error
