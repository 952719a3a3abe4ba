"""Runs a task in a sandbox and beside it, outside, the trusted program that asks it. What decides points comes from the
latter: a student's code answers questions, and never says how it did."""

import os
import resource
import select
import signal
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome
from raysteps.common.text import printable, shorten
from raysteps.sandbox.task import Limits, StartedProcess, Task, TaskResult

WIRE_VARIABLE = "RAYSTEPS_BOX"  # names the two ends of the wire to the program beside the box
_MEGABYTE = 1 << 20
_MEMORY_MB = 4096  # of the trusted program, which holds what the box sends
_FILE_MB = 256  # of a file that it writes, such as its replies
_ERRORS_KB = 64
_DYING_SECONDS = 5.0


class Wire:
    """What a task has in place of a stdin that was given and a stdout that is kept: pipes to the program beside it."""

    def __init__(self, stdin: int, stdout: int) -> None:
        self.stdin = stdin
        self.stdout = stdout
        self.finished, self._finish = os.pipe()  # the first can be read once nobody asks the task any more
        self._lock = threading.Lock()
        self._open = {stdin, stdout, self.finished, self._finish}

    def _close(self, *files: int) -> None:
        with self._lock:
            for file in self._open & set(files):
                self._open.remove(file)
                os.close(file)

    def hand_over(self) -> None:
        """The task has them now; it alone may keep them open."""
        self._close(self.stdin, self.stdout)

    def finish(self) -> None:
        """Nobody asks any more."""
        self._close(self._finish)

    def close(self) -> None:
        self._close(*self._open)


# How a program beside a box ends, as framework/remote/wire.hpp says it.
_CLOSED = 70
_WHY_BROKEN = {
    71: "something else than the step's functions wrote to the pipe of their answers",
    72: "the functions called each other without an end",
    73: "the answers of the step's functions were longer than 128 MB at once",
}


@dataclass(frozen=True)
class _TrustedOutcome:
    """How the trusted program ended."""

    code: int
    stdout: str
    stderr: str
    outputs: dict[str, bytes]
    seconds: float
    cpu_seconds: float
    timed_out: bool


def readable(fd: int, seconds: float) -> bool:
    """Whether there is something to read, or an end, within that time."""
    poll = select.poll()
    poll.register(fd, select.POLLIN)
    return bool(poll.poll(max(0.0, seconds) * 1000))


_SIGNALS = range(129, 128 + signal.NSIG)


def unwrapped(code: int) -> int:
    """bubblewrap turns the signal that ended a command into an exit code above 128; this turns it back."""
    return 128 - code if code in _SIGNALS else code


def _text(file: IO[bytes], most_kb: int) -> str:
    file.seek(0)
    return file.read(most_kb * 1024).decode("utf-8", "replace")


def _quoted(said: str) -> str:
    return shorten(printable(said).strip(), 500)


def trusted_limits(limits: Limits) -> dict[str, int]:
    """Resource limits of the trusted program by name: it is the kit's own, but works on what the box sends."""
    bounds = {"RLIMIT_AS": _MEMORY_MB, "RLIMIT_FSIZE": max(limits.file_mb, _FILE_MB)}
    within = {"RLIMIT_CORE": 0}
    for name, most_mb in bounds.items():
        _, hard = resource.getrlimit(getattr(resource, name))
        most = most_mb * _MEGABYTE
        within[name] = most if hard == resource.RLIM_INFINITY else min(most, hard)
    return within


def _end_inside(pid: int) -> None:
    """What a fence is around, so that the fence waits for it, and nobody else has to."""
    with suppress(OSError):
        inside = [int(word) for word in Path(f"/proc/{pid}/task/{pid}/children").read_bytes().split()]
        for one in inside or [pid]:
            os.kill(one, signal.SIGKILL)


def _wait(process: StartedProcess, seconds: float) -> tuple[int, float, bool]:
    """The exit code, the processor seconds, and whether it had to be ended."""
    handle = os.pidfd_open(process.pid)
    try:
        timed_out = not readable(handle, seconds)
        if timed_out:
            _end_inside(process.pid)
        if timed_out and not readable(handle, _DYING_SECONDS):
            signal.pidfd_send_signal(handle, signal.SIGKILL)  # process.kill() may wait for it, and take its times away
        with suppress(OSError):  # a fence that ended early leaves who waits for it; a keeper leads no group
            os.killpg(process.pid, signal.SIGKILL)
        _, status, used = os.wait4(process.pid, 0)
    finally:
        os.close(handle)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, used.ru_utime + used.ru_stime, timed_out


@dataclass(frozen=True)
class Files:
    """What the trusted program has open besides its outputs."""

    stdin: int
    stdout: int
    stderr: int
    wire: tuple[int, int]

    @property
    def environment(self) -> dict[str, str]:
        """All that it has of one."""
        return {WIRE_VARIABLE: f"{self.wire[0]},{self.wire[1]}", "LC_ALL": "C"}


