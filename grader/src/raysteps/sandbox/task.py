"""What a sandbox is asked to run, and what comes back."""

import math
import os
import stat
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import IO, Any, Literal, Protocol, Self

from raysteps.common.files import open_regular
from raysteps.common.process import Outcome

# What keeps a student's code apart from the machine.


@dataclass(frozen=True)
class Isolation:
    """What kept the student's code apart from the machine."""

    name: str = "none"  # "bubblewrap", "other user", "landlock", "limits only", "none"
    strong: bool = False
    description: str = "The code ran without a sandbox."


LimitHit = Literal["", "wall", "cpu", "memory"]


@dataclass(frozen=True)
class Limits:
    """What a task may use. A limit that is reached ends the task, or makes its system call fail."""

    wall_seconds: float = 20
    cpu_seconds: float = 20  # of all processes of the task together where that can be had
    memory_mb: int = 2048  # of all processes together where that can be had
    processes: int = 64  # and threads
    file_mb: int = 64  # largest file
    tmp_mb: int = 64  # all of its scratch space
    output_kb: int = 1024  # kept of stdout, and of stderr


def _check_name(name: str) -> None:
    if name in ("", ".", "..") or "/" in name or "\0" in name:
        raise ValueError(f"{name!r} is not the name of a file")


@dataclass(frozen=True)
class Input:
    """A host file or folder, readable inside, under a neutral name."""

    path: Path
    name: str | None = None

    def __post_init__(self) -> None:
        _check_name(self.inner_name)

    @property
    def inner_name(self) -> str:
        return self.path.name if self.name is None else self.name


@dataclass(frozen=True)
class Output:
    """A file the command writes; its bytes come back, capped by file_mb."""

    name: str

    def __post_init__(self) -> None:
        _check_name(self.name)


Word = str | Input | Output


@dataclass(frozen=True)
class TrustedCommand:
    """A trusted program that runs outside while the task runs inside, and asks it over a wire. Its Output words are the
    outputs of the task."""

    command: tuple[Word, ...]
    stdin: bytes = b""


@dataclass(frozen=True)
class Task:
    """A command, never a shell line: Input and Output words become paths that are valid where it runs."""

    command: tuple[Word, ...]
    limits: Limits = Limits()
    tools: bool = False  # compiler, assembler, linker and their headers; else only what a program needs to start
    inputs: tuple[Input, ...] = ()  # readable, but not named in the command
    stdin: bytes = b""
    beside: TrustedCommand | None = None  # then it has no stdin and no stdout but the wire
    abandoned: threading.Event = field(
        default_factory=threading.Event, compare=False
    )  # once set, ends the task as a limit does

    def all_inputs(self) -> Iterator[Input]:
        """Each once, those of the command first."""
        named = (word for word in self.command if isinstance(word, Input))
        yield from dict.fromkeys([*named, *self.inputs])

    def is_program(self, given: Input) -> bool:
        """Whether the command runs it."""
        return given == self.command[0]

    def all_outputs(self) -> Iterator[Output]:
        yield from dict.fromkeys(word for word in self.command if isinstance(word, Output))


@dataclass(frozen=True)
class TaskResult:
    """How a task ended."""

    outcome: Outcome
    outputs: dict[str, bytes]  # by Output.name; missing where nothing was written or it is no regular file
    cpu_seconds: float
    stopped: LimitHit  # the limit that ended it, where known

    @property
    def hung(self) -> bool:
        """Whether its time was over."""
        return self.outcome.timed_out or self.stopped in ("wall", "cpu")

    @property
    def was_stopped(self) -> bool:
        """Whether a limit ended it, on time or on memory."""
        return self.hung or self.stopped == "memory"


class StartedProcess(Protocol):
    """A child of this process, as subprocess.Popen is one, with its output as pipes where there are any."""

    pid: int
    returncode: int | Any  # None until somebody has waited for it
    stdout: IO[bytes] | None
    stderr: IO[bytes] | None

    def terminate(self) -> None: ...
    def kill(self) -> None: ...
    def __enter__(self) -> Self: ...
    def __exit__(self, *_: Any) -> None: ...


class Sandbox(Protocol):
    """Something that runs tasks, from several threads at once."""

    @property
    def isolation(self) -> Isolation: ...

    def run(self, task: Task) -> TaskResult: ...


# Reads what a task wrote.

_MEGABYTE = 1 << 20


def read_regular(path: Path, cap: int) -> bytes | None:
    """The bytes of a file that a task wrote: no link is followed, no pipe is waited for."""
    try:
        file = open_regular(path)
    except OSError:
        return None
    with os.fdopen(file, "rb", buffering=0) as opened:
        if not stat.S_ISREG(os.fstat(file).st_mode):
            return None
        data = bytearray()
        while len(data) < cap and (part := opened.read(min(_MEGABYTE, cap - len(data)))):
            data += part
        return bytes(data) or None


# A sandbox that adds up what its tasks cost, and tells of limits in round numbers.


def _as_limited(ran: TaskResult, limits: Limits) -> TaskResult:
    """A task that was stopped took as long as it may, however late the grader looked, and whether it was the clock that
    ended it, as on a busy machine, or the processor time: so the same submission always gets the same words."""
    if ran.stopped not in ("wall", "cpu"):
        return ran
    seconds = min(limits.wall_seconds, limits.cpu_seconds)
    return replace(ran, outcome=replace(ran.outcome, seconds=seconds))


_NOT_RUN = TaskResult(Outcome(-9, True, "", "", 0.0), {}, 0.0, "wall")


class AccountingSandbox:
    """Hands each task on, keeps the sum of processor seconds, and runs nothing more when all tasks together have taken
    `seconds` on the clock. Safe for several threads."""

    def __init__(self, sandbox: Sandbox, seconds: float = math.inf) -> None:
        self._sandbox = sandbox
        self._lock = threading.Lock()
        self._left = seconds
        self._abandoned = threading.Event()
        self.cpu_seconds = 0.0

    @contextmanager
    def until_interrupted(self) -> Iterator[None]:
        """When whoever waits is interrupted, ends what runs: threads that run something are interrupted, too."""
        try:
            yield
        except KeyboardInterrupt:
            self._abandoned.set()
            raise

    @property
    def is_spent(self) -> bool:
        return self._left <= 0

    @property
    def isolation(self) -> Isolation:
        return self._sandbox.isolation

    def run(self, task: Task) -> TaskResult:
        """Runs the task in the sandbox. Raises KeyboardInterrupt where nobody waits for it any more."""
        self._go_on()
        if self.is_spent:
            return _NOT_RUN
        limits = replace(task.limits, wall_seconds=min(task.limits.wall_seconds, self._left))
        ran = self._sandbox.run(replace(task, limits=limits, abandoned=self._abandoned))
        self._go_on()
        with self._lock:
            self.cpu_seconds += ran.cpu_seconds
            self._left -= ran.outcome.seconds
        return _as_limited(ran, limits)

    def _go_on(self) -> None:
        if self._abandoned.is_set():
            raise KeyboardInterrupt
