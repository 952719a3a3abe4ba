"""Which paths a list of files may hold: each leads to a place of its own, inside the folder, on every system."""

import re
from collections.abc import Iterable, Iterator

_PART = re.compile(r"[A-Za-z0-9._+-]*[A-Za-z0-9_+-]")  # Windows drops a dot at the end; `.` and `..` are no names
_DEVICE = re.compile(r"(?:con|prn|aux|nul|com[0-9]|lpt[0-9])(?:\..*)?", re.IGNORECASE)
_NOT_THE_KITS = (".venv", "build")
_ALLOWED = "expected names of letters, digits and . _ + - only, with / between them"


def _folders(path: str) -> Iterator[str]:
    parts = path.split("/")[:-1]
    return ("/".join(parts[: count + 1]) for count in range(len(parts)))


def _complaint(path: str) -> str:
    parts = path.split("/")
    if not all(_PART.fullmatch(part) and not _DEVICE.fullmatch(part) for part in parts):
        return f"which is no name that every system can have; {_ALLOWED}"
    if ".git" in (part.lower() for part in parts) or parts[0].lower() in _NOT_THE_KITS:
        return "which is never a file of the kit"
    if parts[0].lower() == ".raysteps":
        return "which is where the list itself is kept"
    return ""


def complaint(paths: Iterable[str]) -> str:
    """What is wrong with the first that may not be in a list; nothing when all may. On Windows and macOS names that
    differ in case only are one file."""
    seen: set[str] = set()
    names = list(paths)
    folders = {folder.lower() for path in names for folder in _folders(path)}
    for path in names:
        wrong = _complaint(path)
        if path.lower() in seen:
            wrong = "or a name that differs from it in case only, twice"
        elif path.lower() in folders:
            wrong = "which is a folder of another file of the list"
        if wrong:
            return f"lists {path}, {wrong}"
        seen.add(path.lower())
    return ""
