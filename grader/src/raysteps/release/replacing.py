"""Puts a new release in the place of an older one, and loses nothing that is of neither."""

import glob
import shutil
import tempfile
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.students.listing import PLACE, Listed, read_release
from raysteps.students.set_up import FOLDERS, HISTORY, is_made_anew

_NOT_OURS = (HISTORY, *FOLDERS)  # may lie in a release that somebody keeps under version control


def _is_as_released(path: Path, listed: Listed) -> bool:
    try:
        return listed.is_at(path)
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror or error}") from error


def usable(out: Path) -> None:
    """Nothing but a release as it was written may be replaced."""
    if not out.exists() or (out.is_dir() and not any(out.iterdir())):
        return
    if not out.is_dir():
        raise UsageError(f"{out}: is a file; expected a new or empty folder, or an earlier release")
    old = read_release(out)
    if old is None:
        raise UsageError(f"{out}: is not empty; expected a new or empty folder, or an earlier release")
    known = old.by_path()
    for path in sorted(out.rglob("*")):
        name = path.relative_to(out).as_posix()
        if name.split("/")[0] in _NOT_OURS or name == PLACE or (path.is_dir() and not path.is_symlink()):
            continue
        if name not in known and is_made_anew(name):
            continue
        if name not in known or not _is_as_released(path, known[name]):
            what = "is not of the release" if name not in known else "is not as it was released"
            raise UsageError(f"{path}: {what} and would be lost; take it away, or name another folder with --out")


def refuse_left_overs(out: Path) -> None:
    """Of a release that was interrupted while it took the place of an older one."""
    found = sorted(out.parent.glob(f".{glob.escape(out.name)}-old-*"))
    if found:
        raise UsageError(
            f"{found[0]}: holds what was in {out} before a release that was interrupted; move what you need (a history "
            "in .git) back, and delete the rest"
        )


def _move_along(old: Path, new: Path) -> None:
    for name in _NOT_OURS:
        if (old / name).exists():
            (old / name).rename(new / name)


def swap(new: Path, out: Path) -> None:
    """What is not of the release, such as its history, moves along."""
    if not out.exists():
        new.rename(out)
        return
    old = Path(tempfile.mkdtemp(prefix=f".{out.name}-old-", dir=out.parent)) / out.name
    out.rename(old)
    try:
        new.rename(out)
    except OSError:
        old.rename(out)
        old.parent.rmdir()
        raise
    _move_along(old, out)
    try:
        usable(old)
    except UsageError as error:
        raise UsageError(
            f"{out}: was released, but the older one was changed meanwhile and is kept: {error}"
        ) from error
    shutil.rmtree(old.parent)
