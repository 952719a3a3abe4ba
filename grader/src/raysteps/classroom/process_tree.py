"""Ends a process and all that came from it."""

import contextlib
import os
import shutil
import signal
import sys
import time
from pathlib import Path

if sys.platform != "win32":
    from raysteps.sandbox.monitor import descendants

_LONGEST_SECONDS = 30


def _send(pid: int, number: signal.Signals) -> None:
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.kill(pid, number)


def kill_process_tree(root: int) -> None:
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


def remove(folder: Path) -> None:
    """Again and again for a while: a process that was killed dies a little later, and may still have written there."""
    end = time.monotonic() + _LONGEST_SECONDS
    while folder.exists() and time.monotonic() < end:
        shutil.rmtree(folder, ignore_errors=True)
        time.sleep(0.01)


if __name__ == "__main__":
    kill_process_tree(int(sys.argv[1]))
    remove(Path(sys.argv[2]))
