"""What a folder, a zip and a tar have in common: entries with a path, of which some are read."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.text import one_line, shorten

MAX_SOURCE = 1 << 20
MAX_ENTRIES = 20_000
MAX_ABOVE = 3  # top folders around a whole submission, as archives of folders of archives have them
MAX_DEPTH = MAX_ABOVE + 3  # of an accepted place: top folders, steps, step, file
MAX_UNPACKED = 256 << 20
MAX_RATIO = 200  # honest sources shrink to a fifth, honest pictures to a hundredth
RATIO_COUNTS_FROM = 32 << 20
_TOOLS_FOLDERS = ("__MACOSX", "build", "CMakeFiles", "_deps", "node_modules")
_TOOLS_BEGIN = (".", "cmake-build-")  # names as editors give them


class RejectedFile(Exception):
    """Why one file was left out, in words that go on after its name."""


@dataclass(frozen=True)
class FileEntry:
    """Something that a submission holds. `read` counts only until the next entry is asked for."""

    parts: tuple[str, ...]
    read: Callable[[], bytes]


def shown(parts: tuple[str, ...]) -> str:
    """A path that a message may hold, whatever bytes it was made of."""
    text = "/".join(parts).encode("utf-8", "replace").decode("utf-8")
    return shorten(one_line(text), 120)


def split(path: str) -> tuple[str, ...] | None:
    """The parts of a path; None when it leads out, holds control characters, or is no path at all.

    Some programs on Windows part the folders of a zip by backslashes, against its specification."""
    path = path.replace("\\", "/")
    parts = tuple(part for part in path.split("/") if part not in ("", "."))
    bad = path.startswith("/") or ".." in parts or any(ord(letter) < 32 for letter in path)
    return None if bad else parts or None


def is_out_of_sight(folders: tuple[str, ...]) -> bool:
    """What counts as nothing, not even as a file too many: folders of tools, and what lies too deep."""
    return len(folders) >= MAX_DEPTH or any(part.startswith(_TOOLS_BEGIN) or part in _TOOLS_FOLDERS for part in folders)


def too_many(root: Path) -> UsageError:
    return UsageError(f"{root}: holds more than {MAX_ENTRIES} files; hand in the steps only")


def check_unpacked(root: Path, unpacked: int, packed: int) -> None:
    """Refuses what would grow too much, before it does."""
    if unpacked > MAX_UNPACKED:
        raise UsageError(f"{root}: holds more than {MAX_UNPACKED >> 20} MB unpacked; hand in the steps only")
    if unpacked > RATIO_COUNTS_FROM and unpacked > MAX_RATIO * packed:
        raise UsageError(f"{root}: unpacks to more than {MAX_RATIO} times its size; hand in the steps only")


def check_size(size: int) -> None:
    if size > MAX_SOURCE:
        raise RejectedFile("is larger than 1 MB and was not taken.")


def not_a_file(what: str) -> Callable[[], bytes]:
    """The reader of a link, a pipe and so on, which has nothing to read."""

    def read() -> bytes:
        raise RejectedFile(f"is {what}, not a file, and was not taken.")

    return read
