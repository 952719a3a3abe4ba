"""Looks into a pixel beside the loop: a save or a key ends it, also while its program is built for the first time."""

import signal
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress

from raysteps.common.process import kill_process_group, new_session
from raysteps.course.project import Project
from raysteps.watch.events import InspectEnded, Post

_GRACE_SECONDS = 2.0  # to end what builds
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
