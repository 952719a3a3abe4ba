"""`watch` on a terminal: keys, saves, and an end that leaves everything as it was."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from queue import Queue
from unittest.mock import MagicMock

import pytest
import watch_fakes
from course_fakes import save, small_project, write_own
from terminals import Terminal
from watch_fakes import wait_for

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.watch.events import Event, FileVanished, Key
from raysteps.watch.keyboard import letters
from raysteps.watch.session import Session

_TIMEOUT = 90
_FAKES = Path(watch_fakes.__file__)


def _watch(project: Project, *words: str) -> Terminal:
    """`watch` with the fake worker."""
    return Terminal([sys.executable, _FAKES, project.root, *words])


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    (tmp_path / "scratch").mkdir()
    monkeypatch.setenv("TMPDIR", str(tmp_path / "scratch"))
    monkeypatch.setenv("FAKE_LOG", str(tmp_path / "log.txt"))
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    return small_project(tmp_path / "kit")


@pytest.fixture
def terminals(course: Project) -> Iterator[list[Terminal]]:
    opened: list[Terminal] = []
    yield opened
    for terminal in opened:
        terminal.close()


def _scratch(course: Project) -> list[Path]:
    return list((course.root.parent / "scratch").iterdir())


def test_a_lesson(course: Project, steps: list[Step], terminals: list[Terminal]) -> None:
    own = write_own(course, steps[0], "// wrong")
    terminals.append(terminal := _watch(course))
    terminal.wait("Page: http://127.0.0.1:")
    terminal.wait("01 Camera rays: watching")
    terminal.wait("✗ 1 of 2 tests right, 0 of 1 picture right.")
    assert "expected  x == 1" in terminal.wait("50.00% of the pixels are wrong")
    terminal.wait("checking all of it")
    terminal.wait("! 2.5 of 10 points")
    terminal.wait("q quit")
    terminal.press("h")
    terminal.wait("hint 1 of 3")
    terminal.press("l")
    assert "partly right, 2.5 of 10" in terminal.wait("Bounding volumes (bonus)")
    save(own, "int right;")
    terminal.wait("camera_rays.cpp saved")
    terminal.wait("✓ 2 tests right, 1 picture right.")
    terminal.press("c")
    terminal.wait("✓ Passed: 10 of 10 points.")
    terminal.wait("next: 02 Intersection. Press n, or type ./raysteps watch 02")
    terminal.press("\x1b[C")  # an arrow, not the keys that are in it
    terminal.press("n")
    terminal.wait("02 Intersection: watching")
    terminal.wait("q quit")
    write_own(course, steps[1], "// wrong")
    terminal.wait("intersection.cpp saved")
    terminal.wait("1 of 2 tests right")
    terminal.press("rx")
    terminal.wait("1 line of your own would be put away")
    terminal.wait("Nothing was changed.")
    assert (course.steps / steps[1].path).read_text() == "// wrong"
    terminal.press("r")
    terminal.wait("Press y")
    terminal.press("y")
    terminal.wait("is the stub again")
    terminal.wait("intersection.cpp saved")
    terminal.press("?")
    terminal.wait("look into the pixel that is most wrong")
    terminal.press("q")
    terminal.wait("Stopped watching.")
    assert terminal.end() == 0
    assert terminal.is_as_before()
    assert _scratch(course) == []


def test_crashes_and_hangs_do_not_stop_the_loop(course: Project, steps: list[Step], terminals: list[Terminal]) -> None:
    own = write_own(course, steps[2], "// crash")
    terminals.append(terminal := _watch(course, "3", "--no-browser", "--poll"))
    terminal.wait("Files are polled: --poll.")
    terminal.wait("This run ended before it was done (exit code -9): it gets dark")
    save(own, "// hang")
    terminal.wait("saved")
    save(own, "// broken")
    terminal.wait("✗ It does not build.")
    terminal.wait("1 | // broken")
    own.unlink()
    terminal.wait("phong_shading.cpp is gone. Waiting for it to come back.")
    save(own, "// wait check")
    terminal.wait("✓ 2 tests right, 1 picture right.")
    terminal.wait("checking all of it")
    save(own, "int saved_while_it_was_checked;")
    terminal.wait("✓ 2 tests right, 1 picture right.")
    terminal.wait("✓ Passed: 15 of 15 points.")
    terminal.press(" ")
    terminal.wait("03 Phong shading: once more")
    terminal.wait("✓ 2 tests right, 1 picture right.")
    terminal.press("\x03")
    terminal.wait("Stopped watching.")
    assert terminal.end() == 130
    assert terminal.is_as_before()
    assert _scratch(course) == []


def test_what_hung_is_not_asked_again_before_somebody_wants_it(
    course: Project, steps: list[Step], terminals: list[Terminal]
) -> None:
    write_own(course, steps[2], "// endless")
    terminals.append(terminal := _watch(course, "3", "--no-browser"))
    terminal.wait("2 of 3 tests right")
    assert "checking all of it" not in terminal.wait("press c to check all of it")
    terminal.wait("q quit")
    terminal.press("c")
    terminal.wait("checking all of it")
    terminal.wait("✓ Passed: 15 of 15 points.")
    terminal.press("q")
    assert terminal.end() == 0


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_an_end_from_outside(
    course: Project, steps: list[Step], terminals: list[Terminal], number: signal.Signals
) -> None:
    write_own(course, steps[0], "// program")
    terminals.append(terminal := _watch(course, "01"))
    log = course.root.parent / "log.txt"
    wait_for(lambda: log.is_file() and log.read_text())
    os.kill(terminal.process.pid, number)
    assert terminal.end() == 130
    assert terminal.is_as_before()
    pid = int(log.read_text().split()[0])
    wait_for(lambda: not Path(f"/proc/{pid}").exists())
    assert _scratch(course) == []


def test_without_a_terminal_there_are_no_keys(course: Project, steps: list[Step]) -> None:
    write_own(course, steps[0], "int right;")
    words = [sys.executable, str(_FAKES), str(course.root), "01", "--quick"]
    process = subprocess.Popen(
        words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, start_new_session=True
    )
    assert process.stdout is not None
    said = [process.stdout.readline() for _ in range(3)]
    assert said[0].startswith("Page: http://127.0.0.1:")
    assert said[1].endswith("01 Camera rays: watching\n")
    assert said[2].startswith("✓ 2 tests right, 1 picture right.")
    process.send_signal(signal.SIGTERM)
    rest, _ = process.communicate(timeout=_TIMEOUT)
    assert process.returncode == 130
    assert rest.splitlines()[-1] == "Stopped watching."  # what was just being printed may come once more


_TYPED = {
    "h": "h", "hn": "hn", "\r": " ", "\x1b[A": "", "\x1b[Cn": "n", "\x1b[1;5Dq": "q", "\x1bOP": "", "\x1bq": "",
    "\x1b": "", "int main() {": "", "é": "é", "\x00": "",
}  # fmt: skip


@pytest.mark.parametrize(("typed", "keys"), _TYPED.items())
def test_what_counts_as_a_key(typed: str, keys: str) -> None:
    assert letters(typed) == list(keys)


@pytest.mark.parametrize("event", [Key("n"), FileVanished("a.cpp")])
def test_a_check_that_was_asked_for_is_of_the_step_that_it_was_asked_for(
    course: Project, steps: list[Step], event: Event
) -> None:
    session = Session(course, steps[0], Queue(), *(MagicMock() for _ in range(6)), checks=False)
    session.look("watching")
    session._handle(Key("c"))
    assert session.check_after_look
    session._handle(event)
    assert not session.check_after_look
