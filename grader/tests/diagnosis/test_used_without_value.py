"""A variable that was given no value holds the same wrong one each time, and is told."""

from pathlib import Path

import pytest
from conftest import MakeSubmission, Sources

from raysteps.course.manifest import Step
from raysteps.course.mutants import replaced_once
from raysteps.diagnosis.diagnose import used_without_value
from raysteps.grading.pipeline import grade_submission
from raysteps.results.model import HiddenResult, Settings, StepResult, TestResult
from raysteps.sandbox.detect import find_sandbox
from raysteps.submission.load import load_submission
from raysteps.toolchain.kit_artifacts import BuiltKit

_FILLED = "-1.6947395e+38"


def _result(step: Step, got: str = "", *, expected: str = "1", log: str = "") -> StepResult:
    test = TestResult(
        "shade: lights add up", False, expression=f"shade(hit) = {expected}", expanded=f"shade(hit) = {got}"
    )
    return StepResult(step.id, "failed", 0.0, step.points, step.bonus, tests=[test], build_log=log)


@pytest.mark.parametrize(
    "got",
    [_FILLED, "-8.4736976e+37", "1.6947395e+38", "(0, 0, -1.69474e+38)", "-16843010", "18374403900871474942"],
)
def test_a_number_that_nobody_means_is_told(steps: list[Step], got: str) -> None:
    (found,) = used_without_value(steps[2], _result(steps[2], got))
    assert found.seen_in == ["shade"]
    assert "In shade a variable is used that was given no value" in found.title


@pytest.mark.parametrize(
    "got", ["0", "inf", "nan", "3.4028235e+38", "1e+38", "1e+36", "1e+30", "-16843011", "v1.69e+38"]
)
def test_others_are_not(steps: list[Step], got: str) -> None:
    assert not list(used_without_value(steps[2], _result(steps[2], got)))


def test_nor_is_what_was_to_come_out(steps: list[Step]) -> None:
    assert not list(used_without_value(steps[2], _result(steps[2], _FILLED, expected=_FILLED)))


def test_the_judges_cases_show_it_too(steps: list[Step]) -> None:
    result = _result(steps[2], "0")
    result.hidden.append(HiddenResult("diffuse", "function", 0.0, expected="(1, 1, 1)", actual=f"({_FILLED}, 0, 0)"))
    (found,) = used_without_value(steps[2], result)
    assert found.seen_in == ["diffuse"]


_USED = "phong_shading.cpp:52:11: warning: 'weights' may be used uninitialized [-Wmaybe-uninitialized]\n"
_DECLARED = "phong_shading.cpp:44:10: note: 'nearest.raysteps::{anonymous}::Found::weights' was declared here\n"


@pytest.mark.parametrize(
    ("log", "place"),
    [
        (_USED, "52"),
        (f"In function 'f':\n{_USED}{_DECLARED}", "44"),
        ("phong_shading.cpp:5:33: warning: variable 'weights' is used uninitialized whenever 'if' condition is\n", "5"),
        ("/in/a b/phong_shading.cpp:5:33: warning: variable 'weights' is uninitialized when used here\n", "5"),
        (f"/usr/include/c++/12/vector:9:1: warning: 'weights' may be used uninitialized\n{_DECLARED}", "44"),
    ],
)
def test_what_the_compiler_says_of_it_has_its_place(steps: list[Step], log: str, place: str) -> None:
    (found,) = used_without_value(steps[2], _result(steps[2], "0", log=log))
    assert f"`weights` (phong_shading.cpp:{place}) may be used before it was given a value" in found.title
    (found,) = used_without_value(steps[2], _result(steps[2], _FILLED, log=log))
    assert f"Give `weights` (phong_shading.cpp:{place}) a value" in found.hint


@pytest.mark.parametrize(
    "log",
    [
        "/usr/include/c++/12/vector:9:1: warning: 'weights' may be used uninitialized\n",
        "phong_shading.cpp:9:1: warning: 'hit.std::_Optional_payload<float>::_M_value' may be used uninitialized\n",
        "phong_shading.cpp:9:1: warning: '*(float*)((char*)&hit + 4)' may be used uninitialized\n",
        "phong_shading.cpp:9:1: warning: unused variable 'weights'\n",
    ],
)
def test_what_it_says_of_others_has_none(steps: list[Step], log: str) -> None:
    assert not list(used_without_value(steps[2], _result(steps[2], "0", log=log)))


def test_it_is_the_first_that_is_said_of_a_step(
    kit: BuiltKit, solved: Sources, make_submission: MakeSubmission, tmp_path: Path
) -> None:
    """glm's vectors hold anything at first, and no compiler warns of them; often it happens to be 0."""
    if not kit.description.compiler_version.startswith("GNU"):
        pytest.skip("another compiler fills variables with no number")
    step = "03-phong-shading"
    source = replaced_once(solved[step], "Color sum = k_black;", "Color sum;", step)
    submission = load_submission(make_submission("no-value", {step: source}), kit.steps)
    settings = Settings("diagnosis", only=(step,))
    (result,) = grade_submission(kit, submission, settings, find_sandbox(), tmp_path / "out").steps
    assert not any(test.passed for test in result.tests if "lights add up" in test.name)
    assert [found.id for found in result.diagnoses][:1] == ["used-without-value"]
    assert result.diagnoses[0].seen_in == ["shade"]
