"""What runs beside the loop, in processes of its own: one job at a time, and one look into a pixel."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Literal

from raysteps.common.documents import Malformed, convert
from raysteps.common.process import kill_process_group, new_session
from raysteps.common.text import printable, shorten
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.watch.events import InspectEnded, Post, WorkerEnded, WorkerLine, WorkerMessage

# One job at a time; a new job stops the one before it.

Kind = Literal["look", "check"]

WORKER = (sys.executable, "-P", "-m", "raysteps.watch.worker")
_GRACE_SECONDS = 2.0  # to end what it started
_MAX_ERRORS = 2000


@dataclass
class _Process:
    """A worker that waits for its job, or does it; all that it makes lies in its folder."""

    popen: "subprocess.Popen[str]"
    folder: Path
    errors: IO[str]

    def end(self) -> None:
        """With its group, in which the keepers of its sandbox end what they started, and its folder: a worker that was
        stopped could not clear it."""
        if sys.platform != "win32" and self.popen.poll() is None:
            with suppress(OSError, subprocess.TimeoutExpired):
                os.killpg(self.popen.pid, signal.SIGTERM)
                self.popen.wait(_GRACE_SECONDS)
        if self.popen.poll() is None:
            kill_process_group(self.popen)
            self.popen.wait()
        for stream in (self.popen.stdin, self.errors):
            with suppress(OSError):
                if stream is not None:
                    stream.close()
        shutil.rmtree(self.folder, ignore_errors=True)


class Runner:
    """Posts what its jobs say. One worker is started ahead of time, so a save waits for no imports."""

    def __init__(self, project: Project, post: Post, words: Sequence[str] = WORKER) -> None:
        self._root = str(project.root)
        self._post = post
        self._words = list(words)
        self._folder = Path(tempfile.mkdtemp(prefix="raysteps-watch-"))
        self._ready: _Process | None = None
        self._current: _Process | None = None
        self._number = 0

    @property
    def run(self) -> int:
        """The number of the job that was started last."""
        return self._number

    def _spawn(self) -> _Process:
        folder = Path(tempfile.mkdtemp(prefix="run-", dir=self._folder))
        errors = (folder / "errors").open("w+", encoding="utf-8", errors="replace")
        popen = subprocess.Popen(
            self._words,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
            encoding="utf-8",
            errors="replace",
            env=os.environ | dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)),
            **new_session(),
        )
        return _Process(popen, folder, errors)

    def prepare(self) -> None:
        """Starts a worker that waits."""
        if self._ready is None or self._ready.popen.poll() is not None:
            self._forget_ready()
            self._ready = self._spawn()

    def start(self, kind: Kind, step: Step) -> int:
        """Stops what runs, and returns the number of the new run."""
        self.stop()
        self.prepare()
        process, self._ready = self._ready, None
        assert process is not None
        assert process.popen.stdin is not None
        self._current = process
        self._number += 1
        with suppress(OSError):  # it died while it waited; what it said comes with its end
            process.popen.stdin.write(json.dumps({"kind": kind, "root": self._root, "step": step.id}) + "\n")
            process.popen.stdin.flush()
        threading.Thread(target=self._listen, args=(process, self._number), daemon=True).start()
        if kind == "check":
            self.prepare()  # a save is likely to come before it ends
        return self._number

    def _listen(self, process: _Process, run: int) -> None:
        assert process.popen.stdout is not None
        for line in process.popen.stdout:
            with suppress(json.JSONDecodeError):  # what a library printed
                told = json.loads(line)
                try:
                    self._post(WorkerMessage(run, convert(told, WorkerLine)))
                except Malformed as fault:
                    self._post(WorkerMessage(run, WorkerLine(error=f"the kit's own answer: {fault}")))
        code = process.popen.wait()
        said = ""
        with suppress(OSError, ValueError):
            process.errors.seek(0)
            said = printable(process.errors.read()).strip()
        self._post(WorkerEnded(run, code, shorten(said[-_MAX_ERRORS:], _MAX_ERRORS)))

    def stop(self) -> None:
        """Ends what runs now, and all that it started. What it still says carries an old number."""
        if self._current is not None:
            self._number += 1
            self._current.end()
            self._current = None

    def finished(self) -> None:
        """After WorkerEnded: makes room, and the next worker ready."""
        if self._current is not None:
            self._current.end()
            self._current = None
        self.prepare()

    def _forget_ready(self) -> None:
        if self._ready is not None:
            self._ready.end()
            self._ready = None

    def close(self) -> None:
        """Leaves nothing behind."""
        self.stop()
        self._forget_ready()
        shutil.rmtree(self._folder, ignore_errors=True)


# Looks into a pixel: a save or a key ends it, also while its program is built for the first time.

INSPECT = (sys.executable, "-P", "-m", "raysteps")


class Inspection:
    """One at a time, which prints on this terminal and reads nothing from it."""

    def __init__(self, project: Project, post: Post, program: Sequence[str] = INSPECT) -> None:
        self._project = project
        self._post = post
        self._program = program
        self._process: subprocess.Popen[bytes] | None = None
        self._run = 0

    @property
    def is_running(self) -> bool:
        return self._process is not None

    def start(self, words: Sequence[str]) -> None:
        self.stop()
        self._run += 1
        self._process = subprocess.Popen(
            [*self._program, *words], cwd=self._project.root, stdin=subprocess.DEVNULL, **new_session()
        )
        threading.Thread(target=self._wait, args=(self._process, self._run), daemon=True).start()

    def _wait(self, process: "subprocess.Popen[bytes]", run: int) -> None:
        process.wait()
        self._post(InspectEnded(run))

    def ended(self, run: int) -> bool:
        """Whether that was the one that ran."""
        if run == self._run:
            self._process = None
        return run == self._run

    def stop(self) -> None:
        """As Ctrl-C would; what comes of it is no event any more."""
        process, self._process = self._process, None
        if process is None:
            return
        self._run += 1
        try:
            if sys.platform != "win32":
                with suppress(OSError, subprocess.TimeoutExpired):
                    process.send_signal(signal.SIGINT)
                    process.wait(_GRACE_SECONDS)
        finally:  # a second Ctrl-C within the grace, too
            kill_process_group(process)
            process.wait()
