"""Grades on many machines, by dask.distributed."""

import logging
import re
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

from raysteps.classroom.cluster_check import check_kits
from raysteps.classroom.cluster_task import run_job, stop_run
from raysteps.classroom.graders import Say
from raysteps.classroom.messages import Answer, Job
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.text import count

_CONNECT_SECONDS = 15
_LOOK_SECONDS = 2
_ATTEMPTS = 3
_GONE = "the scheduler at {} is gone; what was graded is kept, and --resume goes on"


def _connect(address: str) -> Any:
    if re.fullmatch(r"(tcp|tls)://[^\s/]+:[0-9]{1,5}", address) is None:
        raise UsageError(f"--scheduler {address}: expected an address such as tcp://head:8786")
    try:
        import distributed
    except ImportError as error:
        raise UsageError(
            "--scheduler needs dask.distributed; install it with: .venv/bin/pip install -e 'grader[cluster]'"
        ) from error
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # what matters is said here, without tracebacks
    try:
        return distributed.Client(address, timeout=_CONNECT_SECONDS)
    except (OSError, TimeoutError) as error:
        raise UsageError(f"--scheduler {address}: there is no scheduler that answers ({error})") from error


class Cluster:
    """Hands jobs to the workers of a scheduler. A job whose worker is lost goes to another one."""

    def __init__(self, address: str, run: str, kit: str, grader: str, *, require_sandbox: bool, say: Say) -> None:
        self._address = address
        self._run = run
        self._kit = kit
        self._grader = grader
        self._require_sandbox = require_sandbox
        self._say = say
        self._client = _connect(address)
        self._jobs: dict[Any, tuple[Job, int]] = {}  # future -> the job, and which attempt it is

    def _workers(self) -> dict[str, int]:
        """Address -> jobs at a time."""
        try:
            return dict(self._client.nthreads())
        except Exception as error:
            raise GraderFault(_GONE.format(self._address)) from error

    def _wait_for_workers(self) -> None:
        if not self._workers():
            self._say("waiting for the first worker of the cluster")
        while not self._workers():
            with suppress(TimeoutError):
                self._client.wait_for_workers(1, timeout=_LOOK_SECONDS)
        workers = self._workers()
        room = count(sum(workers.values()), "submission")
        self._say(f"{count(len(workers), 'worker')}, {room} at a time; asking for their kits")

    def _submit(self, job: Job, attempt: int) -> None:
        key = f"raysteps-{self._run}-{job.submission.name}-{attempt}"
        self._jobs[self._client.submit(run_job, job.to_json(), key=key, pure=False)] = (job, attempt)

    def _fault(self, job: Job, text: str) -> Answer:
        return Answer(job.submission.name, "fault", fault=text, worker=self._address)

    def _answer(self, future: Any) -> Answer | None:
        """None when there is none yet, or it has to be graded again."""
        import distributed

        job, attempt = self._jobs[future]
        try:
            answer = Answer.from_json(future.result(timeout=_LOOK_SECONDS))
            if answer.name != job.submission.name:
                answer = self._fault(job, f"the answer was that for {answer.name}")
        except (TimeoutError, distributed.TimeoutError):
            return None  # the worker that held the answer was lost; another one is at it
        except distributed.KilledWorker as error:
            answer = self._fault(job, f"every worker that graded this submission was lost: {error}")
        except (distributed.CancelledError, distributed.client.FutureCancelledError):
            del self._jobs[future]
            if self._client.status != "running":
                raise GraderFault(_GONE.format(self._address)) from None
            if attempt < _ATTEMPTS:
                self._submit(job, attempt + 1)
                return None
            return self._fault(job, "the scheduler dropped this submission several times")
        except Exception as error:
            answer = self._fault(job, f"{type(error).__name__}: {error}")
        del self._jobs[future]
        return answer

    def answers(self, jobs: Iterator[Job]) -> Iterator[Answer]:
        """Not all jobs are handed over at once: a class need not fit into the scheduler's memory."""
        import distributed

        self._wait_for_workers()
        check_kits(self._client, self._kit, self._grader, require_sandbox=self._require_sandbox)
        left = True
        while left or self._jobs:
            room = 2 * sum(self._workers().values()) + 1
            while left and len(self._jobs) < room:
                job = next(jobs, None)
                if job is None:
                    left = False
                else:
                    self._submit(job, 1)
            if not self._jobs:
                continue
            try:
                distributed.wait(list(self._jobs), timeout=_LOOK_SECONDS, return_when="FIRST_COMPLETED")
            except (TimeoutError, distributed.TimeoutError):
                pass
            except distributed.CancelledError:
                pass  # seen below, future by future
            for future in [future for future in self._jobs if future.status != "pending"]:
                answer = self._answer(future)
                if answer is not None:
                    yield answer

    def close(self) -> None:
        """Ends what the workers still grade for this run."""
        try:
            self._client.cancel(list(self._jobs))
            self._client.run(stop_run, self._run, on_error="ignore")
        except Exception as error:
            self._say(f"the workers could not be told to stop: {error}")
        self._client.close(timeout=5)
