"""Runs a program that is trusted, with a time limit and a cap on what it may say. Others run in a sandbox."""

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from raysteps.common.text import printable, shorten

# A program and all that it starts, to be ended together: as a process group, or as a job on Windows.


def new_session() -> dict[str, Any]:
    """For Popen: Ctrl-C on the terminal is for whoever starts the program, not for the program."""
    if sys.platform == "win32":
        return {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP | subprocess.CREATE_NO_WINDOW}
    return {"start_new_session": True}


def kill_process_group(process: "subprocess.Popen[Any]") -> None:
    """The program, and what it started. On Windows what a program leaves behind that has ended by itself is not found
    again."""
    if sys.platform == "win32":
        if process.poll() is None:
            words = ["taskkill", "/T", "/F", "/PID", str(process.pid)]
            with suppress(OSError, subprocess.TimeoutExpired):
                subprocess.run(words, capture_output=True, check=False, stdin=subprocess.DEVNULL, timeout=10)
            process.kill()
    else:
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)


_running: "set[subprocess.Popen[bytes]]" = set()


def end_what_runs() -> None:
    """For a process that is to end at once: what `run` has started in it, which has sessions of its own."""
    for process in list(_running):
        kill_process_group(process)


# Reads what a program says, on every system and without waiting for it.

_PIECE = 1 << 16


class PipeReader:
    """A thread that reads a pipe to its end and keeps the first `cap` bytes. The pipe is its own, to close it as well:
    somebody who outlives the program may hold the other end for long. `heard` gets each piece when it comes."""

    def __init__(self, pipe: IO[bytes] | None, cap: int, heard: Callable[[bytes], None] = lambda data: None) -> None:
        assert pipe is not None
        self._pipe = pipe
        self._cap = cap
        self._heard = heard
        self._kept = bytearray()
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def _read(self) -> None:
        with self._pipe:
            while data := os.read(self._pipe.fileno(), _PIECE):
                self._kept += data[: max(0, self._cap - len(self._kept))]
                self._heard(data)

    def is_at_end(self, seconds: float) -> bool:
        """Whether the pipe was closed at the other end, within that time."""
        self._thread.join(max(0.0, seconds))
        return not self._thread.is_alive()

    def data(self) -> bytes:
        return bytes(self._kept)


def drained(pipes: Sequence[PipeReader], seconds: float) -> list[str]:
    """What a program that has ended said: of what is still in its pipes, as much as comes in that time."""
    until = time.monotonic() + seconds
    for pipe in pipes:
        pipe.is_at_end(until - time.monotonic())
    return [pipe.data().decode("utf-8", "replace") for pipe in pipes]


_MEGABYTE = 1 << 20
_POLL_SECONDS = 0.2
_LEFT_BEHIND_SECONDS = 1.0  # for what is still in the pipes of a program that has ended
# How Windows tells what ended a program: the names that the same trouble has elsewhere.
_WINDOWS_ENDINGS = {
    0xC0000005: "SIGSEGV",
    0xC000001D: "SIGILL",
    0xC0000094: "SIGFPE",
    0xC00000FD: "SIGSEGV, the stack is full: a recursion without end?",
    0xC0000374: "SIGABRT, the heap is damaged",
    0xC0000409: "SIGABRT",
    0xC000013A: "SIGINT",
}
_FIRST_WINDOWS_ENDING = 0xC0000000


@dataclass(frozen=True)
class Outcome:
    """How a program ended. The exit code of a student's program proves nothing by itself."""

    code: int
    timed_out: bool
    stdout: str
    stderr: str
    seconds: float

    @property
    def signal_name(self) -> str | None:
        """Such as SIGSEGV, when a signal ended the program."""
        if self.code >= _FIRST_WINDOWS_ENDING and not self.timed_out:
            return _WINDOWS_ENDINGS.get(self.code, f"exception {self.code:#010x}")
        if self.timed_out or self.code >= 0:
            return None
        try:
            return signal.Signals(-self.code).name
        except ValueError:
            return f"signal {-self.code}"

    @property
    def last_line(self) -> str:
        """Of what the program complained."""
        return self.stderr.strip().rpartition("\n")[2]

    @property
    def signal_words(self) -> str | None:
        """The signal, and what it usually means, or what the program said of it."""
        name = self.signal_name
        why = _WHY_ABORTED.search(self.last_line[-_MAX_LINE:]) if name == "SIGABRT" else None
        if why is not None:
            kind = "an exception that nobody caught" if why["what"] else "an assertion that does not hold"
            return f"{name}: {kind}: {shorten(printable(why['what'] or why['rule'] or why['other_rule']), 200)}"
        return f"{name}: {_MEANINGS[name]}" if name in _MEANINGS else name


_MEANINGS = {
    "SIGSEGV": "memory that is not its own, or a recursion without an end",
    "SIGBUS": "memory that is not there, as behind the end of a list",
    "SIGFPE": "a whole number was divided by 0",
    "SIGILL": "a whole number was divided by 0, or a function ended without a return",
    "SIGABRT": "an exception that nobody caught, or an assertion that does not hold",
}
# As the libraries of C++ and C say it in a program's last line.
_WHY_ABORTED = re.compile(
    r"(?:^ *what\(\):|uncaught exception of type [\w:<>, ]+?:) +(?P<what>.+)"
    r"|Assertion (?:[`'](?P<rule>.+)' failed|failed: \(?(?P<other_rule>.+?)\)?, (?:function|file) )"
)
_MAX_LINE = 2000  # characters of it that are looked through


def _has_ended_in_time(process: "subprocess.Popen[bytes]", pipes: Sequence[PipeReader], deadline: float) -> bool:
    """Waits until the pipes are closed and the program is gone, or only the program, or until time is up."""
    for pipe in pipes:
        while not pipe.is_at_end(min(_POLL_SECONDS, deadline - time.monotonic())):
            if process.poll() is not None:
                return True
            if time.monotonic() > deadline:
                return False
    try:
        process.wait(max(0.0, deadline - time.monotonic()))
    except subprocess.TimeoutExpired:
        return False
    return True


def run(
    command: Sequence[str | Path],
    *,
    seconds: float,
    cwd: Path | None = None,
    cap: int = _MEGABYTE,
    heard: Callable[[bytes], None] = lambda data: None,
) -> Outcome:
    """Runs the words of a command, never a shell; kills whatever it started in the end. `heard` gets what it says on
    stdout, piece by piece and in another thread."""
    start = time.monotonic()
    process = subprocess.Popen(
        [str(word) for word in command],
        cwd=cwd,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        **new_session(),
    )
    _running.add(process)
    pipes = [PipeReader(process.stdout, cap, heard), PipeReader(process.stderr, cap)]
    try:
        in_time = _has_ended_in_time(process, pipes, start + seconds)
    finally:
        kill_process_group(process)
        code = process.wait()
        _running.discard(process)
    out, err = drained(pipes, _LEFT_BEHIND_SECONDS)
    return Outcome(code, timed_out=not in_time, stdout=out, stderr=err, seconds=time.monotonic() - start)
