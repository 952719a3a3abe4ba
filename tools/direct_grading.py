"""Limits and nothing else, for programs of which every line is the kit's: no keeper stands between, so a run costs what
the program costs. On Linux.
"""

import hashlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
import zlib
from contextlib import ExitStack, suppress
from dataclasses import asdict, replace
from itertools import accumulate, pairwise
from pathlib import Path

from raysteps.common.files import write_bytes
from raysteps.common.process import Outcome
from raysteps.sandbox.beside import Files, TrustedProcess, running_beside, trusted_limits
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.monitor import Usage, descendants, monitor, usage_of
from raysteps.sandbox.namespaces import tool
from raysteps.sandbox.rlimits import prlimit_command, prlimit_options
from raysteps.sandbox.task import Input, Isolation, Output, Sandbox, Task, TaskResult
from raysteps.sandbox.task_dir import PathMap, TaskDir, nameless_file

_TEXTS = ("stdout", "stderr")  # of an outcome
_PATIENCE = 6  # times as long on the clock, where other programs keep the processors busy


class _Group:
    """A program and what it started."""

    def __init__(self, process: "subprocess.Popen[bytes]") -> None:
        self._process = process

    def usage(self) -> Usage:
        return usage_of({self._process.pid} | descendants(self._process.pid))

    def kill(self) -> None:
        with suppress(OSError):
            os.killpg(self._process.pid, signal.SIGKILL)


def _start_trusted(task: Task, files: Files, stack: ExitStack) -> TrustedProcess:
    """Without a fence: the box holds the kit's own code, too."""
    folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="raysteps-run-")))
    inside = PathMap(task, lambda _, given: str(given.path))
    inside.write_to_folder(folder, str(folder))
    process = subprocess.Popen(
        [tool("prlimit"), *prlimit_options(trusted_limits(task.limits)), *inside.command()],
        env=files.environment,
        stdin=files.stdin,
        stdout=files.stdout,
        stderr=files.stderr,
        pass_fds=files.wire,
        cwd=folder,
        start_new_session=True,
    )
    return TrustedProcess(process, lambda code: code, inside.outputs)


class Direct:
    """Limits and nothing else: for programs of which every line is the kit's. The time that one may take is counted
    where it computes, so that a busy machine makes no right file wrong."""

    isolation: Isolation = LimitsOnly.isolation

    def run(self, task: Task) -> TaskResult:
        given = task.limits
        limits = replace(given, wall_seconds=max(given.wall_seconds, _PATIENCE * given.cpu_seconds))
        with ExitStack() as stack:
            asked = stack.enter_context(running_beside(replace(task, limits=limits), _start_trusted))
            wire = None if asked is None else asked.wire
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="raysteps-run-")))
            place = TaskDir(folder, None)
            inside = PathMap(task, lambda _, given: str(place.linked(given.path, given.inner_name)))
            if task.tools:
                inside.write_to_folder(place.writable("out"), str(folder / "out"))
            else:
                inside.write_to_memory(stack)
            command = inside.command()
            environment = {"LC_ALL": "C", "HOME": str(folder), "TMPDIR": str(folder)}
            if task.tools:
                environment["PATH"] = os.pathsep.join(dict.fromkeys((str(Path(command[0]).parent), "/usr/bin", "/bin")))
            start = time.monotonic()
            process = stack.enter_context(
                subprocess.Popen(
                    [*prlimit_command(limits, memory=True), *command],
                    stdin=nameless_file(task.stdin, stack) if wire is None else wire.stdin,
                    stdout=subprocess.PIPE if wire is None else wire.stdout,
                    stderr=subprocess.PIPE,
                    pass_fds=inside.fds,
                    cwd=folder,
                    env=environment,
                    start_new_session=True,
                )
            )
            stack.callback(process.kill)
            if wire is not None:
                wire.hand_over()
            seen = monitor(process, start, replace(task, limits=limits), _Group(process), wire)
            out, err = (data.decode("utf-8", "replace") for data in (seen.stdout, seen.stderr))
            code = -signal.SIGKILL if seen.stopped else seen.status
            outcome = Outcome(code, seen.stopped == "wall", out, err, seen.seconds)
            cpu = max(seen.cpu_seconds, seen.watched_cpu_seconds)
            ran = TaskResult(outcome, inside.outputs(), cpu, seen.stopped)
            return ran if asked is None else asked.result(ran)


# Runs the kit's own programs, each once: what was run before on the same bytes gives the same answer. `dev check`
# hands in a thousand files, and most of what it runs it would run again: a right file beside many wrong ones, a
# mistake that the diagnosis learned already. Nobody's code is strange here, so no keeper stands between; limits stay.


