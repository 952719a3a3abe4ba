"""What an edit was about, and that it comes first among the failures."""

from dataclasses import replace
from pathlib import Path

import pytest
from course_fakes import printed, text
from watch_fakes import result_of

from raysteps.course.manifest import Step
from raysteps.results.model import TestResult
from raysteps.watch.page_state import state_of
from raysteps.watch.step_view import StepView, edited_first, edited_functions
from raysteps.watch.terminal_view import TerminalView

_SOURCE = """
namespace raysteps {
static float helper(float x) { return x; }
std::optional<HitRecord> Triangle::intersect(const Ray& ray) const { if (ray.t > 0) { return {}; } return {}; }
std::optional<HitRecord> Sphere::intersect(const Ray& ray) const noexcept { return {}; }
std::optional<HitRecord> closest_hit(const Ray& ray) { return Sphere::intersect(ray); }
}
"""


@pytest.mark.parametrize(
    ("old", "new", "edited"),
    [
        ("ray.t > 0", "ray.t >= 0", ("Triangle::intersect",)),
        ("noexcept { return {}", "noexcept { return helper(1)", ("Sphere::intersect",)),
        ("Ray& ray) {", "Ray& other) {", ("closest_hit",)),
        ("return x", "return 2 * x", ()),
        ("namespace raysteps {", "namespace raysteps {  // a comment", ()),
        ("ray.t > 0) { return {}; }", "ray.t > 0) { /* { */ return {}; }", ()),
    ],
)
def test_the_function_that_was_edited(steps: list[Step], old: str, new: str, edited: tuple[str, ...]) -> None:
    assert _SOURCE.count(old) == 1
    assert edited_functions(_SOURCE, _SOURCE.replace(old, new), steps[1]) == edited


def test_a_stub_that_is_filled_in_is_all_of_its_functions(steps: list[Step]) -> None:
    assert edited_functions("", _SOURCE, steps[1]) == ("Triangle::intersect", "Sphere::intersect", "closest_hit")


def test_the_rest_stays_in_its_order() -> None:
    titles = ["Triangle: a", "closest_hit", "Sphere: b", "closest_hits", "render c", "closest_hit of all"]
    pairs = [(title, title) for title in titles]
    assert edited_first(pairs, ()) == titles
    assert edited_first(pairs, ("Sphere::intersect",)) == ["Sphere: b", *(t for t in titles if t != "Sphere: b")]
    assert edited_first(pairs, ("closest_hit",))[:2] == ["closest_hit", "closest_hit of all"]


def test_its_failures_come_first_in_the_terminal_and_on_the_page(steps: list[Step], tmp_path: Path) -> None:
    result = result_of(steps[1], "// wrong", tmp_path, full=False)
    names = ["Triangle: one", "Triangle: two", "Sphere: three", "closest_hit: four"]
    result.tests = [TestResult(name, False) for name in names]
    view = StepView(steps[1], "idle", result=result, out=tmp_path, complete=True, edited=("Sphere::intersect",))
    console = printed()
    TerminalView(console).result(view)
    said = text(console)
    assert said.index("Sphere: three") < said.index("Triangle: one")
    assert "Triangle: two" not in said
    failed = [test["name"] for test in state_of(view)["tests"]["failed"]]  # type: ignore[index]
    assert failed == ["Sphere: three", "Triangle: one", "Triangle: two", "closest_hit: four"]


def test_no_line_is_empty_and_a_done_step_leads_on(steps: list[Step], tmp_path: Path) -> None:
    result = result_of(steps[1], "// wrong", tmp_path, full=True)
    view = StepView(steps[1], "idle", result=result, out=tmp_path, complete=True, full=True)
    console = printed()
    TerminalView(console).result(view)
    assert "together" not in text(console)
    result.cumulative.message = "it does not draw what it should"
    TerminalView(console).result(view)
    assert "  together: it does not draw what it should\n" in text(console)
    right = replace(view, result=result_of(steps[1], "int right;", tmp_path, full=True), following=steps[2])
    console = printed()
    TerminalView(console).result(right)
    assert "next: 03 Phong shading. Press n, or type ./raysteps watch 03\n" in text(console)
