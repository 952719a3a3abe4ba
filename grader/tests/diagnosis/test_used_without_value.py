"""A variable that was given no value holds the same wrong one each time, and is told."""

from pathlib import Path

import pytest
from conftest import MakeSubmission, Sources

from raysteps.course.manifest import Step
from raysteps.course.mutants import replaced_once
from raysteps.diagnosis.diagnose import (
    UninitializedVariable,
    asked_about,
    uninitialized_variables,
    used_without_value,
    warned_of,
)
from raysteps.grading.pipeline import grade_submission
from raysteps.results.model import HiddenResult, Settings, StepResult, TestResult
from raysteps.sandbox.detect import find_sandbox
from raysteps.submission.load import load_submission
from raysteps.toolchain.kit_artifacts import BuiltKit

_FILLED = "-1.6947395e+38"
_ABOUT = {"shade: lights add up": ["shade"], "Light: mirrors": ["mirror", "specular"]}


def _result(
    step: Step, got: str = "", *, expected: str = "1", log: str = "", test: str = "shade: lights add up"
) -> StepResult:
    failed = TestResult(test, False, expression=f"shade(hit) = {expected}", expanded=f"shade(hit) = {got}")
    return StepResult(step.id, "failed", 0.0, step.points, step.bonus, tests=[failed], build_log=log)


@pytest.mark.parametrize("got", [_FILLED, "1.6947395e+38", "(0, 0, -1.69474e+38)", "-16843010", "18374403900871474942"])
def test_a_number_that_nobody_means_is_told(steps: list[Step], got: str) -> None:
    (found,) = used_without_value(steps[2], _result(steps[2], got), _ABOUT, [])
    assert found.seen_in == ["shade"]
    assert "In shade a variable is used that was given no value" in found.title


_FLT_MAX = ["3.4028235e+38", "8.5070592e+37", "1.7014118e+38", "(1.02e+38, 0, 3.2e+38)"]  # and its half, a part of it


@pytest.mark.parametrize(
    "got", ["0", "inf", "nan", "1e+38", "2e+36", "1e+30", "-16843011", "v1.6947395e+38", *_FLT_MAX]
)
def test_others_are_not(steps: list[Step], got: str) -> None:
    assert not list(used_without_value(steps[2], _result(steps[2], got), _ABOUT, []))


def test_nor_is_what_was_to_come_out(steps: list[Step]) -> None:
    assert not list(used_without_value(steps[2], _result(steps[2], _FILLED, expected=_FILLED), _ABOUT, []))


def test_the_judges_cases_show_it_too(steps: list[Step]) -> None:
    result = _result(steps[2], "0")
    result.hidden.append(HiddenResult("diffuse", "function", 0.0, expected="(1, 1, 1)", actual=f"({_FILLED}, 0, 0)"))
    (found,) = used_without_value(steps[2], result, _ABOUT, [])
    assert found.seen_in == ["diffuse"]


def test_a_test_is_about_what_its_tags_say(steps: list[Step]) -> None:
    """Its name may be another than that of a function."""
    (found,) = used_without_value(steps[2], _result(steps[2], _FILLED, test="Light: mirrors"), _ABOUT, [])
    assert found.seen_in == ["mirror", "specular"]


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
    (found,) = warned_of(steps[2], _result(steps[2], "0", log=log))
    assert f"`weights` (phong_shading.cpp:{place}) may be used before it was given a value" in found.title
    (found,) = used_without_value(steps[2], _result(steps[2], _FILLED, log=log), _ABOUT, [])
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
    assert not list(warned_of(steps[2], _result(steps[2], "0", log=log)))


_SOURCE = """#include <glm/vec3.hpp>

namespace raysteps {
namespace {
float outside;
struct Best {
    float distance;
};
float first(bool a) {  // bool comment;
    bool found;
    const char* text = "bool text;";
    glm::vec3 sum, weights;
    return found ? 1.0F : sum.x + weights.x;
}
}  // namespace

Color Sphere::shade(const Ray& ray) {
    static int calls;
    Color right = k_black;
    Box box;
    for (int i = 0; i < 3; ++i) {
        std::uint32_t order;
        unsigned long long many;
        struct Part {
            int part;
        };
        const auto give = [&] {
            double inner;
            return inner;
        };
    }
    return right;
}

}  // namespace raysteps
"""


def test_the_source_shows_what_no_compiler_warns_of() -> None:
    found = uninitialized_variables(_SOURCE, "own.cpp")
    assert [(one.name, one.place, one.function) for one in found] == [
        ("found", "own.cpp:10", "first"),
        ("sum", "own.cpp:12", "first"),
        ("weights", "own.cpp:12", "first"),
        ("order", "own.cpp:22", "Sphere::shade"),
        ("many", "own.cpp:23", "Sphere::shade"),
        ("inner", "own.cpp:28", "Sphere::shade"),
    ]
    assert uninitialized_variables(_SOURCE.replace("\n", "\r\n"), "own.cpp") == found