class CachingSandbox:
    """Hands on what was not run yet. Answers lie in `folder`, by what went in; `always` goes into every one of them:
    what is not among a task's words and files, such as the compiler's version. A task that was stopped is run again,
    since a clock stopped it."""

    def __init__(self, sandbox: Sandbox, folder: Path, always: str) -> None:
        self._sandbox = sandbox
        self._folder = folder
        self._always = always
        self._marks: dict[tuple[str, int, int], bytes] = {}
        self._turns: dict[str, threading.Lock] = {}
        self._start = time.time()
        self.asked = self.ran = 0

    @property
    def isolation(self) -> Isolation:
        return self._sandbox.isolation

    def run(self, task: Task) -> TaskResult:
        """Two that ask the same at a time get the answer of one run."""
        key = self._key(task)
        with self._turns.setdefault(key, threading.Lock()):
            self.asked += 1
            kept = self._read(key)
            if kept is not None and kept.outcome.seconds <= task.limits.wall_seconds:
                return kept
            self.ran += 1
            ran = self._sandbox.run(task)
            if not ran.stopped and not ran.outcome.timed_out:
                self._keep(key, ran)
            return ran

    def _place(self, digest: str) -> Path:
        return self._folder / digest[:2] / digest[2:]

    def _keep(self, key: str, ran: TaskResult) -> None:
        """What came out lies apart, by its bytes: most mistakes give the reference's answer to most questions."""
        told = asdict(ran.outcome)
        texts = [str(told.pop(name)).encode() for name in _TEXTS]
        data = b"".join([*texts, *ran.outputs.values()])
        digest = hashlib.sha256(data).hexdigest()
        try:
            os.utime(self._place(digest))
        except OSError:
            write_bytes(self._place(digest), zlib.compress(data, 1))
        sizes = list(map(len, [*texts, *ran.outputs.values()]))
        head = {"outcome": told, "cpu_seconds": ran.cpu_seconds, "data": digest}
        write_bytes(self._place(key), json.dumps(head | {"names": list(ran.outputs), "sizes": sizes}).encode())

    def _read(self, key: str) -> TaskResult | None:
        """None where there is nothing, or not all of it."""
        try:
            head = json.loads(self._place(key).read_bytes())
            data = self._data(self._place(head["data"]))
            os.utime(self._place(key))
            ends = [0, *accumulate(head["sizes"])]
            parts = [data[begin:end] for begin, end in pairwise(ends)]
            head["outcome"] |= {name: part.decode() for name, part in zip(_TEXTS, parts, strict=False)}
            outputs = dict(zip(head["names"], parts[len(_TEXTS) :], strict=True))
            return TaskResult(Outcome(**head["outcome"]), outputs, head["cpu_seconds"], "")
        except (OSError, zlib.error, ValueError, KeyError, TypeError):
            return None

    def _data(self, place: Path) -> bytes:
        try:
            data = zlib.decompress(place.read_bytes())
            os.utime(place)
        except zlib.error:
            place.unlink(missing_ok=True)  # to be written anew
            raise
        return data

    def forget_unused(self) -> None:
        """What nobody asked for since this began."""
        for path in self._folder.glob("??/*"):
            if path.stat().st_mtime < self._start - 1:
                path.unlink(missing_ok=True)

    def _key(self, task: Task) -> str:
        limits = task.limits
        bounds = (limits.memory_mb, limits.processes, limits.file_mb, limits.tmp_mb, limits.output_kb)
        digest = hashlib.sha256(f"{self._always}\0{bounds}\0{task.tools}\0".encode())
        asking = () if task.beside is None else task.beside.command
        for word in (*task.command, "\0", *task.inputs, "\0", *asking):
            match word:
                case Input():
                    digest.update(f"in {word.inner_name}\0".encode() + self._mark(word.path))
                case Output():
                    digest.update(f"out {word.name}\0".encode())
                case _:
                    digest.update(f"word {word}\0".encode())
        digest.update(task.stdin if task.beside is None else task.beside.stdin)
        return digest.hexdigest()

    def _mark(self, path: Path) -> bytes:
        """Of the bytes of a file, or of all files in a folder."""
        if path.is_dir():
            return self._mark_of_folder(path)
        status = path.stat()
        known = (str(path), status.st_mtime_ns, status.st_size)
        if known not in self._marks:
            self._marks[known] = hashlib.sha256(path.read_bytes()).digest()
        return self._marks[known]

    def _mark_of_folder(self, folder: Path) -> bytes:
        """A precompiled header is the header once more, and never the same bytes."""
        files = sorted(path for path in folder.rglob("*") if path.is_file() and path.suffix != ".gch")
        digest = hashlib.sha256()
        for path in files:
            digest.update(f"{path.relative_to(folder).as_posix()}\0".encode() + self._mark(path))
        return digest.digest()


def plain_sandbox() -> Sandbox:
    """Where every program runs again, whatever ran before."""
    return Direct() if sys.platform == "linux" else LimitsOnly()


def sandbox_of_the_kit(folder: Path, always: str) -> CachingSandbox:
    """For what nobody else wrote."""
    return CachingSandbox(plain_sandbox(), folder, always)
