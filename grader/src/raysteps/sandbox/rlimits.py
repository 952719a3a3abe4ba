"""Limits of single processes, set by a program that goes before the command."""

import math
import platform
import shutil
from pathlib import Path

from raysteps.sandbox.task import Limits

_MEGABYTE = 1 << 20
_OPEN_FILES = 256
_PER_THREAD_MB = 80  # addresses that a thread reserves and need not use: its stack and its part of the heap
_FIBERS_MB = 1200  # stacks of the questions that a box works on at the same time


def address_space(limits: Limits) -> int:
    """Generous, because it counts what is reserved and not what is used: it stops a burst, the watching stops the
    rest."""
    return (limits.memory_mb + limits.processes * _PER_THREAD_MB + _FIBERS_MB) * _MEGABYTE


def processes_word(most: int) -> str:
    """For prlimit; it counts the processes and threads of a user."""
    return f"--nproc={most}"


def prlimit_options(limits: dict[str, int]) -> list[str]:
    """For prlimit: limits by the names that `resource` has for them."""
    return [f"--{name.removeprefix('RLIMIT_').lower()}={most}" for name, most in limits.items()]


def cpu_seconds_of_a_process(limits: Limits) -> int:
    """More than the task may have: the kernel counts by looking at its clock now and then, and on a busy machine much
    too high. It is for what escapes the watching, which is exact."""
    return math.ceil(2 * limits.cpu_seconds) + 1


def prlimit_command(limits: Limits, *, memory: bool) -> list[str]:
    """A command that sets the limits for the command that follows it."""
    file = limits.file_mb * _MEGABYTE
    words = [str(shutil.which("prlimit")), "--core=0", f"--fsize={file}", f"--nofile={_OPEN_FILES}"]
    words += [f"--cpu={cpu_seconds_of_a_process(limits)}"]
    if memory:
        words += [f"--as={address_space(limits)}"]
    return words


def counts_per_namespace() -> bool:
    """Whether a limit on processes that is set in a user namespace counts only what runs in it (Linux 5.14)."""
    numbers = platform.release().split("-")[0].split(".")
    try:
        return (int(numbers[0]), int(numbers[1])) >= (5, 14)
    except (IndexError, ValueError):
        return False


def threads_of_user(uid: int) -> int:
    """How many threads all processes of the user have now."""
    count = 0
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            if entry.stat().st_uid == uid:
                count += len(list((entry / "task").iterdir()))
        except OSError:
            continue  # it ended meanwhile
    return count
