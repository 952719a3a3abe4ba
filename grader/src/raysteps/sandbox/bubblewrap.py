"""The strong sandbox: bubblewrap, with fresh namespaces and a file system that holds nothing but the task."""

import json
import os
import resource
import shutil
import signal
import subprocess
import time
from contextlib import ExitStack, suppress
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome
from raysteps.common.text import printable, shorten
from raysteps.sandbox.beside import Files, TrustedProcess, readable, running_beside, trusted_limits, unwrapped
from raysteps.sandbox.cgroups import Cgroup, find_parents, new_cgroup
from raysteps.sandbox.lockdown import syscall_filter
from raysteps.sandbox.monitor import MonitorReport, Usage, adopting_orphans, descendants, monitor, reap, usage_of
from raysteps.sandbox.namespaces import AsUser, NamespaceMode, compiler_command, root_words, tool
from raysteps.sandbox.rlimits import counts_per_namespace, prlimit_command, prlimit_options, threads_of_user
from raysteps.sandbox.task import Input, Isolation, Limits, Task, TaskResult
from raysteps.sandbox.task_dir import PathMap, TaskDir, fresh_task_dir, nameless_file
from raysteps.sandbox.users import can_lend_users, lent_user

# The two pipes between the grader and a bubblewrap: it says who its first process is and how the command ended, and
# it waits for a sign before it starts the command.

_START_SECONDS = 60.0  # on a machine that stands still for a while


class StartupPipes:
    """Holds the grader's ends until the stack is left."""

    def __init__(self, stack: ExitStack) -> None:
        self._status, self.status_fd = os.pipe()
        self.gate_fd, self._gate = os.pipe()
        self._open = {self._status, self.status_fd, self.gate_fd, self._gate}
        stack.callback(lambda: self._close(*self._open))
        self._said = b""

    def _close(self, *fds: int) -> None:
        for fd in self._open & set(fds):
            self._open.remove(fd)
            os.close(fd)

    def words(self) -> list[str]:
        return ["--json-status-fd", str(self.status_fd), "--block-fd", str(self.gate_fd)]

    def hand_over(self) -> None:
        """The other ends are bubblewrap's now."""
        self._close(self.status_fd, self.gate_fd)

    def first_process(self) -> int | None:
        """The process that is number 1 inside; none when bubblewrap could not make it."""
        until = time.monotonic() + _START_SECONDS
        while b"\n" not in self._said and readable(self._status, until - time.monotonic()):
            part = os.read(self._status, 4096)
            if not part:
                return None
            self._said += part
        return int(json.loads(self._said.split(b"\n")[0])["child-pid"]) if b"\n" in self._said else None

    def open_gate(self) -> None:
        os.write(self._gate, b"\n")
        self._close(self._gate)

    def exit_code(self) -> int | None:
        """Of the command; none when it was never started, or killed. To be asked when bubblewrap has ended."""
        while readable(self._status, 0) and (part := os.read(self._status, 4096)):
            self._said += part
        for line in self._said.splitlines():
            said = json.loads(line)
            if "exit-code" in said:
                return int(said["exit-code"])
        return None


# A bubblewrap that runs: what its processes use, how they end, and what that means for the task.

_DYING_SECONDS = 60.0  # of processes that the kernel has killed already, however busy it is


class NamespacedTask:
    """The processes of one task, from outside."""

    def __init__(self, process: "subprocess.Popen[bytes]", first: int, group: Cgroup | None) -> None:
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


def outcome(seen: MonitorReport, code: int | None) -> Outcome:
    """No code: the command was killed."""
    code = -signal.SIGKILL if seen.stopped or code is None else unwrapped(code)
    return Outcome(
        code=code,
        timed_out=seen.stopped == "wall",
        stdout=seen.stdout.decode("utf-8", "replace"),
        stderr=seen.stderr.decode("utf-8", "replace"),
        seconds=seen.seconds,
    )


_MEGABYTE = 1 << 20
_OUTPUTS = "/out"
_HOME = "/tmp"  # noqa: S108  (its own, inside)
_OWN_PROCESSES = 2
_KILLED = (-signal.SIGKILL, 128 + signal.SIGKILL)


