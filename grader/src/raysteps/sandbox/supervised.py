"""Runs tasks under the keeper: what the sandboxes without namespaces have in common."""

import math
import os
import signal
import sys
import time
from collections.abc import Iterator
from contextlib import ExitStack, nullcontext, suppress
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome
from raysteps.common.text import join_and, printable, shorten
from raysteps.sandbox.beside import Files, TrustedProcess, readable, running_beside, trusted_limits
from raysteps.sandbox.keepers import start_keeper
from raysteps.sandbox.lockdown import landlock_version, scopes_signals, syscall_filter
from raysteps.sandbox.monitor import (
    MonitorReport,
    Usage,
    adopting_orphans,
    descendants,
    monitor,
    usage_of,
)
from raysteps.sandbox.namespaces import compiler_command, hidden_folders, top_folders, visible_folders
from raysteps.sandbox.rlimits import address_space, cpu_seconds_of_a_process, threads_of_user
from raysteps.sandbox.task import Input, Isolation, Limits, StartedProcess, Task, TaskResult
from raysteps.sandbox.task_dir import PathMap, TaskDir, fresh_task_dir, nameless_file
from raysteps.sandbox.users import can_lend_users, lent_user

_MEGABYTE = 1 << 20
_GRACE_SECONDS = 1.0
_LINUX = sys.platform == "linux"


class _Family:
    """The keeper and what it keeps."""

    def __init__(self, process: StartedProcess) -> None:
        self._process = process
        self._known: set[int] = set()
        self._asked_at: float | None = None

    def usage(self) -> Usage:
        if not _LINUX:
            return Usage()
        found = descendants(self._process.pid)
        self._known |= found
        return usage_of(found)

    def kill(self) -> None:
        """Asks the keeper to end everything; if it does not, as when it was killed itself, does so in its place."""
        now = time.monotonic()
        self._asked_at = self._asked_at or now
        if self._process.returncode is None and now < self._asked_at + _GRACE_SECONDS:
            self._process.terminate()
            return
        if _LINUX:
            self._hunt()
        if self._process.returncode is None:
            self._process.kill()

    def _hunt(self) -> None:
        """Whatever was seen below the keeper; its orphans are this process's children now."""
        for pid in self._known & descendants(os.getpid()) - {self._process.pid}:
            with suppress(OSError):
                os.kill(pid, signal.SIGKILL)
                os.waitpid(pid, 0)


class SupervisedSandbox:
    """A sandbox whose tasks run under the keeper. What is in force is for its children to say."""

    isolation = Isolation()
    _lends_users = False

    def _locate(self, place: TaskDir, given: Input, *, to_run: bool) -> Path:
        """Makes an input readable for the task."""
        raise NotImplementedError

    def _fences(self, task: Task, inputs: list[Path], folders: list[Path]) -> dict[str, Any] | None:
        """What the keeper closes before it starts the command."""
        raise NotImplementedError

    def _limits(self, limits: Limits) -> dict[str, int]:
        others = 0 if self._lends_users or not _LINUX else threads_of_user(os.getuid())
        seconds = cpu_seconds_of_a_process(limits) if _LINUX else math.ceil(limits.cpu_seconds)
        bounds = {"RLIMIT_CORE": 0, "RLIMIT_FSIZE": limits.file_mb * _MEGABYTE, "RLIMIT_CPU": seconds}
        if _LINUX:
            bounds |= {"RLIMIT_AS": address_space(limits), "RLIMIT_NPROC": others + limits.processes}
        return bounds

    def run(self, task: Task) -> TaskResult:
        with ExitStack() as stack:
            stack.enter_context(adopting_orphans() if _LINUX else nullcontext())
            inside, settings = self._prepare(task, self._limits(task.limits), stack)
            return self._keep(task, inside, settings, stack)

    def _prepare(self, task: Task, limits: dict[str, int], stack: ExitStack) -> tuple[PathMap, dict[str, Any]]:
        """The names of the task's files, and what its keeper is told."""
        user = stack.enter_context(lent_user()) if self._lends_users else None
        place = stack.enter_context(fresh_task_dir(user))
        inputs: list[Path] = []

        def locate(_: int, given: Input) -> str:
            inputs.append(self._locate(place, given, to_run=task.is_program(given)))
            return str(inputs[-1])

        inside = PathMap(task, locate)
        scratch = place.writable("tmp")
        folders = [scratch]
        if task.tools or not _LINUX:
            folders.append(place.writable("out"))
            inside.write_to_folder(folders[-1], str(folders[-1]))
        else:
            inside.write_to_memory(stack)
        return inside, {
            "limits": limits,
            "user": user,
            "folder": str(scratch),
            "environment": _environment(task, inside.command()[0], scratch),
            "fences": self._fences(task, inputs, folders),
        }

    def _start_trusted(self, task: Task, files: Files, stack: ExitStack) -> TrustedProcess:
        """As it starts a task, so that it finds no more than one does."""
        inside, settings = self._prepare(task, trusted_limits(task.limits), stack)
        status, status_end = os.pipe()
        stack.callback(os.close, status)
        settings |= {"status": status_end, "environment": files.environment}
        open_files = (status_end, *inside.fds, *files.wire)
        try:
            keeper = start_keeper(
                settings,
                inside.command(),
                stdin=files.stdin,
                stdout=files.stdout,
                stderr=files.stderr,
                files=open_files,
            )
        finally:
            os.close(status_end)

        def exit_code(ended: int) -> int | None:
            said = os.read(status, 64) if readable(status, 0) else b""
            if not said:
                return -signal.SIGKILL if ended == -signal.SIGKILL else None
            return int(said) if said.lstrip(b"-").isdigit() else None

        return TrustedProcess(keeper, exit_code, inside.outputs)

    def _keep(self, task: Task, inside: PathMap, settings: dict[str, Any], stack: ExitStack) -> TaskResult:
        asked = stack.enter_context(running_beside(task, self._start_trusted))
        wire = None if asked is None else asked.wire
        status, status_end = os.pipe()
        stack.callback(os.close, status)
        stdin = nameless_file(task.stdin, stack) if wire is None else wire.stdin
        start = time.monotonic()
        stdout = None if wire is None else wire.stdout
        files = (status_end, *inside.fds)
        settings |= {"status": status_end}
        try:
            process = stack.enter_context(
                start_keeper(settings, inside.command(), stdin=stdin, stdout=stdout, files=files)
            )
        finally:
            os.close(status_end)
        stack.callback(process.kill)
        if wire is not None:
            wire.hand_over()
        seen = monitor(process, start, task, _Family(process), wire)
        said = os.read(status, 64) if readable(status, 0) else b""
        cpu = max(seen.cpu_seconds, seen.watched_cpu_seconds)
        outcome = _outcome(seen, said)
        stopped = "cpu" if _ended_by_the_system(outcome, cpu, task.limits) else seen.stopped
        ran = TaskResult(outcome, inside.outputs(), cpu, stopped)
        return ran if asked is None else asked.result(ran)


