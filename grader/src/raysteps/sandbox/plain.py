"""Runs tasks without a keeper, with what every system has: for Windows."""

import os
import shutil
import subprocess
import tempfile
import time
from contextlib import ExitStack, closing
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.families import apart, end_all
from raysteps.common.pipes import PipeReader
from raysteps.common.process import Outcome
from raysteps.sandbox.inside import Inside
from raysteps.sandbox.isolation import Isolation
from raysteps.sandbox.task import Input, Limits, Ran, Stopped, Task
from raysteps.sandbox.windows_job import Job

_MEGABYTE = 1 << 20
_LOOK_EVERY = 0.05
_DYING_SECONDS = 2.0
_OF_THE_SYSTEM = ("COMSPEC", "NUMBER_OF_PROCESSORS", "PATH", "PATHEXT", "SYSTEMDRIVE", "SYSTEMROOT", "WINDIR")


class Plain:
    """Limits on time, and on Windows on memory and processes; nothing keeps the task apart."""

    isolation = Isolation()

    def run(self, task: Task) -> Ran:
        with ExitStack() as stack:
            name = stack.enter_context(tempfile.TemporaryDirectory(prefix="raysteps-run-", ignore_cleanup_errors=True))
            folder = Path(name).resolve()
            inside = Inside(task, lambda n, given: str(_called(given, folder / f"in{n}")))
            for part in ("out", "tmp"):
                (folder / part).mkdir()
            inside.write_to_folder(folder / "out", str(folder / "out"))
            (folder / "stdin").write_bytes(task.stdin)
            stdin = stack.enter_context((folder / "stdin").open("rb"))
            limits = task.limits
            job = stack.enter_context(closing(Job(limits.processes, limits.memory_mb * _MEGABYTE)))
            start = time.monotonic()
            try:
                process = subprocess.Popen(
                    inside.command(),
                    stdin=stdin,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.PIPE,
                    cwd=folder / "tmp",
                    env=_environment(task, folder / "tmp"),
                    **apart(),
                )
            except OSError as error:
                raise GraderFault(f"A command could not be started: {error}") from error
            job.take_in(int(getattr(process, "_handle", 0)))
            pipes = [PipeReader(pipe, limits.output_kb * 1024) for pipe in (process.stdout, process.stderr)]
            try:
                stopped = _wait(process, job, start, limits)
                seconds = time.monotonic() - start
            finally:
                job.end()
                end_all(process)
                code = process.wait()
            until = time.monotonic() + _DYING_SECONDS
            for pipe in pipes:
                pipe.is_at_end(until - time.monotonic())
            out, err = (pipe.bytes().decode("utf-8", "replace") for pipe in pipes)
            return Ran(
                Outcome(code, stopped == "wall", out, err, seconds), inside.outputs(), job.cpu_seconds(), stopped
            )


def _wait(process: "subprocess.Popen[bytes]", job: Job, start: float, limits: Limits) -> Stopped:
    """Until the process has ended, or has used up what it may use."""
    while True:
        left = start + limits.wall_seconds - time.monotonic()
        try:
            process.wait(min(_LOOK_EVERY, max(0.0, left)))
        except subprocess.TimeoutExpired:
            if left <= 0:
                return "wall"
            if job.cpu_seconds() > limits.cpu_seconds:
                return "cpu"
        else:
            return ""


def _called(given: Input, folder: Path) -> Path:
    """The path itself, or the same under the name that the task is to see. A program keeps its ending."""
    source = given.path.absolute()
    name = given.inner_name + (".exe" if source.suffix == ".exe" and not given.inner_name.endswith(".exe") else "")
    if source.name == name:
        return source
    folder.mkdir()
    target = folder / name
    if source.is_dir():
        shutil.copytree(source, target)
        return target
    try:
        os.link(source, target)
    except OSError:  # another drive
        shutil.copy(source, target)
    return target


def _environment(task: Task, scratch: Path) -> dict[str, str]:
    """A compiler finds its libraries by what its command prompt has set; a program gets nothing of that."""
    kept = dict(os.environ) if task.tools else {name: os.environ[name] for name in _OF_THE_SYSTEM if name in os.environ}
    return kept | {"TEMP": str(scratch), "TMP": str(scratch), "TMPDIR": str(scratch), "VSLANG": "1033"}