class Bubblewrap:
    """Every task in namespaces of its own; as root, also as a user of its own."""

    def __init__(self, secrets: tuple[Path, ...] = (), mode: NamespaceMode | None = None) -> None:
        program = shutil.which("bwrap")
        if program is None:
            raise GraderFault("bubblewrap is not installed (the program bwrap was not found).")
        self._program = program
        self._options = _options_of(program)
        self._secrets = secrets
        self._mode = mode or AsUser()
        self._lends_users = can_lend_users()
        if not (self._mode.starts_as_user or self._lends_users):
            raise GraderFault("only root can make namespaces without a user namespace.")
        self._parents = find_parents()
        self._filter = syscall_filter()
        self.isolation = Isolation("bubblewrap", strong=True, description=self._describe())

    def _describe(self) -> str:
        together = (
            "Memory, CPU time and processes were limited by a control group."
            if self._parents is not None
            else "Memory and CPU time of all processes together were watched every 50 ms."
        )
        user = " as a user of its own," if self._lends_users else ""
        return (
            f"The code ran in bubblewrap,{user} without network, without the grader's files and processes, "
            f"with an empty file system for scratch. {together}"
        )

    def _inside(self, task: Task, place: TaskDir, stack: ExitStack, *, trusted: bool) -> tuple[PathMap, list[str]]:
        """The names inside, and the words that mount them."""
        mounts: list[str] = []

        def locate(number: int, given: Input) -> str:
            inner = f"/in/{number}/{given.inner_name}"
            to_run = task.is_program(given)
            # The list of mounts, which a task can read, has the host's names; a copy has none to tell.
            if trusted or given.name is None:
                shown = place.readable(given.path, to_run=to_run)
            else:
                shown = place.copied(given.path, given.name, to_run=to_run)
            mounts.extend(["--ro-bind", str(shown), inner])
            return inner

        inside = PathMap(task, locate)
        if task.tools or trusted:
            folder = place.writable("out")
            inside.write_to_folder(folder, _OUTPUTS)
            mounts.extend(["--bind", str(folder), _OUTPUTS])
        else:
            inside.write_to_memory(stack)
        return inside, mounts

    def _start_words(self, task: Task, user: int | None) -> list[str]:
        """What sets the limits and becomes the user."""
        return prlimit_command(task.limits, memory=self._parents is None) + self._mode.before_start(task.limits, user)

    def _words(
        self, task: Task, inside: PathMap, words_inside: list[str], user: int | None
    ) -> tuple[list[str], list[str]]:
        """bubblewrap's options, and the command inside."""
        first = task.command[0]
        compiler = compiler_command(first if isinstance(first, str) else "c++") if task.tools else None
        mounts, before = self._mode.before_command(task.limits, user)
        words = [*self._mode.namespaces(self._options), "--die-with-parent", "--new-session"]
        words += ["--hostname", "sandbox", "--clearenv", "--setenv", "LC_ALL", "C", "--setenv", "HOME", _HOME]
        if compiler is not None:
            words += ["--setenv", "PATH", os.pathsep.join(dict.fromkeys((str(compiler.parent), "/usr/bin")))]
        root = root_words(compiler, self._secrets)
        words += [*self._mode.folders([*root, *mounts, *words_inside]), *root]
        words += self._scratch(task)
        words += [*mounts, *words_inside, "--remount-ro", "/", "--chdir", _HOME]
        return words, [*before, *inside.command()]

    def _scratch(self, task: Task) -> list[str]:
        words = self._mode.around_tmp()
        if "--size" in self._options:
            return [*words, "--size", str(task.limits.tmp_mb * _MEGABYTE), "--tmpfs", _HOME]
        # An older bubblewrap cannot limit it. A compiler needs it; a student's program does without.
        return [*words, "--tmpfs", _HOME, *([] if task.tools else ["--remount-ro", _HOME])]

    def _limit_processes(self, first: int, limits: Limits) -> None:
        """Of an ordinary user, whose other processes must not count: set from outside, inside the namespace."""
        if not self._lends_users:
            others = 0 if counts_per_namespace() else threads_of_user(os.getuid())
            most = others + limits.processes + _OWN_PROCESSES
            _, hard = resource.prlimit(first, resource.RLIMIT_NPROC)
            most = most if hard == resource.RLIM_INFINITY else min(most, hard)
            resource.prlimit(first, resource.RLIMIT_NPROC, (most, most))

    def _filters(self, stack: ExitStack) -> tuple[list[int], list[str]]:
        """Open files with the filter of system calls, and the words for them."""
        fences = [] if self._filter is None else [nameless_file(self._filter, stack)]
        return fences, [word for fd in fences for word in ("--seccomp", str(fd))]

    def _start_trusted(self, task: Task, files: Files, stack: ExitStack) -> TrustedProcess:
        """In namespaces of its own, as another user than the box's: it sees its inputs and the system's libraries, and
        writes to the folder of its outputs."""
        user = stack.enter_context(lent_user()) if self._lends_users else None
        place = stack.enter_context(fresh_task_dir(user))
        inside, words = self._inside(task, place, stack, trusted=True)
        control = StartupPipes(stack)
        fences, filters = self._filters(stack)
        words += ["--json-status-fd", str(control.status_fd), *filters]
        for name, value in files.environment.items():
            words += ["--setenv", name, value]
        words += sorted(self._options & {"--as-pid-1"})  # bubblewrap waits for it, and tells what it used
        options, command = self._words(task, inside, words, user)
        options_fd = nameless_file("".join(f"{word}\0" for word in options).encode(), stack)
        process = subprocess.Popen(
            [
                *(tool("prlimit"), *prlimit_options(trusted_limits(task.limits))),
                *self._mode.before_start(task.limits, user),
                *(self._program, "--args", str(options_fd), "--"),
                *command,
            ],
            env={},
            stdin=files.stdin,
            stdout=files.stdout,
            stderr=files.stderr,
            pass_fds=(control.status_fd, options_fd, *fences, *files.wire),
            cwd="/",
            start_new_session=True,  # Ctrl-C is for the grader
        )
        stack.callback(_end, process)
        control.hand_over()

        def exit_code(status: int) -> int | None:
            code = control.exit_code()
            return unwrapped(code) if code is not None else -signal.SIGKILL if status in _KILLED else None

        return TrustedProcess(process, exit_code, inside.outputs)

    def run(self, task: Task) -> TaskResult:
        with ExitStack() as stack:
            asked = stack.enter_context(running_beside(task, self._start_trusted))
            wire = None if asked is None else asked.wire
            stack.enter_context(adopting_orphans())
            user = stack.enter_context(lent_user()) if self._lends_users else None
            place = stack.enter_context(fresh_task_dir(user))
            group = stack.enter_context(new_cgroup(self._parents, task.limits)) if self._parents else None
            inside, words = self._inside(task, place, stack, trusted=False)
            control = StartupPipes(stack)
            stdin = nameless_file(task.stdin, stack) if wire is None else wire.stdin
            fences, filters = self._filters(stack)
            words += [*control.words(), *filters]
            options, command = self._words(task, inside, words, user)
            # As a file, since the first process inside shows its words to the task.
            options_fd = nameless_file("".join(f"{word}\0" for word in options).encode(), stack)
            start = time.monotonic()
            process = stack.enter_context(
                subprocess.Popen(
                    [*self._start_words(task, user), self._program, "--args", str(options_fd), "--", *command],
                    env={},  # of the first process inside, whatever --clearenv does for the command
                    stdin=stdin,
                    stdout=subprocess.PIPE if wire is None else wire.stdout,
                    stderr=subprocess.PIPE,
                    pass_fds=(control.status_fd, control.gate_fd, options_fd, *inside.fds, *fences),
                    cwd="/",
                    start_new_session=True,  # Ctrl-C is for the grader
                )
            )
            stack.callback(_end, process)
            control.hand_over()
            if wire is not None:
                wire.hand_over()
            first = control.first_process()
            if first is None:
                raise _cannot_start(process)
            running = NamespacedTask(process, first, group)
            stack.callback(running.close)
            stack.callback(running.kill)
            if group is not None:
                group.join(first)
            self._limit_processes(first, task.limits)
            if not task.tools:
                _offer_to_the_kernel(first)
            control.open_gate()
            seen = monitor(process, start, task, running, wire)
            # What the kernel ended with its namespace, nobody waited for; there the last look has to do.
            cpu = max(seen.cpu_seconds + running.reap(), seen.watched_cpu_seconds)
            if group is not None:
                group.require_memory_of_the_machine()
            code = control.exit_code()
            if code is None and not seen.stopped and seen.status not in _KILLED:
                raise _failed(seen)
            ran = TaskResult(outcome(seen, code), inside.outputs(), cpu, seen.stopped)
            return ran if asked is None else asked.result(ran)