def _ended_by_the_system(outcome: Outcome, cpu_seconds: float, limits: Limits) -> bool:
    """For its processor time, where this process cannot see how much that is."""
    by_signal = outcome.code in (-signal.SIGXCPU, -signal.SIGKILL)
    return not _LINUX and by_signal and cpu_seconds >= limits.cpu_seconds


def _environment(task: Task, program: str, scratch: Path) -> dict[str, str]:
    """Nothing of the grader's own."""
    environment = {"LC_ALL": "C", "HOME": str(scratch), "TMPDIR": str(scratch)}
    if task.tools:
        environment["PATH"] = os.pathsep.join(dict.fromkeys((str(Path(program).parent), "/usr/bin", "/bin")))
    return environment


def _outcome(seen: MonitorReport, said: bytes) -> Outcome:
    err = seen.stderr.decode("utf-8", "replace")
    if said.startswith(b"cannot start"):
        raise GraderFault(f"A command could not be started: {shorten(printable(err))}")
    if not said and not seen.stopped and seen.status != -signal.SIGKILL:
        raise GraderFault(f"The keeper of a task failed: {shorten(printable(err))}")
    return Outcome(
        code=int(said) if said and not seen.stopped else -signal.SIGKILL,
        timed_out=seen.stopped == "wall",
        stdout=seen.stdout.decode("utf-8", "replace"),
        stderr=err,
        seconds=seen.seconds,
    )


# Where namespaces are refused, as in many containers: another user, Landlock and a filter of system calls, as far as
# they are there.

_DEVICES = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")
_LOADER_CACHE = "/etc/ld.so.cache"


def _without(folder: Path, hidden: list[Path]) -> Iterator[str]:
    """The folder, or, because a permission cannot have an exception, all of its parts but the hidden ones."""
    if folder in hidden:
        return
    if any(path.is_relative_to(folder) for path in hidden):
        for entry in folder.iterdir():
            yield from _without(entry, hidden)
    else:
        yield str(folder)


class Lockdown(SupervisedSandbox):
    """Not strong: the task shares the machine's processes with the grader, and its limits count by process."""

    def __init__(self, secrets: tuple[Path, ...] = ()) -> None:
        self._secrets = list(secrets)
        self._lends_users = can_lend_users()
        self._version = landlock_version()
        self._filter = syscall_filter()
        if not self._lends_users and not self._version:
            raise GraderFault("there is no Landlock in this kernel, and only root can run code as another user")
        self.isolation = Isolation(
            "other user" if self._lends_users else "landlock", strong=False, description=self._describe()
        )

    def _describe(self) -> str:
        there: list[str] = []
        lacking: list[str] = []
        if self._lends_users:
            there.append("as a user of its own")
        if self._version:
            there.append("with its files limited by Landlock")
        else:
            lacking.append("it could read every file that is open to all users")
        if self._filter is not None:
            there.append("without network")
        elif self._version < 4:
            lacking.append("it could use the network")
        if not self._lends_users and not scopes_signals(self._version):
            lacking.append("it could end processes of the grader's user")
        lacking += ["it could see that other processes run", "memory was watched, not fenced off"]
        return f"The code ran {join_and(there)}. There were no namespaces: {join_and(lacking)}."

    def _locate(self, place: TaskDir, given: Input, *, to_run: bool) -> Path:
        return place.copied(given.path, given.inner_name, to_run=to_run)

    def _fences(self, task: Task, inputs: list[Path], folders: list[Path]) -> dict[str, Any] | None:
        first = task.command[0]
        compiler = compiler_command(first if isinstance(first, str) else "c++") if task.tools else None
        files = None
        if self._version:
            seen = [*visible_folders(compiler), *top_folders(compiler)]
            hidden = hidden_folders(seen, self._secrets)
            readable = [part for folder in seen for part in _without(folder, hidden)]
            readable += [_LOADER_CACHE, *(str(path) for path in inputs)]
            # A student's program has its outputs as open files; it needs no folder to write to.
            writable = [*_DEVICES, *(str(path) for path in folders if task.tools)]
            files = {"readable": readable, "writable": writable}
        return {"files": files, "system_calls": None if self._filter is None else self._filter.hex()}
