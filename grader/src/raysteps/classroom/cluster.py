"""Grades on many machines, by dask.distributed."""

import logging
import re
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from typing import Any

from raysteps.classroom.jobs import SAME_KIT, Job, JobResult, from_line, make_grader, to_line
from raysteps.classroom.local_pool import Slot
from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.text import count
from raysteps.toolchain.kit_artifacts import ProgressCallback

# What runs in a worker of a cluster. Each job is graded by a process of its own: a grader that crashes takes no
# worker with it, and a worker that is lost takes its process with it.

_lock = threading.Lock()
_free: list[Slot] = []
_busy: dict[Slot, str] = {}


def kit_of(grader: str, require_sandbox: bool) -> str:
    """The fingerprint of this machine's kit, which is built where it is not."""
    return make_grader(grader, require_sandbox=require_sandbox, say=print).fingerprint


def run_job(line: bytes) -> bytes:
    """Grades a job, as it is sent, and answers in the same way."""
    job = from_line(line, Job)
    with _lock:
        slot = _free.pop() if _free else Slot()
        _busy[slot] = job.run
    keep = False
    try:
        answer: JobResult = slot.grade(job)
        keep = True
        return to_line(answer)
    finally:
        # In one step: a slot that is free and still counts as busy would be stopped for a run that it has left.
        with _lock:
            del _busy[slot]
            keep = keep and not slot.stopped
            if keep:
                _free.append(slot)
        if not keep:
            slot.close()


def stop_run(run: str) -> None:
    """Ends the jobs of a run, and processes that have nothing to do."""
    with _lock:
        idle = list(_free)
        _free.clear()
        for slot in [slot for slot, whose in _busy.items() if whose == run]:
            slot.stop()
    for slot in idle:
        slot.close()


# Whether the workers of a cluster have the kit that a class is graded with.

_LOOK_SECONDS = 2


def check_kits(
    client: Any, kit: str, grader: str, workers: Callable[[], Iterable[str]], *, require_sandbox: bool
) -> None:
    """Another kit would give other grades: better to learn that before anything is graded. `workers` gives the
    addresses of those that are there."""
    import distributed

    asked = {
        worker: client.submit(kit_of, grader, require_sandbox, workers=[worker], allow_other_workers=False, pure=False)
        for worker in workers()
    }
    problems = []
    while asked:
        for worker, future in list(asked.items()):
            try:
                found = future.result(timeout=_LOOK_SECONDS)
            except (TimeoutError, distributed.TimeoutError):
                if worker in workers():
                    continue
                found = kit  # it is gone, and checks nothing any more
            except Exception as error:
                found = f"cannot grade: {error}"
            del asked[worker]
            if found != kit:
                problems.append(f"{worker}: {found}")
    if problems:
        lines = "\n  ".join(problems)
        raise GraderFault(
            f"these workers do not have the kit of this machine ({kit}):\n  {lines}\n"
            f"{SAME_KIT[0].upper()}{SAME_KIT[1:]}."
        )


_CONNECT_SECONDS = 15
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
        raise UsageError(f"--scheduler {address}: there is no scheduler that answers ({reason(error)})") from error


class Cluster:
    """Hands jobs to the workers of a scheduler. A job whose worker is lost goes to another one."""

    def __init__(
        self, address: str, run: str, kit: str, grader: str, *, require_sandbox: bool, say: ProgressCallback
    ) -> None:
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
        self._jobs[self._client.submit(run_job, to_line(job), key=key, pure=False)] = (job, attempt)

    def _fault(self, job: Job, text: str) -> JobResult:
        return JobResult(job.submission.name, "fault", fault=text, worker=self._address)

    def _answer(self, future: Any) -> JobResult | None:
        """None when there is none yet, or it has to be graded again."""
        import distributed

        job, attempt = self._jobs[future]
        try:
            answer = from_line(future.result(timeout=_LOOK_SECONDS), JobResult)
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

    def answers(self, jobs: Iterator[Job]) -> Iterator[JobResult]:
        """Not all jobs are handed over at once: a class need not fit into the scheduler's memory."""
        import distributed

        self._wait_for_workers()
        check_kits(self._client, self._kit, self._grader, self._workers, require_sandbox=self._require_sandbox)
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
