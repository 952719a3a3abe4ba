"""Ends a process and all that came from it."""

import contextlib
import os
import shutil
import signal
import sys
from pathlib import Path

from raysteps.sandbox.processes import descendants


def _send(pid: int, number: signal.Signals) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.kill(pid, number)


def end_tree(root: int) -> None:
    """Also what it started in sessions of their own, such as the programs of a submission."""
    stopped: set[int] = set()
    new = {root}
    while new:  # all are stopped before one is killed, so that nothing more is started meanwhile
        for pid in new:
            _send(pid, signal.SIGSTOP)
        stopped |= new
        try:
            new = descendants(root) - stopped - {os.getpid()}
        except OSError:  # no /proc: the programs end at their own limits
            break
    for pid in stopped:
        _send(pid, signal.SIGKILL)


if __name__ == "__main__":
    end_tree(int(sys.argv[1]))
    shutil.rmtree(Path(sys.argv[2]), ignore_errors=True)
