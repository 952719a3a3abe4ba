"""Where file events cannot be trusted: on mounts that somebody else may write to."""

import os
import re
from collections.abc import Mapping
from pathlib import Path

_MOUNTS = Path("/proc/self/mountinfo")
# Network file systems, shares of virtual machines, and Windows' own disks as Linux sees them.
_SHARED = re.compile(
    r"nfs\d?|cifs|smb\d?|smbfs|9p|drvfs|afs|ncpfs|vboxsf|vmhgfs|prl_fs|virtiofs|fakeowner|fuse\.(?!fuseblk|ext|ntfs).*"
)
_OFF = {"", "0", "false", "no", "off"}


def _unescaped(text: str) -> str:
    return re.sub(r"\\([0-7]{3})", lambda found: chr(int(found[1], 8)), text)


def kind_of(path: Path, mounts: Path = _MOUNTS) -> str:
    """The type of the file system that holds the path, or nothing where that cannot be told."""
    best, kind = -1, ""
    place = path.resolve()
    try:
        lines = mounts.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    for line in lines:
        fields, _, rest = line.partition(" - ")
        words, types = fields.split(), rest.split()
        if len(words) < 5 or not types:
            continue
        mount = Path(_unescaped(words[4]))
        if place.is_relative_to(mount) and len(mount.parts) >= best:  # a later mount hides an earlier one
            best, kind = len(mount.parts), types[0]
    return kind


def why_poll(path: Path, environment: Mapping[str, str] = os.environ, mounts: Path = _MOUNTS) -> str:
    """Why files there are polled, or nothing where events can be trusted."""
    for name in ("RAYSTEPS_POLL", "WATCHFILES_FORCE_POLLING"):
        if name in environment:
            return f"{name} is set" if environment[name].strip().lower() not in _OFF else ""
    kind = kind_of(path, mounts)
    return f"the files are on {kind}, where saves may raise no event" if _SHARED.fullmatch(kind) else ""