def _offer_to_the_kernel(first: int) -> None:
    """Where the machine has no more memory, the kernel is to end the largest program of a submission, and no grader and
    no compiler, each of which is larger than one of a crowd."""
    with suppress(OSError):
        Path(f"/proc/{first}/oom_score_adj").write_text("1000", encoding="ascii")


def _options_of(program: str) -> frozenset[str]:
    """What this version can do."""
    said = subprocess.run([program, "--help"], capture_output=True, check=False, timeout=_START_SECONDS, text=True)
    return frozenset(word for word in (said.stdout + said.stderr).split() if word.startswith("--"))


def _end(process: "subprocess.Popen[bytes]") -> None:
    """With its group: a bubblewrap that ends early leaves a child that waits for it, and has its pipes, for ever."""
    if process.returncode is None:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)


def _cannot_start(process: "subprocess.Popen[bytes]") -> GraderFault:
    assert process.stderr is not None
    _end(process)
    said = process.stderr.read().decode("utf-8", "replace")
    return GraderFault(f"bubblewrap cannot make a sandbox: {shorten(printable(said).strip())}")


def _failed(seen: MonitorReport) -> GraderFault:
    said = seen.stderr.decode("utf-8", "replace")
    return GraderFault(f"bubblewrap failed: {shorten(printable(said).strip())}")
