"""Grades on this machine, several submissions at a time."""

import os
import queue
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from raysteps.classroom.jobs import Job, JobResult, from_line, gave_up, to_line
from raysteps.classroom.process_tree import kill_process_tree
from raysteps.common.errors import GraderFault
from raysteps.toolchain.limits import give_up_after

# A process that grades, seen from the one that has it grade.


class WorkerDied(Exception):
    """The process is gone, and with it the answer."""


class JobTimeout(Exception):
    """The process was ended because it took too long."""


class GradingProcess:
    """Runs `raysteps.classroom.worker`; its temporary files lie in a folder that goes when it ends."""

    def __init__(self) -> None:
        self._scratch = Path(tempfile.mkdtemp(prefix="raysteps-class-"))
        self._scratch.chmod(0o711)  # a sandbox may run as another user
        self._log = (self._scratch / "stderr.txt").open("w+b")
        self.is_overtime = False  # then it was ended, or is being ended
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
        self.is_overtime = True
        kill_process_tree(self._process.pid)

    def ask(self, job: Job) -> JobResult:
        """Waits for the answer; WorkerDied or JobTimeout when there will be none. Programs have limits of their own:
        the one here is for a grader that hangs itself."""
        most_seconds = give_up_after(job.settings.limits)
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        timer = threading.Timer(most_seconds, self._end_overtime)
        timer.daemon = True
        timer.start()
        try:
            with suppress(BrokenPipeError):  # then there is no answer to read, either
                self._process.stdin.write(to_line(job))
                self._process.stdin.flush()
            line = self._process.stdout.readline()
        finally:
            timer.cancel()
            timer.join()  # it may have begun to end the process
        if not line.endswith(b"\n"):
            if self.is_overtime:
                raise JobTimeout(gave_up(most_seconds))
            raise WorkerDied(self._why())
        return from_line(line, JobResult)

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
            kill_process_tree(self._process.pid)

    def clean_up(self) -> None:
        """After the end, or as the end; only when nobody asks."""
        self.stop()
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout, self._log):
            with suppress(OSError):
                if pipe is not None:
                    pipe.close()
        shutil.rmtree(self._scratch, ignore_errors=True)


# A place where one job at a time is graded, by a process that is replaced when it dies.

_ATTEMPTS = 2


class JobStopped(Exception):
    """Somebody stopped the grading."""


class Slot:
    """Its process is started for the first job, and again for the one after its death."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._process: GradingProcess | None = None
        self._stopped = False

    def _running(self) -> GradingProcess:
        with self._lock:
            if self._stopped:
                raise JobStopped
            if self._process is None:
                self._process = GradingProcess()
            return self._process

    def _drop(self) -> None:
        with self._lock:
            process, self._process = self._process, None
        if process is not None:
            process.clean_up()

    def grade(self, job: Job) -> JobResult:
        """A death may have a passing cause, such as memory, so there is a second attempt; then it is a fault."""
        deaths: list[str] = []
        for _ in range(_ATTEMPTS):
            try:
                process = self._running()
                answer = process.ask(job)
                if process.is_overtime:
                    self._drop()  # its answer came just before its end
                return answer
            except JobTimeout as overtime:
                self._drop()
                return JobResult(job.submission.name, "fault", fault=str(overtime))
            except WorkerDied as death:
                self._drop()
                deaths.append(str(death))
            except (OSError, ValueError, GraderFault) as error:
                self._drop()
                deaths.append(f"{type(error).__name__}: {error}")
            with self._lock:
                if self._stopped:
                    raise JobStopped
        text = "the process that graded this submission died twice"
        return JobResult(job.submission.name, "fault", fault=f"{text}: {deaths[-1]}", details="\n".join(deaths))

    @property
    def stopped(self) -> bool:
        """Then it grades nothing any more."""
        with self._lock:
            return self._stopped

    def stop(self) -> None:
        """Ends what is being graded; `grade` then raises JobStopped."""
        with self._lock:
            self._stopped = True
            if self._process is not None:
                self._process.stop()

    def close(self) -> None:
        """When no job is being graded."""
        self.stop()
        self._drop()


_END_SECONDS = 10


class LocalPool:
    """Each thread has one process grade. Processes of one's own, and not those of concurrent.futures: when one dies
    it is clear which submission it was grading, and the others go on."""

    def __init__(self, size: int) -> None:
        self._slots = [Slot() for _ in range(size)]
        self._jobs: queue.SimpleQueue[Job | None] = queue.SimpleQueue()
        self._answers: queue.SimpleQueue[JobResult | BaseException] = queue.SimpleQueue()
        self._threads: list[threading.Thread] = []

    def _serve(self, slot: Slot) -> None:
        while (job := self._jobs.get()) is not None:
            try:
                self._answers.put(slot.grade(job))
            except JobStopped:
                return
            except BaseException as error:
                self._answers.put(error)

    def _start_threads(self, wanted: int) -> None:
        while len(self._threads) < min(wanted, len(self._slots)):
            thread = threading.Thread(target=self._serve, args=(self._slots[len(self._threads)],), daemon=True)
            thread.start()
            self._threads.append(thread)

    def answers(self, jobs: Iterator[Job]) -> Iterator[JobResult]:
        """Takes jobs as they are needed, and gives answers as they come."""
        waiting = 0
        left = True
        while left or waiting:
            while left and waiting <= len(self._slots):  # one more than there are slots, so that none is idle
                job = next(jobs, None)
                if job is None:
                    left = False
                    break
                self._jobs.put(job)
                waiting += 1
                self._start_threads(waiting)
            if waiting:
                answer = self._answers.get()
                waiting -= 1
                if isinstance(answer, BaseException):
                    raise answer
                yield answer

    def close(self) -> None:
        """Ends all processes and what they run, at once."""
        for slot in self._slots:
            slot.stop()
        for _ in self._threads:
            self._jobs.put(None)
        for thread in self._threads:
            thread.join(_END_SECONDS)
        for slot in self._slots:
            slot.close()
