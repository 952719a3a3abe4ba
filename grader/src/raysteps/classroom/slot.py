"""A place where one job at a time is graded, by a process that is replaced when it dies."""

import threading

from raysteps.classroom.grading_process import Died, GradingProcess, Overtime
from raysteps.classroom.messages import Answer, Job
from raysteps.common.errors import GraderFault

_ATTEMPTS = 2


class Stopped(Exception):
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
                raise Stopped
            if self._process is None:
                self._process = GradingProcess()
            return self._process

    def _drop(self) -> None:
        with self._lock:
            process, self._process = self._process, None
        if process is not None:
            process.clean_up()

    def grade(self, job: Job) -> Answer:
        """A death may have a passing cause, such as memory, so there is a second attempt; then it is a fault."""
        deaths: list[str] = []
        for _ in range(_ATTEMPTS):
            try:
                return self._running().ask(job)
            except Overtime as overtime:
                self._drop()
                return Answer(job.submission.name, "fault", fault=str(overtime))
            except Died as death:
                self._drop()
                deaths.append(str(death))
            except (OSError, ValueError, GraderFault) as error:
                self._drop()
                deaths.append(f"{type(error).__name__}: {error}")
            with self._lock:
                if self._stopped:
                    raise Stopped
        text = "the process that graded this submission died twice"
        return Answer(job.submission.name, "fault", fault=f"{text}: {deaths[-1]}", details="\n".join(deaths))

    @property
    def stopped(self) -> bool:
        """Then it grades nothing any more."""
        with self._lock:
            return self._stopped

    def stop(self) -> None:
        """Ends what is being graded; `grade` then raises Stopped."""
        with self._lock:
            self._stopped = True
            if self._process is not None:
                self._process.stop()

    def close(self) -> None:
        """When no job is being graded."""
        self.stop()
        self._drop()
