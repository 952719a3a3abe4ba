"""The key `i`: into the pixel that is most wrong, beside the loop."""

import sys
from collections.abc import Iterator
from pathlib import Path
from queue import Queue

import pytest
import watch_fakes
from course_fakes import small_project, write_own
from terminals import Terminal

from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project
from raysteps.watch.events import Event, InspectEnded
from raysteps.watch.runner import Inspection

_COMMAND = "./raysteps inspect scenes/lessons/three-spheres.nff 5 3 --step 1 --size 160x120 --against reference"


@pytest.fixture
def terminal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Terminal]:
    """`watch` of a wrong step."""
    monkeypatch.setenv("FAKE_LOG", str(tmp_path / "log.txt"))
    course = small_project(tmp_path / "kit")
    write_own(course, _first(course), "// wrong")
    found = Terminal([sys.executable, Path(watch_fakes.__file__), course.root, "01", "--quick"])
    yield found
    found.close()


def _first(course: Project) -> Step:
    return read_steps(course)[0]


def _save(tmp_path: Path, source: str) -> None:
    course = Project(tmp_path / "kit")
    write_own(course, _first(course), source)


def test_where_nothing_is_wrong(terminal: Terminal, tmp_path: Path) -> None:
    terminal.wait("q quit")
    _save(tmp_path, "int right;")
    terminal.wait("✓ 2 tests right")
    terminal.wait("q quit")
    terminal.press("i")
    terminal.wait("No picture is wrong")


def test_a_save_ends_it_and_is_looked_at_at_once(terminal: Terminal, tmp_path: Path) -> None:
    """It is still at work: it builds its program."""
    terminal.wait("q quit")
    terminal.press("i")
    terminal.wait(_COMMAND.partition(" --against")[0])
    terminal.wait("looking: inspect scenes/lessons/three-spheres.nff 5 3")
    _save(tmp_path, "int right;")
    terminal.wait("the build was ended")
    terminal.wait("camera_rays.cpp saved")
    terminal.wait("✓ 2 tests right, 1 picture right.")
    terminal.wait("q quit")
    terminal.press("q")
    assert terminal.end() == 0


def test_a_key_ends_it_and_does_what_it_does(terminal: Terminal) -> None:
    terminal.wait("q quit")
    terminal.press("i")
    terminal.wait("looking:")
    terminal.press("l")
    terminal.wait("the build was ended")
    terminal.wait("Bounding volumes")
    terminal.press("i")
    terminal.wait("looking:")
    terminal.press("q")
    terminal.wait("Stopped watching.")
    assert terminal.end() == 0
    assert terminal.is_as_before()


def test_of_several_only_the_last_is_told_of(tmp_path: Path) -> None:
    events: Queue[Event] = Queue()
    inspection = Inspection(Project(tmp_path), events.put, [sys.executable, "-c", "import time; time.sleep(1000)"])
    inspection.start([])
    inspection.stop()
    assert not inspection.is_running
    stopped = events.get(timeout=60)
    assert isinstance(stopped, InspectEnded)
    assert not inspection.ended(stopped.run)
    inspection = Inspection(Project(tmp_path), events.put, [sys.executable, "-c", "pass"])
    inspection.start([])
    ended = events.get(timeout=60)
    assert isinstance(ended, InspectEnded)
    assert inspection.ended(ended.run)
    assert not inspection.is_running