@dataclass(frozen=True)
class TrustedProcess:
    """The trusted program, running."""

    process: StartedProcess
    exit_code: Callable[[int], int | None]  # its own, by how the process ended; none when it was never started
    outputs: Callable[[], dict[str, bytes]]  # to be asked for when it has ended


# Starts the trusted program, which is a task of its own, behind a fence: it reads what a box sends, and should that
# ever lead it astray, it finds no more than its inputs.
Start = Callable[[Task, Files, ExitStack], TrustedProcess]


def _run_outside(task: Task, pipes: tuple[int, int], start: Start) -> _TrustedOutcome:
    """With its ends of the wire, which it alone holds from then on."""
    assert task.beside is not None
    limits = task.limits
    own = Task(task.beside.command, limits)
    begin = time.monotonic()
    with ExitStack() as stack:
        mine = stack.enter_context(ExitStack())
        for file in pipes:
            mine.callback(os.close, file)
        stdin, stdout, stderr = (stack.enter_context(tempfile.TemporaryFile()) for _ in range(3))
        stdin.write(task.beside.stdin)
        stdin.seek(0)
        try:
            trusted = start(own, Files(stdin.fileno(), stdout.fileno(), stderr.fileno(), pipes), stack)
        except OSError as error:
            raise GraderFault(f"{task.beside.command[0]}: cannot be started: {error}") from error
        mine.close()
        stack.callback(trusted.process.kill)
        status, cpu_seconds, timed_out = _wait(trusted.process, limits.wall_seconds)
        code, outputs = trusted.exit_code(status), trusted.outputs()
        said, complained = _text(stdout, limits.output_kb), _text(stderr, _ERRORS_KB)
        if code is None:
            raise GraderFault(f"the program beside the box cannot be started: {_quoted(complained)}")
        return _TrustedOutcome(code, said, complained, outputs, time.monotonic() - begin, cpu_seconds, timed_out)


def _result(inside: TaskResult, outside: _TrustedOutcome) -> TaskResult:
    outcome = replace(inside.outcome, stdout=outside.stdout)
    cpu_seconds = inside.cpu_seconds + outside.cpu_seconds
    if 0 <= outside.code < _CLOSED:  # nothing was left to ask: whatever the box does afterwards
        ended = Outcome(outside.code, False, outside.stdout, inside.outcome.stderr + outside.stderr, outside.seconds)
        return TaskResult(ended, outside.outputs, cpu_seconds, "")
    why = _WHY_BROKEN.get(inside.outcome.code if outside.code == _CLOSED else outside.code)  # whoever saw it first
    if why is not None:
        ended = replace(outcome, code=1, timed_out=False, stderr=why)
        return TaskResult(ended, outside.outputs, cpu_seconds, "")
    if outside.timed_out and not inside.stopped:
        ended = replace(outcome, code=-signal.SIGKILL, timed_out=True, seconds=outside.seconds)
        return TaskResult(ended, outside.outputs, cpu_seconds, "wall")
    if outside.code == _CLOSED or outside.timed_out:
        return TaskResult(outcome, outside.outputs, cpu_seconds, inside.stopped)
    said = _quoted(outside.stderr)
    if outside.code < 0:  # what it works on is the step's answers
        words = f"what asks the step's functions was ended by {signal.Signals(-outside.code).name} at their answers"
        ended = replace(outcome, code=outside.code, timed_out=False, stderr=f"{words}: {said}")
        return TaskResult(ended, outside.outputs, cpu_seconds, inside.stopped)
    raise GraderFault(f"the program beside the box ended with {outside.code}: {said}")


class TrustedRun:
    """The program beside a task, which runs in a thread of its own from the beginning."""

    def __init__(self, task: Task, pool: ThreadPoolExecutor, start: Start) -> None:
        to_box, from_home = os.pipe()
        to_home, from_box = os.pipe()
        self.wire = Wire(to_box, from_box)
        self._ended = pool.submit(self._run, task, (to_home, from_home), start)

    def _run(self, task: Task, pipes: tuple[int, int], start: Start) -> _TrustedOutcome:
        try:
            return _run_outside(task, pipes, start)
        finally:
            self.wire.finish()

    def result(self, inside: TaskResult) -> TaskResult:
        """What became of the student's code, as if it had run in the trusted program itself."""
        return _result(inside, self._ended.result())


@contextmanager
def running_beside(task: Task, start: Start) -> Iterator[TrustedRun | None]:
    """None for a task that runs alone."""
    if task.beside is None:
        yield None
        return
    with ThreadPoolExecutor(max_workers=1) as pool:
        asked = TrustedRun(task, pool, start)
        try:
            yield asked
        finally:
            asked.wire.close()  # who still waits for the task hears that it is over
