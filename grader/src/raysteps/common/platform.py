"""What differs between systems and is needed in many places."""

import os
import re
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from raysteps.common.errors import UsageError

_DEVICE = re.compile(r"(?:con|prn|aux|nul|com\d|lpt\d)(?:\..*)?", re.IGNORECASE)


def is_windows() -> bool:
    """A function, so that a type checker looks at both ways whatever system it runs on."""
    return sys.platform == "win32"


def is_windows_device(name: str) -> bool:
    """Whether Windows has no files of that name, whatever its ending."""
    return _DEVICE.fullmatch(name) is not None


def processor_count() -> int:
    """How many this process may use: fewer than there are where it is tied to some, as by `taskset`."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def executable(path: Path) -> Path:
    """How a program's file is called here."""
    return path.with_name(f"{path.name}.exe") if is_windows() else path


def own_command(root: Path | None = None) -> str:
    """What a person types before the name of a command: in the kit's folder, or in one below it where `root` names
    that."""
    up = ""
    if root is not None and Path.cwd().is_relative_to(root):
        up = "../" * len(Path.cwd().relative_to(root).parts)
    return f"python {up}raysteps" if is_windows() else f"{up or './'}raysteps"


def quote_command(words: Sequence[str]) -> str:
    """The words as a person types them into the command line of this system."""
    if not is_windows():
        return shlex.join(words)
    import subprocess  # it takes long to load

    return subprocess.list2cmdline(words)


def kit_command(*words: str | Path) -> str:
    """A command of the kit, as a person types it."""
    return f"{own_command()} {quote_command([str(word) for word in words])}"


def refuse_on_windows(what: str) -> None:
    """For what rests on how Linux and macOS run programs."""
    if is_windows():
        raise UsageError(
            f"{what} needs Linux or macOS. On Windows it runs in WSL (Windows Subsystem for Linux): "
            "docs/where-students-work.md says how to set that up."
        )