@pytest.mark.parametrize(
    "source", ["}}} int x;", "f() { int", "f() { int a = 1; return a; }", "f() { if (int x; x) {} }"]
)
def test_it_shows_nothing_else(source: str) -> None:
    assert not uninitialized_variables(source, "own.cpp")


def test_a_large_source_is_read_once() -> None:
    amount = 100_000
    found = uninitialized_variables("f() {\n" + "int a;\n" * amount, "own.cpp")
    assert found[-1].place == f"own.cpp:{amount + 1}"


def test_those_of_the_source_are_asked_about(steps: list[Step]) -> None:
    unset = [UninitializedVariable(f"v{number}", f"own.cpp:{number}") for number in range(5)]
    (one,), (many,) = asked_about(unset[:1]), asked_about(unset)
    assert (one.title, one.hint) == (
        "`v0` (own.cpp:0) is declared without a value.",
        "Is it set on every way to where it is read?",
    )
    assert many.title.endswith("`v2` (own.cpp:2) and 2 more are declared without a value.")
    (found,) = used_without_value(steps[2], _result(steps[2], _FILLED), _ABOUT, unset[:2])
    assert found.hint == "Give `v0` (own.cpp:0) and `v1` (own.cpp:1) a value where they are declared."


def _graded(kit: BuiltKit, solved: Sources, make: MakeSubmission, out: Path, *edits: tuple[str, str]) -> StepResult:
    """Step 03 with these changes."""
    step = "03-phong-shading"
    source = solved[step]
    for find, replace in edits:
        source = replaced_once(source, find, replace, step)
    submission = load_submission(make("no-value", {step: source}), kit.steps)
    (result,) = grade_submission(kit, submission, Settings("diagnosis", only=(step,)), find_sandbox(), out).steps
    return result


def test_it_is_the_first_that_is_said_of_a_step(
    kit: BuiltKit, solved: Sources, make_submission: MakeSubmission, tmp_path: Path
) -> None:
    """glm's vectors hold anything at first, and no compiler warns of them; often it happens to be 0."""
    if not kit.description.compiler_version.startswith("GNU"):
        pytest.skip("another compiler fills variables with no number")
    result = _graded(kit, solved, make_submission, tmp_path / "out", ("Color sum = k_black;", "Color sum;"))
    assert not any(test.passed for test in result.tests if "lights add up" in test.name)
    assert [found.id for found in result.diagnoses][:1] == ["used-without-value"]
    assert result.diagnoses[0].seen_in == ["shade"]


def test_a_warning_does_not_hide_a_known_mistake(
    kit: BuiltKit, solved: Sources, make_submission: MakeSubmission, tmp_path: Path
) -> None:
    """It is said after it: here the variable does no harm."""
    lost = (
        "std::max(glm::dot(to_light, normal), 0.0F);\n    return fill.kd",
        "glm::dot(to_light, normal);\n    return fill.kd",
    )
    warned = (
        "Color sum = k_black;",
        "Color sum = k_black;\n    int count;\n    count += 1;\n    if (count == 7) {\n        return sum;\n    }",
    )
    result = _graded(kit, solved, make_submission, tmp_path / "out", lost, warned)
    assert "`count`" in "".join(found.title for found in result.diagnoses)
    kinds = [(found.kind, found.id) for found in result.diagnoses]
    assert kinds[0][0] == "mistake", kinds
    assert ("finding", "perhaps-without-value") in kinds[1:]


def test_a_bool_is_told_where_its_function_is_wrong(
    kit: BuiltKit, solved: Sources, make_submission: MakeSubmission, tmp_path: Path
) -> None:
    """It is true or false: no answer shows it, but the compiler or the source does."""
    behind = (
        "if (glm::dot(to_light, normal) <= 0.0F) {",
        "bool is_behind;\n    if (glm::dot(to_light, normal) > 0.0F) is_behind = false;\n    if (!is_behind) {",
    )
    right = (
        "return direction - 2.0F",
        "bool is_right;\n    is_right = true;\n    return (is_right ? 1.0F : 0.0F) * direction - 2.0F",
    )
    result = _graded(kit, solved, make_submission, tmp_path / "out", behind, right)
    (told,) = (found.title for found in result.diagnoses if found.id == "perhaps-without-value")
    assert told.startswith("`is_behind` (phong_shading.cpp:")
    assert "is_right" not in told
