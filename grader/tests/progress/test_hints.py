"""The command `hint`."""

import dataclasses
import re
from pathlib import Path

import pytest
from course_fakes import printed, small_project, text

from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project, here
from raysteps.progress.hints import Hints, print_hint


@pytest.fixture
def course(tmp_path: Path) -> Project:
    return small_project(tmp_path)


def _said(course: Project, step: Step, *, level: int | None = None, all_: bool = False, again: bool = False) -> str:
    console = printed()
    assert print_hint(course, step, console, level=level, all_=all_, again=again) == 0
    return text(console)


def test_one_level_at_a_time_until_there_is_no_more(course: Project, steps: list[Step]) -> None:
    first, *others = steps
    for level, left in ((1, "2 more hints"), (2, "1 more hint"), (3, "that was the last hint")):
        said = _said(course, first)
        assert f"hint {level} of 3" in said
        assert left in said
        assert first.hints[level - 1].strip() in said
    assert "hint 1 of" in _said(course, others[0])


def test_after_the_last_one_it_says_where_to_go_on(course: Project, steps: list[Step]) -> None:
    for step in steps:
        _said(course, step, all_=True)
        said = _said(course, step)
        assert said.startswith(f"You have read all {len(step.hints)} hints of step {step.number}; ")
        assert not any(hint.strip() in said for hint in step.hints)
        handout = re.findall(r"steps/\S+\.md", said)[0]
        headings = re.findall(r"^## (.+)$", (here().root / handout).read_text(encoding="utf-8"), re.MULTILINE)
        assert set(re.findall(r'"(.+?)"', said)) <= set(headings)
        assert f"./raysteps inspect SCENE X Y --step {step.index}" in said
        assert "hint 1 of" in _said(course, step, again=True)


def test_a_level_by_its_number(course: Project, steps: list[Step]) -> None:
    assert "hint 2 of 3" in _said(course, steps[0], level=2)
    assert "hint 1 of 3" in _said(course, steps[0], level=1)
    assert "hint 3 of 3" in _said(course, steps[0])
    assert "hint 3 of 3" in _said(course, steps[0], level=3)


@pytest.mark.parametrize("level", [0, 4, -1])
def test_a_level_that_there_is_not(course: Project, steps: list[Step], level: int) -> None:
    with pytest.raises(UsageError, match=rf"--level {level}: step 01 has 3 hints"):
        _said(course, steps[0], level=level)
    assert Hints(course).reached(steps[0]) == 0


def test_all_and_those_that_were_read(course: Project, steps: list[Step]) -> None:
    assert "No hint of step 01 was read yet" in _said(course, steps[0], again=True)
    _said(course, steps[0])
    _said(course, steps[0])
    seen = _said(course, steps[0], again=True)
    assert ("hint 1 of 3" in seen, "hint 2 of 3" in seen, "hint 3 of 3" in seen) == (True, True, False)
    assert "1 more hint" in seen
    everything = _said(course, steps[0], all_=True)
    assert [f"hint {level} of 3" in everything for level in (1, 2, 3)] == [True] * 3
    assert Hints(course).reached(steps[0]) == 3


def test_a_step_without_hints(course: Project, steps: list[Step]) -> None:
    bare = dataclasses.replace(steps[0], hints=())
    assert "has no hints" in _said(course, bare)


@pytest.mark.parametrize("damage", ["", "{", '{"schema": "raysteps/hints/v1", "read": {"01-camera-rays": "x"}}'])
def test_a_damaged_memory_begins_anew(course: Project, steps: list[Step], damage: str) -> None:
    _said(course, steps[0])
    (course.build / "hints.json").write_text(damage)
    assert "hint 1 of 3" in _said(course, steps[0])
    assert "hint 2 of 3" in _said(course, steps[0])
