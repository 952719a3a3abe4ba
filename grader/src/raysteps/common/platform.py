"""What differs between systems and is needed in many places."""

import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from raysteps.common.errors import UsageError


def is_windows() -> bool:
    """A function, so that a type checker looks at both ways whatever system it runs on."""
    return sys.platform == "win32"


def executable(path: Path) -> Path:
    """How a program's file is called here."""
    return path.with_name(f"{path.name}.exe") if is_windows() else path


def own_command() -> str:
    """What a person types before the name of a command."""
    return "python raysteps" if is_windows() else "./raysteps"


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
