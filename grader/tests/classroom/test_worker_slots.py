"""The processes that a worker of a cluster keeps for its jobs."""

import threading
import time
from types import SimpleNamespace

import pytest
from fake_grader import FAKE

from raysteps.classroom import cluster as cluster_task
from raysteps.classroom import local_pool
from raysteps.classroom.jobs import Job, JobResult, to_line
from raysteps.classroom.worker import JobRunner
from raysteps.common.errors import GraderFault
from raysteps.course.settings import COURSE_VARIABLE
from raysteps.results.model import Settings
from raysteps.submission.load import Submission


class _Slot:
    """Grades while it is told to wait."""

    made: list["_Slot"] = []  # noqa: RUF012

    def __init__(self) -> None:
        self.stopped = False
        self.closed = False
        self.begun, self.go_on = threading.Event(), threading.Event()
        self.made.append(self)

    def grade(self, job: Job) -> JobResult:
        self.begun.set()
        assert self.go_on.wait(20)
        return JobResult(job.submission.name, "fault", fault="none")

    def stop(self) -> None:
        self.stopped = True

    def close(self) -> None:
        self.closed = True


@pytest.fixture(autouse=True)
def _slots(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster_task, "Slot", _Slot)
    monkeypatch.setattr(_Slot, "made", [])
    monkeypatch.setattr(cluster_task, "_free", [])
    monkeypatch.setattr(cluster_task, "_busy", {})


def _job(run: str) -> bytes:
    return to_line(Job(Submission("a", {}, {}, {}), Settings(), "a:b", "kit", False, run))


def test_a_slot_that_was_stopped_is_not_used_again() -> None:
    thread = threading.Thread(target=cluster_task.run_job, args=(_job("one"),))
    thread.start()
    end = time.monotonic() + 20
    while not _Slot.made and time.monotonic() < end:
        time.sleep(0.01)
    (slot,) = _Slot.made
    assert slot.begun.wait(20)
    cluster_task.stop_run("one")  # just before its answer comes
    slot.go_on.set()
    thread.join(20)
    assert slot.closed
    assert cluster_task._free == []
    assert cluster_task._busy == {}


@pytest.mark.usefixtures("fake_grader")
def test_what_may_make_two_kits_differ_is_named() -> None:
    """Points of course.toml count as part of the kit, and a worker in a clone of its own may have another file."""
    job = Job(Submission("a", {}, {}, {}), Settings(), FAKE, "another-kit")
    fault = JobRunner(lambda _: None).grade(job).fault
    assert "is fake-kit, but the class is graded with another-kit; install the same version of the kit" in fault
    assert "give all the same course.toml" in fault
    assert COURSE_VARIABLE in fault


def test_a_process_whose_answer_came_just_before_its_end_gets_no_other_job(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[SimpleNamespace] = []

    def process() -> SimpleNamespace:
        def ask(job: Job) -> JobResult:
            one.is_overtime = True
            return JobResult(job.submission.name, "fault", fault="none")

        one = SimpleNamespace(ask=ask, is_overtime=False, clean_up=lambda: None)
        made.append(one)
        return one

    monkeypatch.setattr(local_pool, "GradingProcess", process)
    slot = local_pool.Slot()
    job = Job(Submission("a", {}, {}, {}), Settings(), "a:b", "kit", False, "one")
    assert [slot.grade(job).fault for _ in range(2)] == ["none", "none"]
    assert len(made) == 2


def test_a_scheduler_that_goes_while_kits_are_compared_is_told() -> None:
    pytest.importorskip("distributed")

    def gone() -> None:
        raise OSError("timed out")

    cluster = object.__new__(cluster_task.Cluster)
    cluster._address, cluster._client = "tcp://head:8786", SimpleNamespace(nthreads=gone)
    with pytest.raises(GraderFault, match="head:8786 is gone; what was graded is kept, and --resume goes on"):
        cluster_task.check_kits(cluster._client, "kit", "a:b", cluster._workers, require_sandbox=False)


def test_a_slot_is_kept_for_the_next_job(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_Slot, "grade", lambda self, job: JobResult(job.submission.name, "fault", fault="none"))
    for run in ("one", "two"):
        cluster_task.run_job(_job(run))
    assert len(_Slot.made) == 1
    assert not _Slot.made[0].closed
    free: list[object] = list(cluster_task._free)
    assert free == _Slot.made
    assert cluster_task._busy == {}
