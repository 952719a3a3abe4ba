"""A bubblewrap that runs: what its processes use, how they end, and what that means for the task."""

import os
import signal
import subprocess
from contextlib import suppress

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome
from raysteps.sandbox.cgroups import Group
from raysteps.sandbox.control import readable
from raysteps.sandbox.processes import Usage, descendants, reap, usage_of
from raysteps.sandbox.watching import Seen

_DYING_SECONDS = 5.0
_SIGNALS = range(129, 128 + signal.NSIG)


class Running:
    """The processes of one task, from outside."""

    def __init__(self, process: "subprocess.Popen[bytes]", first: int, group: Group | None) -> None:
        self._process = process
        self._first = first
        self._group = group
        self._handle = os.pidfd_open(first)

    def usage(self) -> Usage:
        return usage_of(descendants(self._first)) if self._group is None else self._group.usage()

    def kill(self) -> None:
        """With the first process of its namespace, the kernel ends all others."""
        with suppress(ProcessLookupError):
            signal.pidfd_send_signal(self._handle, signal.SIGKILL)
        if self._process.returncode is None:
            self._process.kill()

    def reap(self) -> float:
        """Waits until everything inside is dead; the CPU seconds of what bubblewrap did not wait for."""
        if not readable(self._handle, _DYING_SECONDS):
            raise GraderFault(f"The processes of a sandbox do not die (the first is {self._first}).")
        return reap(self._first, self._handle)

    def close(self) -> None:
        os.close(self._handle)


def outcome(seen: Seen, code: int | None) -> Outcome:
    """bubblewrap turns the signal that ended a command into an exit code above 128; this turns it back. No code: the
    command was killed."""
    if seen.stopped or code is None:
        code = -signal.SIGKILL
    elif code in _SIGNALS:
        code = 128 - code
    return Outcome(
        code=code,
        timed_out=seen.stopped == "wall",
        stdout=seen.stdout.decode("utf-8", "replace"),
        stderr=seen.stderr.decode("utf-8", "replace"),
        seconds=seen.seconds,
    )
