"""A process that grades, seen from the one that has it grade."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from contextlib import suppress
from pathlib import Path

from raysteps.classroom.ending import end_tree
from raysteps.classroom.messages import Answer, Job

MOST_SECONDS = 3600.0  # every program has its own limit; this is for what nobody thought of


class Died(Exception):
    """The process is gone, and with it the answer."""


class Overtime(Exception):
    """The process was ended because it took too long."""


class GradingProcess:
    """Runs `raysteps.classroom.worker`; its temporary files lie in a folder that goes when it ends."""

    def __init__(self) -> None:
        self._scratch = Path(tempfile.mkdtemp(prefix="raysteps-class-"))
        self._scratch.chmod(0o711)  # a sandbox may run as another user
        self._log = (self._scratch / "stderr.txt").open("w+b")
        self._overtime = False
        try:
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-m", "raysteps.classroom.worker", str(self._scratch)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._log,
                start_new_session=True,  # Ctrl-C is for the process that was started on the terminal
                env={**os.environ, "TMPDIR": str(self._scratch)},
            )
        except BaseException:
            self._log.close()
            shutil.rmtree(self._scratch, ignore_errors=True)
            raise

    def _end_overtime(self) -> None:
        self._overtime = True
        end_tree(self._process.pid)

    def ask(self, job: Job, most_seconds: float = MOST_SECONDS) -> Answer:
        """Waits for the answer; Died or Overtime when there will be none."""
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        timer = threading.Timer(most_seconds, self._end_overtime)
        timer.daemon = True
        timer.start()
        try:
            with suppress(BrokenPipeError):  # then there is no answer to read, either
                self._process.stdin.write(json.dumps(job.to_json()).encode() + b"\n")
                self._process.stdin.flush()
            line = self._process.stdout.readline()
        finally:
            timer.cancel()
        if not line.endswith(b"\n"):
            if self._overtime:
                raise Overtime(f"there was no answer after {most_seconds:.0f} s")
            raise Died(self._why())
        return Answer.from_json(json.loads(line))

    def _why(self) -> str:
        code = self._process.wait()
        size = self._log.seek(0, os.SEEK_END)
        self._log.seek(max(0, size - 1000))
        said = self._log.read().decode("utf-8", "replace").strip()
        how = f"it was killed by signal {-code}" if code < 0 else f"it ended with code {code}"
        return f"{how}; the last it said: {said}" if said else how

    def stop(self) -> None:
        """Ends it with all that it runs; safe to call from another thread, and again."""
        if self._process.poll() is None:
            end_tree(self._process.pid)

    def clean_up(self) -> None:
        """After the end, or as the end; only when nobody asks."""
        self.stop()
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout, self._log):
            with suppress(OSError):
                if pipe is not None:
                    pipe.close()
        shutil.rmtree(self._scratch, ignore_errors=True)
