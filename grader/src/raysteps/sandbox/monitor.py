"""Reads what a task says while it runs, and ends it when it has used up what it may use."""

import ctypes
import os
import selectors
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from raysteps.sandbox.beside import Wire
from raysteps.sandbox.task import LimitHit, Limits, StartedProcess, Task

# What the processes of a task use, as /proc tells it.

_TICKS = os.sysconf("SC_CLK_TCK")
_PAGE = os.sysconf("SC_PAGE_SIZE")
_PR_SET_CHILD_SUBREAPER = 36


@dataclass(frozen=True)
class Usage:
    """Of all processes of a task together."""

    cpu_seconds: float = 0.0
    memory_bytes: int = 0
    out_of_memory: bool = False  # the kernel said so


def _children_by_parent() -> dict[int, list[int]]:
    children: dict[int, list[int]] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and (fields := _stat_fields(int(entry.name))):
            children.setdefault(int(fields[1]), []).append(int(entry.name))
    return children


def _children(pid: int) -> list[int]:
    found: list[int] = []
    for thread in Path(f"/proc/{pid}/task").iterdir():
        found += (int(word) for word in (thread / "children").read_bytes().split())
    return found


def _stat_fields(pid: int) -> list[bytes]:
    """The fields of /proc/PID/stat from the state on; none when the process is gone."""
    try:
        data = Path(f"/proc/{pid}/stat").read_bytes()
    except OSError:
        return []
    return data[data.rindex(b")") + 2 :].split()


def descendants(root: int) -> set[int]:
    """The process and all that came from it."""
    known: set[int] = set()
    waiting = [root]
    listed = None if Path("/proc/thread-self/children").exists() else _children_by_parent()
    while waiting:
        pid = waiting.pop()
        if pid in known:
            continue
        known.add(pid)
        try:
            waiting += _children(pid) if listed is None else listed.get(pid, [])
        except OSError:
            continue  # it ended meanwhile
    return known


def usage_of(pids: set[int]) -> Usage:
    cpu = memory = 0
    for pid in pids:
        fields = _stat_fields(pid)
        if fields:
            cpu += sum(int(field) for field in fields[11:15])  # own and reaped children's, in user and in system
            memory += int(fields[21])
    return Usage(cpu / _TICKS, memory * _PAGE)


