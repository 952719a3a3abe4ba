"""Jobs in processes of their own: stopped, crashed, and cleared up after."""

import time
from collections.abc import Iterator
from pathlib import Path
from queue import Queue

import pytest
from course_fakes import small_project, write_own
from watch_fakes import WORKER, is_running, wait_for

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.watch.events import Event, WorkerEnded, WorkerMessage
from raysteps.watch.runner import Runner


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(scratch))
    monkeypatch.setenv("FAKE_LOG", str(tmp_path / "log.txt"))
    return small_project(tmp_path / "kit")


@pytest.fixture
def events() -> "Queue[Event]":
    return Queue()


@pytest.fixture
def runner(course: Project, events: "Queue[Event]") -> Iterator[Runner]:
    found = Runner(course, events.put, WORKER)
    yield found
    found.close()


def _until_ended(events: "Queue[Event]", run: int) -> tuple[list[Event], WorkerEnded]:
    """What this run told."""
    told: list[Event] = []
    while True:
        event = events.get(timeout=20)
        if isinstance(event, WorkerEnded) and event.run == run:
            return told, event
        if isinstance(event, WorkerMessage) and event.run == run:
            told.append(event)


def test_a_job_tells_and_ends(runner: Runner, course: Project, events: "Queue[Event]", steps: list[Step]) -> None:
    write_own(course, steps[0], "// wrong")
    run = runner.start("look", steps[0])
    told, ended = _until_ended(events, run)
    assert ended.code == 0
    assert [event.line.complete for event in told if isinstance(event, WorkerMessage)] == [False, True]
    runner.finished()
    told, _ = _until_ended(events, runner.start("check", steps[0]))
    assert isinstance(told[0], WorkerMessage)
    assert told[0].line.result is not None
    assert told[0].line.result.points == 2.5


def test_a_new_job_stops_the_old_one_with_its_programs(
    runner: Runner, course: Project, events: "Queue[Event]", steps: list[Step], tmp_path: Path
) -> None:
    write_own(course, steps[0], "// program")
    old = runner.start("look", steps[0])
    log = tmp_path / "log.txt"
    wait_for(lambda: log.is_file() and log.read_text())
    program, folder = log.read_text().split()
    assert is_running(int(program))
    write_own(course, steps[0], "int a;")
    run = runner.start("look", steps[0])
    told, _ = _until_ended(events, run)
    assert len(told) == 2
    assert run > old
    wait_for(lambda: not is_running(int(program)))
    assert not Path(folder).exists()


def test_a_crash_is_told(runner: Runner, course: Project, events: "Queue[Event]", steps: list[Step]) -> None:
    write_own(course, steps[0], "// crash")
    _, ended = _until_ended(events, runner.start("look", steps[0]))
    assert ended.code == -9
    assert ended.errors == "it gets dark"
    runner.finished()
    write_own(course, steps[0], "int a;")
    assert _until_ended(events, runner.start("look", steps[0]))[1].code == 0


def test_a_worker_that_died_while_it_waited(course: Project, events: "Queue[Event]", steps: list[Step]) -> None:
    runner = Runner(course, events.put, ("/bin/sh", "-c", "echo no python >&2; exit 7"))
    runner.prepare()
    time.sleep(0.2)
    _, ended = _until_ended(events, runner.start("look", steps[0]))
    assert (ended.code, ended.errors) == (7, "no python")
    runner.close()


def test_nothing_is_left_behind(course: Project, events: "Queue[Event]", steps: list[Step], tmp_path: Path) -> None:
    runner = Runner(course, events.put, WORKER)
    write_own(course, steps[0], "// program")
    runner.start("check", steps[0])
    log = tmp_path / "log.txt"
    wait_for(lambda: log.is_file() and log.read_text())
    runner.close()
    wait_for(lambda: not is_running(int(log.read_text().split()[0])))
    assert list((tmp_path / "scratch").iterdir()) == []
