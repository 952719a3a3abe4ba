"""Runs tasks without a keeper, with what every system has: for Windows."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack, closing
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome, PipeReader, drained, kill_process_group, new_session
from raysteps.sandbox.task import Input, Isolation, LimitHit, Task, TaskResult
from raysteps.sandbox.task_dir import PathMap

# A job of Windows: processes that are limited, measured and ended together.

if sys.platform == "win32":
    import ctypes
    from ctypes import wintypes

    _EXTENDED_LIMITS, _ACCOUNTING = 9, 1
    _LIMIT_PROCESSES, _LIMIT_MEMORY, _NO_DIALOG, _END_ON_CLOSE = 0x8, 0x200, 0x400, 0x2000
    _TICKS = 10_000_000  # a second
    _kernel = ctypes.WinDLL("kernel32", use_last_error=True)
    _kernel.CreateJobObjectW.restype = wintypes.HANDLE
    _kernel.CreateJobObjectW.argtypes = [wintypes.LPVOID, wintypes.LPCWSTR]
    _kernel.AssignProcessToJobObject.argtypes = [wintypes.HANDLE, wintypes.HANDLE]
    _kernel.TerminateJobObject.argtypes = [wintypes.HANDLE, wintypes.UINT]
    _kernel.CloseHandle.argtypes = [wintypes.HANDLE]
    _INFORMATION = [wintypes.HANDLE, ctypes.c_int, wintypes.LPVOID, wintypes.DWORD]
    _kernel.SetInformationJobObject.argtypes = _INFORMATION
    _kernel.QueryInformationJobObject.argtypes = [*_INFORMATION, wintypes.LPVOID]

    class _Limits(ctypes.Structure):
        """JOBOBJECT_EXTENDED_LIMIT_INFORMATION"""

        _fields_ = (
            ("process_time", ctypes.c_int64),
            ("job_time", ctypes.c_int64),
            ("flags", wintypes.DWORD),
            ("least_working_set", ctypes.c_size_t),
            ("most_working_set", ctypes.c_size_t),
            ("processes", wintypes.DWORD),
            ("affinity", ctypes.c_size_t),
            ("priority", wintypes.DWORD),
            ("scheduling", wintypes.DWORD),
            ("io", ctypes.c_uint64 * 6),
            ("process_memory", ctypes.c_size_t),
            ("job_memory", ctypes.c_size_t),
            ("peak_process_memory", ctypes.c_size_t),
            ("peak_job_memory", ctypes.c_size_t),
        )

    class _Accounting(ctypes.Structure):
        """JOBOBJECT_BASIC_ACCOUNTING_INFORMATION"""

        _fields_ = (
            ("user", ctypes.c_int64),
            ("system", ctypes.c_int64),
            ("this_period", ctypes.c_int64 * 2),
            ("counts", wintypes.DWORD * 4),
        )

    class Job:
        """Ends with all that is in it when it is closed, however the grader ends."""

        def __init__(self, processes: int, memory_bytes: int) -> None:
            self._handle = _kernel.CreateJobObjectW(None, None)
            limits = _Limits(processes=processes, job_memory=memory_bytes)
            limits.flags = _LIMIT_PROCESSES | _LIMIT_MEMORY | _NO_DIALOG | _END_ON_CLOSE
            _kernel.SetInformationJobObject(self._handle, _EXTENDED_LIMITS, ctypes.byref(limits), ctypes.sizeof(limits))

        def take_in(self, process_handle: int) -> None:
            """Whatever the process starts from now on is in the job, too. It may have ended already."""
            _kernel.AssignProcessToJobObject(self._handle, process_handle)

        def cpu_seconds(self) -> float:
            used = _Accounting()
            _kernel.QueryInformationJobObject(self._handle, _ACCOUNTING, ctypes.byref(used), ctypes.sizeof(used), None)
            return float(used.user + used.system) / _TICKS

        def end(self) -> None:
            _kernel.TerminateJobObject(self._handle, 1)

        def close(self) -> None:
            _kernel.CloseHandle(self._handle)

else:

    class Job:
        """Elsewhere there is none."""

        def __init__(self, processes: int, memory_bytes: int) -> None:
            """Nothing is limited."""

        def take_in(self, process_handle: int) -> None: ...

        def cpu_seconds(self) -> float:
            return 0.0

        def end(self) -> None: ...

        def close(self) -> None: ...


_MEGABYTE = 1 << 20
_POLL_SECONDS = 0.05
_DYING_SECONDS = 2.0
_OF_THE_SYSTEM = ("COMSPEC", "NUMBER_OF_PROCESSORS", "PATH", "PATHEXT", "SYSTEMDRIVE", "SYSTEMROOT", "WINDIR")


class UnsupervisedSandbox:
    """Limits on time, and on Windows on memory and processes; nothing keeps the task apart."""

    isolation = Isolation()

    def run(self, task: Task) -> TaskResult:
        with ExitStack() as stack:
            name = stack.enter_context(tempfile.TemporaryDirectory(prefix="raysteps-run-", ignore_cleanup_errors=True))
            folder = Path(name).resolve()
            inside = PathMap(task, lambda n, given: str(_called(given, folder / f"in{n}")))
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
                    **new_session(),
                )
            except OSError as error:
                raise GraderFault(f"A command could not be started: {error}") from error
            job.take_in(int(getattr(process, "_handle", 0)))
            pipes = [PipeReader(pipe, limits.output_kb * 1024) for pipe in (process.stdout, process.stderr)]
            try:
                stopped = _wait(process, job, start, task)
                seconds = time.monotonic() - start
            finally:
                job.end()
                kill_process_group(process)
                code = process.wait()
            out, err = drained(pipes, _DYING_SECONDS)
            return TaskResult(
                Outcome(code, stopped == "wall", out, err, seconds), inside.outputs(), job.cpu_seconds(), stopped
            )


def _wait(process: "subprocess.Popen[bytes]", job: Job, start: float, task: Task) -> LimitHit:
    """Until the process has ended, or has used up what it may use."""
    limits = task.limits
    while True:
        left = start + limits.wall_seconds - time.monotonic()
        try:
            process.wait(min(_POLL_SECONDS, max(0.0, left)))
        except subprocess.TimeoutExpired:
            if left <= 0 or task.abandoned.is_set():
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