class _Adoption:
    """Whether orphans below this process become its children: counted, because several threads may want it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._wanted = 0

    def change(self, by: int) -> None:
        with self._lock:
            self._wanted += by
            ctypes.CDLL(None).prctl(_PR_SET_CHILD_SUBREAPER, int(self._wanted > 0), 0, 0, 0)


_adoption = _Adoption()


@contextmanager
def adopting_orphans() -> Iterator[None]:
    """Meanwhile, processes whose parent dies come to this process, which can then wait for them and learn what they
    used; otherwise they would go to init."""
    _adoption.change(+1)
    try:
        yield
    finally:
        _adoption.change(-1)


def reap(pid: int, handle: int) -> float:
    """The CPU seconds of a dead child and all that it waited for; 0 when it is no child (any more)."""
    try:
        if os.waitid(os.P_PIDFD, handle, os.WEXITED | os.WNOWAIT | os.WNOHANG) is None:
            return 0.0
        _, _, used = os.wait4(pid, 0)
    except ChildProcessError:
        return 0.0
    return used.ru_utime + used.ru_stime


_POLL_SECONDS = 0.05
_DYING_SECONDS = 2.0
_FINISHED_SECONDS = 0.5  # for a task that nobody asks any more, to end by itself
_MEGABYTE = 1 << 20


class MonitoredTask(Protocol):
    """The processes of a task, seen from outside."""

    def usage(self) -> Usage: ...

    def kill(self) -> None:
        """Ends every one of them; safe to call again."""


@dataclass(frozen=True)
class MonitorReport:
    """What was seen of a task."""

    status: int  # as a wait gives it: an exit code, or a signal below zero
    stdout: bytes
    stderr: bytes
    cpu_seconds: float  # of the process that was started and what it waited for
    watched_cpu_seconds: float  # of all processes, when they were last looked at
    seconds: float
    stopped: LimitHit


def _limit_reached(usage: Usage, limits: Limits) -> LimitHit:
    if usage.out_of_memory or usage.memory_bytes > limits.memory_mb * _MEGABYTE:
        return "memory"
    return "cpu" if usage.cpu_seconds > limits.cpu_seconds else ""


class _Watch:
    """One task from its start to its end: it reads the pipes, measures, and kills what goes beyond a limit."""

    def __init__(
        self,
        process: StartedProcess,
        start: float,
        limits: Limits,
        watched: MonitoredTask,
        wire: Wire | None,
        abandoned: threading.Event,
    ) -> None:
        self._process = process
        self._abandoned = abandoned
        self._start = start
        self._limits = limits
        self._finished = None if wire is None else wire.finished
        self._watched = watched
        self._stdout, self._stderr = bytearray(), bytearray()  # a task on a wire has no stdout
        pipes = ((process.stdout, self._stdout), (process.stderr, self._stderr))
        self._kept = {pipe.fileno(): kept for pipe, kept in pipes if pipe is not None}
        self._stopped: LimitHit = ""
        self._cpu = 0.0
        self._watched_cpu = 0.0

    def _has_ended(self) -> bool:
        if self._process.returncode is None:
            pid, status, used = os.wait4(self._process.pid, os.WNOHANG)
            if pid:
                self._process.returncode = os.waitstatus_to_exitcode(status)
                self._cpu = used.ru_utime + used.ru_stime
        return self._process.returncode is not None

    def _read(self, fd: int, selector: selectors.BaseSelector) -> None:
        data = os.read(fd, 1 << 16)
        if not data:
            selector.unregister(fd)
        buffer = self._kept[fd]
        buffer += data[: max(0, self._limits.output_kb * 1024 - len(buffer))]

    def _stop(self, why: LimitHit) -> None:
        self._stopped = self._stopped or why
        self._watched.kill()

    def _measure(self) -> LimitHit:
        usage = self._watched.usage()
        self._watched_cpu = max(self._watched_cpu, usage.cpu_seconds)
        return _limit_reached(usage, self._limits)

    def _look(self, now: float, last: float) -> None:
        why = self._measure()
        if now > last or self._abandoned.is_set():
            self._stop("wall")
        elif why:
            self._stop(why)

    def _listen(self, selector: selectors.BaseSelector) -> None:
        """Until the process has ended."""
        look_at = time.monotonic() + _POLL_SECONDS
        last = self._start + self._limits.wall_seconds
        while not self._has_ended():
            now = time.monotonic()
            if now >= look_at or now > last:
                self._look(now, last)
                look_at = time.monotonic() + _POLL_SECONDS
            for key, _ in selector.select(max(0.001, min(look_at, last + 0.001) - now)):
                if key.fd in self._kept:
                    self._read(key.fd, selector)
                    continue
                selector.unregister(key.fileobj)  # it ended; the loop's condition finds out how
                if key.fd == self._finished:
                    last = min(last, time.monotonic() + _FINISHED_SECONDS)

    def _listen_on(self, selector: selectors.BaseSelector) -> None:
        """What is left in the pipes; a process that escaped the killing does not hold the grader for long."""
        until = time.monotonic() + _DYING_SECONDS
        while selector.get_map() and (left := until - time.monotonic()) > 0:
            for key, _ in selector.select(min(left, _POLL_SECONDS)):
                if key.fd in self._kept:
                    self._read(key.fd, selector)
                else:
                    selector.unregister(key.fileobj)

    def until_the_end(self) -> MonitorReport:
        handle = os.pidfd_open(self._process.pid) if hasattr(os, "pidfd_open") else -1
        try:
            with selectors.DefaultSelector() as selector:
                others = (handle if handle >= 0 else None, self._finished)
                for fd in (*self._kept, *(fd for fd in others if fd is not None)):
                    selector.register(fd, selectors.EVENT_READ)
                self._listen(selector)
                last = self._measure()
                seconds = time.monotonic() - self._start
                self._watched.kill()
                self._listen_on(selector)
        finally:
            if handle >= 0:
                os.close(handle)
        return MonitorReport(
            status=self._process.returncode,
            stdout=bytes(self._stdout),
            stderr=bytes(self._stderr),
            cpu_seconds=self._cpu,
            watched_cpu_seconds=self._watched_cpu,
            seconds=seconds,
            stopped=self._stopped or last,
        )


def monitor(
    process: StartedProcess, start: float, task: Task, watched: MonitoredTask, wire: Wire | None = None
) -> MonitorReport:
    """Stays until the process of the task has ended and everything that belongs to it was killed. Nobody else may wait
    for it."""
    return _Watch(process, start, task.limits, watched, wire, task.abandoned).until_the_end()
