"""How watch prints: whole words in a terminal, and commands that can be copied."""

import io
from dataclasses import replace

import pytest
from course_fakes import printed, text
from rich.console import Console

from raysteps.course.manifest import Step
from raysteps.results.model import HiddenResult, ImageResult, StepResult, TestResult
from raysteps.results.statuses import Status
from raysteps.watch.page_state import state_of
from raysteps.watch.step_view import StepView
from raysteps.watch.terminal_view import TerminalView

_TEXT = "  hidden  sphere intersect: expected a hit at 3.25, where the ray enters the sphere [from outside]"


def _printed(text: str, *, terminal: bool, command: bool = False) -> list[str]:
    console = Console(file=io.StringIO(), width=40, force_terminal=terminal, color_system=None)
    (TerminalView(console).command if command else TerminalView(console).line)(text)
    assert isinstance(console.file, io.StringIO)
    return console.file.getvalue().splitlines()


def test_a_terminal_gets_whole_words_that_stand_below_the_first() -> None:
    lines = _printed(_TEXT, terminal=True)
    assert max(len(line) for line in lines) < 40
    assert lines[0].startswith("  hidden  sphere intersect:")
    assert all(line.startswith("    ") for line in lines[1:])
    assert " ".join(" ".join(lines).split()) == " ".join(_TEXT.split())
    assert _printed("", terminal=True) == [""]


@pytest.mark.parametrize(("terminal", "command"), [(False, False), (True, True), (False, True)])
def test_a_file_and_what_is_copied_get_one_line(terminal: bool, command: bool) -> None:
    assert _printed(_TEXT, terminal=terminal, command=command) == [_TEXT]


def test_a_check_tells_what_the_look_before_it_could_not(steps: list[Step]) -> None:
    """Such as the line at which a test crashes, and nothing twice."""
    looked = [TestResult(name, False, "It crashed.", outcome="crashed") for name in ("first", "second")]
    result = StepResult(steps[0].id, "crashed", 2.0, steps[0].points, bonus=False)
    result.tests = [
        replace(looked[0], message="It crashed.\ncamera_rays.cpp, line 7: follows a null pointer."),
        looked[1],
    ]
    view = StepView(steps[0], "idle", result=result, complete=True, full=True, looked=tuple(looked))
    console = printed()
    TerminalView(console).result(view)
    said = text(console)
    assert "line 7: follows a null pointer." in said
    assert "second" not in said
    console = printed()
    TerminalView(console).result(replace(view, looked=tuple(result.tests)))
    assert "first" not in text(console)


def test_nothing_is_named_twice(steps: list[Step]) -> None:
    """Neither that it does not build nor what was asked."""
    result = StepResult(steps[0].id, "does-not-build", 0.0, steps[0].points, bonus=False)
    result.messages = ["It does not build: camera_rays.cpp:14:49: expected ';'\n   14 | here"]
    console = printed()
    TerminalView(console).result(StepView(steps[0], "idle", result=result, complete=True))
    place = f"steps/{steps[0].id}/camera_rays.cpp:14:49"
    assert f"It does not build.\n  {place}: expected ';'\n     14 | here\n" in text(console)
    result = StepResult(steps[0].id, "failed", 0.0, steps[0].points, bonus=False)
    result.hidden = [HiddenResult("point_at", "function", 0.0, message="point_at: 0 of 5 kinds of cases are right")]
    console = printed()
    TerminalView(console).result(StepView(steps[0], "idle", result=result, complete=True, full=True))
    assert "  hidden  point_at: 0 of 5 kinds of cases are right\n" in text(console)


_WARNING = "own.cpp:66:11: warning: 'nearer' may be used uninitialized [-Wmaybe-uninitialized]"


@pytest.mark.parametrize(("status", "told"), [("failed", 1), ("passed", 0), ("does-not-build", 0)])
def test_what_the_compiler_warns_of_is_told_of_a_step_that_is_wrong(
    steps: list[Step], status: Status, told: int
) -> None:
    result = StepResult(steps[0].id, status, 0.0, steps[0].points, bonus=False, build_log=f"{_WARNING}\n{_WARNING}")
    console = printed()
    view = StepView(steps[0], "idle", result=result, complete=True)
    TerminalView(console).result(view)
    assert text(console).count("  warning  own.cpp:66:11: 'nearer' may be used uninitialized\n") == told
    messages = state_of(view)["messages"]
    assert messages == ["The compiler warns: own.cpp:66:11: 'nearer' may be used uninitialized"] * told
    assert state_of(replace(view, complete=False))["messages"] == []  # it may pass yet


def test_only_a_picture_that_is_wrong_is_red(steps: list[Step]) -> None:
    result = StepResult(steps[0].id, "failed", 2.0, steps[0].points, bonus=False)
    wrong = ImageResult("balls", "a.nff", False, 0.001, message="3 pixels differ.")
    waits = ImageResult("few", "a.nff", False, 0.001, message="It waits for view_frame.", waits_for="view_frame")
    result.images = [wrong, waits]
    console = Console(file=io.StringIO(), width=200, force_terminal=True, color_system="standard")
    TerminalView(console).result(StepView(steps[0], "idle", result=result, complete=True))
    assert isinstance(console.file, io.StringIO)
    lines = console.file.getvalue().splitlines()
    red = {name: any("\x1b[31m" in line for line in lines if name in line) for name in ("3 pixels", "It waits")}
    assert red == {"3 pixels": True, "It waits": False}
