"""What the page is told, and which command looks into a pixel."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from watch_fakes import result_of

from raysteps.common.local_server import on_a_desktop
from raysteps.common.platform import kit_command
from raysteps.course.manifest import Step
from raysteps.images.compare import worst_pixel, write_png
from raysteps.report.wording import inspect_command
from raysteps.watch.page_state import page_of, state_of
from raysteps.watch.session import command_of_worst
from raysteps.watch.step_view import StepView, verdict

_TALLY = "1 of 2 tests right, 0 of 1 picture right"


def _view(step: Step, source: str, out: Path, *, full: bool = False) -> StepView:
    result = result_of(step, source, out, full=full)
    return StepView(step, "idle", result=result, out=out, complete=True, full=full, seconds=0.8, saved="12:00:00")


@pytest.mark.parametrize(
    ("source", "full", "said"),
    [
        ("", False, ("good", "2 tests right, 1 picture right.")),
        ("// wrong", False, ("bad", f"{_TALLY}.")),
        ("// broken", False, ("bad", "It does not build.")),
        ("", True, ("good", "Passed: 10 of 10 points.")),
        (
            "// wrong",
            True,
            ("warn", f"2.5 of 10 points: {_TALLY}, 0 of 1 hidden item right."),
        ),
    ],
)
def test_the_line_that_matters(
    steps: list[Step], tmp_path: Path, source: str, full: bool, said: tuple[str, str]
) -> None:
    assert verdict(_view(steps[0], source, tmp_path, full=full)) == said


def test_the_state_holds_what_went_wrong(steps: list[Step], tmp_path: Path) -> None:
    state: Any = state_of(_view(steps[0], "// wrong", tmp_path, full=True))
    assert state["tests"]["passed"] == 1
    assert state["tests"]["failed"][0]["actual"] == "2 == 1"
    assert state["hidden"]["failed"][0]["message"] == "half is wrong"
    (picture,) = state["pictures"]
    assert picture["mine"].startswith("data:image/png;base64,")
    assert picture["mine"] != picture["reference"]
    assert picture["inspect"].startswith("./raysteps inspect scenes/lessons/three-spheres.nff {x} {y} --step 1 --size")
    assert json.loads(json.dumps(state)) == state


def test_a_picture_that_waits_is_not_called_wrong(steps: list[Step], tmp_path: Path) -> None:
    view = _view(steps[0], "// wrong", tmp_path)
    assert view.result is not None
    view.result.images[0].waits_for = "view_frame"
    state: Any = state_of(view)
    assert [picture["waits"] for picture in state["pictures"]] == [True]


def test_what_waits_is_counted_by_itself(steps: list[Step], tmp_path: Path) -> None:
    view = _view(steps[0], "// wrong", tmp_path)
    assert view.result is not None
    for test in view.result.tests:
        test.waits_for = "view_frame"  # also of one that passed
    state: Any = state_of(view)
    assert (state["tests"]["passed"], state["tests"]["waits"], state["tests"]["failed"]) == (1, 1, [])


def test_pictures_that_are_gone_are_left_out(steps: list[Step], tmp_path: Path) -> None:
    view = _view(steps[0], "// wrong", tmp_path)
    (tmp_path / "mine.png").unlink()
    (tmp_path / "reference.png").write_text("no picture")
    state: Any = state_of(view)
    (picture,) = state["pictures"]
    assert (picture["mine"], picture["reference"], picture["flip"]) == (None, None, None)


def test_numbers_that_the_page_shows_are_not_said_twice(steps: list[Step], tmp_path: Path) -> None:
    view = _view(steps[0], "// wrong", tmp_path)
    assert view.result is not None
    left = "RAYSTEPS_TODO is still in: a."
    numbers = ["1 of 2 tests failed.", "1 of 1 picture did not pass.", "3 of 5 hidden items lost points."]
    view.result.messages = [*numbers, left]
    assert state_of(view)["messages"] == [left]


def test_the_page_is_one_document_that_asks_its_own_server_only(steps: list[Step], tmp_path: Path) -> None:
    text = json.dumps(state_of(_view(steps[0], "// wrong", tmp_path)))
    html = page_of(text)
    assert "connect-src &#39;self&#39;" in html
    assert "<title>01 Camera rays</title>" in html
    assert "it is <b>right</b>" not in html


def test_the_worst_pixel_and_its_command(steps: list[Step], tmp_path: Path) -> None:
    step = next(step for step in steps if "--view" in step.images[0].args)
    view = _view(step, "// wrong", tmp_path)
    words = command_of_worst(view)
    assert words is not None
    assert kit_command(*words).endswith(" 5 3 --step 2 --view normals --size 160x120 --against reference")
    assert command_of_worst(_view(step, "", tmp_path)) is None


def test_the_worst_pixel_is_where_it_was_planted(tmp_path: Path) -> None:
    reference = np.full((5, 7, 3), 100, dtype=np.uint8)
    mine = reference.copy()
    mine[1, 2] = (90, 100, 100)
    mine[4, 6] = (100, 100, 180)
    write_png(mine, tmp_path / "mine.png")
    write_png(reference, tmp_path / "reference.png")
    assert worst_pixel(tmp_path / "mine.png", tmp_path / "reference.png") == (6, 4)
    assert worst_pixel(tmp_path / "mine.png", tmp_path / "mine.png") is None
    write_png(reference[:3], tmp_path / "reference.png")
    assert worst_pixel(tmp_path / "mine.png", tmp_path / "reference.png") is None
    assert worst_pixel(tmp_path / "mine.png", tmp_path / "nothing.png") is None


def test_odd_names_are_quoted_and_what_inspect_does_not_know_is_left_out(steps: list[Step]) -> None:
    case = replace(steps[0].images[0], name="odd", scene="a b.nff", args=("--step", "1", "--threads", "2"))
    odd = replace(steps[0], images=(case,))
    wanted = "./raysteps inspect 'a b.nff' {x} {y} --step 1 --against reference"
    assert inspect_command("odd", odd, has_reference=True) == wanted
    assert inspect_command("other", odd, has_reference=True) is None
    bare = replace(steps[0], images=(replace(case, args=()),))
    assert inspect_command("odd", bare, has_reference=False) == "./raysteps inspect 'a b.nff' {x} {y}"


@pytest.mark.parametrize(
    ("environment", "platform", "desktop"),
    [
        ({}, "darwin", True),
        ({}, "win32", True),
        ({}, "linux", False),
        ({"DISPLAY": ":0"}, "linux", True),
        ({"WAYLAND_DISPLAY": "wayland-0"}, "linux", True),
        ({"DISPLAY": ":0", "SSH_CONNECTION": "1 2 3 4"}, "linux", False),
        ({"CI": "true"}, "darwin", False),
        ({"DISPLAY": ""}, "linux", False),
    ],
)
def test_a_browser_is_opened_on_a_desktop_only(environment: dict[str, str], platform: str, desktop: bool) -> None:
    assert on_a_desktop(environment, platform) is desktop
