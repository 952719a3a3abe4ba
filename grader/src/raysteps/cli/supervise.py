"""Grades in a process of its own, which the one that was started on the terminal ends: whatever it hangs in."""

import ctypes
import os
import select
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

from raysteps.classroom.jobs import gave_up
from raysteps.classroom.process_tree import kill_process_tree, remove
from raysteps.common.errors import GraderFault
from raysteps.toolchain.limits import tell_of_restarts

_PR_SET_PDEATHSIG = 1
_GRACE_SECONDS = 2.0  # to tidy up after Ctrl-C, which both processes hear


@contextmanager
def _signals() -> Iterator[int]:
    """A file that can be read as soon as a signal has come: one that comes just before a wait would not end it."""
    heard, said = os.pipe()
    os.set_blocking(said, False)
    before = signal.set_wakeup_fd(said, warn_on_full_buffer=False)
    try:
        yield heard
    finally:
        signal.set_wakeup_fd(before)
        os.close(said)
        os.close(heard)


_MOST = 4096  # bytes at a time: each is a word


def _is_over(end: int, seconds: float) -> bool:
    """Whether the other process has ended, or ends within that time of the last word that it said."""
    give_up, over = time.monotonic() + seconds, False
    with _signals() as signals:
        while not over and (ready := select.select([end, signals], [], [], max(0.0, give_up - time.monotonic()))[0]):
            if signals in ready:
                os.read(signals, 1)
            if end in ready:
                over = not os.read(end, _MOST)
                give_up = time.monotonic() + seconds
    return over


def _wait(end: int, seconds: float, blocked: Collection[int]) -> bool:
    """False where time was up; KeyboardInterrupt where somebody does not want to wait: from here on, unless `blocked`
    has it."""
    try:
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
        return _is_over(end, seconds)
    except KeyboardInterrupt:
        if _is_over(end, _GRACE_SECONDS):
            return True  # it says itself that it was interrupted
        raise


def run_with_timeout(work: Callable[[], int], seconds: float) -> int:
    """The exit code of the work, which goes on in a child of this process; both come back from here. So many
    seconds after the last `restart_clock` it is a fault of the grader, whose temporary files go as well."""
    if sys.platform != "linux":
        return work()
    scratch = Path(tempfile.mkdtemp(prefix="raysteps-grade-"))
    end, held = os.pipe()
    blocked = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # what Python does at a fork would swallow it
    child = os.fork()
    if child == 0:
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        os.close(end)
        scratch.chmod(0o711)  # a sandbox may run as another user
        tempfile.tempdir = os.environ["TMPDIR"] = str(scratch)
        tell_of_restarts(held)
        return work()  # `held` stays open until the process has ended
    try:
        os.close(held)
        if not _wait(end, seconds, blocked):
            raise GraderFault(gave_up(seconds))
    finally:
        kill_process_tree(child)
        _, status = os.waitpid(child, 0)
        remove(scratch)
    code = os.waitstatus_to_exitcode(status)
    return code if code >= 0 else 128 - code
