"""The strong sandbox: bubblewrap, with fresh namespaces and a file system that holds nothing but the task."""

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
from raysteps.sandbox.cgroups import Group, find_parents, new_group
from raysteps.sandbox.control import Control, readable
from raysteps.sandbox.inside import Inside, nameless_file
from raysteps.sandbox.isolation import Isolation
from raysteps.sandbox.mounts import compiler_command, root_words
from raysteps.sandbox.processes import Usage, adopting_orphans, descendants, reap, usage_of
from raysteps.sandbox.rlimits import counts_per_namespace, limit_words, threads_of_user
from raysteps.sandbox.seccomp import syscall_filter
from raysteps.sandbox.task import Input, Limits, Ran, Task
from raysteps.sandbox.users import can_lend_users, lent_user
from raysteps.sandbox.watching import Seen, watch
from raysteps.sandbox.workplace import Workplace, fresh_workplace

_MEGABYTE = 1 << 20
_DYING_SECONDS = 5.0
_OUTPUTS = "/out"
_OWN_PROCESSES = 2  # bubblewrap itself, and the first process inside, which waits for the others
_SIGNALS = range(129, 129 + signal.NSIG)
_NAMESPACES = ("--unshare-all", "--unshare-user", "--disable-userns", "--die-with-parent", "--new-session")


class _Running:
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


def _outcome(seen: Seen, code: int | None) -> Outcome:
    """bubblewrap turns the signal that ended a command into an exit code; this turns it back."""
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


class Bubblewrap:
    """Every task in namespaces of its own; as root, also as a user of its own."""

    def __init__(self, secrets: tuple[Path, ...] = ()) -> None:
        program = shutil.which("bwrap")
        if program is None:
            raise GraderFault("bubblewrap is not installed (the program bwrap was not found).")
        self._program = program
        self._secrets = list(secrets)
        self._lends_users = can_lend_users()
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

    def _inside(self, task: Task, place: Workplace, stack: ExitStack) -> tuple[Inside, list[str]]:
        mounts: list[str] = []

        def locate(number: int, given: Input) -> str:
            inner = f"/in/{number}/{given.inner_name}"
            mounts.extend(["--ro-bind", str(place.readable(given.path)), inner])
            return inner

        inside = Inside(task, locate)
        if task.tools:
            folder = place.writable("out")
            inside.write_to_folder(folder, _OUTPUTS)
            mounts.extend(["--bind", str(folder), _OUTPUTS])
        else:
            inside.write_to_memory(stack)
        return inside, mounts

    def _words(self, task: Task, inside: Inside, mounts: list[str], control: Control) -> list[str]:
        limits = task.limits
        first = task.command[0]
        compiler = compiler_command(first if isinstance(first, str) else "c++") if task.tools else None
        own = limits.processes + _OWN_PROCESSES if self._lends_users else None
        words = limit_words(limits, processes=own, memory=self._parents is None)
        words += [self._program, *_NAMESPACES, "--hostname", "sandbox", "--clearenv"]
        words += ["--setenv", "LC_ALL", "C", "--setenv", "HOME", "/tmp"]  # noqa: S108  (its own)
        if compiler is not None:
            words += ["--setenv", "PATH", os.pathsep.join(dict.fromkeys((str(compiler.parent), "/usr/bin")))]
        words += root_words(compiler, self._secrets, limits.tmp_mb * _MEGABYTE)
        words += [*mounts, "--remount-ro", "/", "--chdir", "/tmp"]  # noqa: S108
        return [*words, *control.words(), "--", *inside.command()]

    def _limit_processes(self, first: int, limits: Limits) -> None:
        """Of an ordinary user, whose other processes must not count: set from outside, inside the namespace."""
        if not self._lends_users:
            others = 0 if counts_per_namespace() else threads_of_user(os.getuid())
            most = others + limits.processes + _OWN_PROCESSES
            _, hard = resource.prlimit(first, resource.RLIMIT_NPROC)
            most = most if hard == resource.RLIM_INFINITY else min(most, hard)
            resource.prlimit(first, resource.RLIMIT_NPROC, (most, most))

    def run(self, task: Task) -> Ran:
        with ExitStack() as stack:
            stack.enter_context(adopting_orphans())
            user = stack.enter_context(lent_user()) if self._lends_users else None
            place = stack.enter_context(fresh_workplace(user))
            group = stack.enter_context(new_group(self._parents, task.limits)) if self._parents else None
            inside, mounts = self._inside(task, place, stack)
            control = Control(stack)
            fences = [] if self._filter is None else [nameless_file(self._filter, stack)]
            mounts += [word for fd in fences for word in ("--seccomp", str(fd))]
            stdin = nameless_file(task.stdin, stack)
            start = time.monotonic()
            process = stack.enter_context(
                subprocess.Popen(
                    self._words(task, inside, mounts, control),
                    stdin=stdin,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    pass_fds=(control.status_fd, control.gate_fd, *inside.fds, *fences),
                    cwd="/",
                    user=user,
                    group=user,
                    extra_groups=None if user is None else [],
                )
            )
            stack.callback(process.kill)
            control.hand_over()
            first = control.first_process()
            if first is None:
                raise self._cannot_start(process)
            running = _Running(process, first, group)
            stack.callback(running.close)
            stack.callback(running.kill)
            if group is not None:
                group.join(first)
            self._limit_processes(first, task.limits)
            control.open_gate()
            seen = watch(process, start, task.limits, running)
            # What the kernel ended with its namespace, nobody waited for; there the last look has to do.
            cpu = max(seen.cpu_seconds + running.reap(), seen.watched_cpu_seconds)
            code = control.exit_code()
            if code is None and not seen.stopped and seen.status not in (-signal.SIGKILL, 128 + signal.SIGKILL):
                raise GraderFault(f"bubblewrap failed: {shorten(printable(seen.stderr.decode('utf-8', 'replace')))}")
            return Ran(_outcome(seen, code), inside.outputs(), cpu, seen.stopped)

    def _cannot_start(self, process: "subprocess.Popen[bytes]") -> GraderFault:
        assert process.stderr is not None
        process.kill()
        said = process.stderr.read().decode("utf-8", "replace")
        return GraderFault(f"bubblewrap cannot make a sandbox: {shorten(printable(said))}")
