"""Grading from end to end: what goes wrong in a step costs that step only."""

from pathlib import Path

import pytest
from conftest import MakeSubmission, Sources

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.grading.pipeline import grade_submission
from raysteps.results.model import Results, Settings
from raysteps.sandbox.detect import find_sandbox
from raysteps.submission.load import load_submission
from raysteps.toolchain.kit_artifacts import BuiltKit


def _grade(kit: BuiltKit, path: Path, out: Path, *only: str) -> Results:
    results = grade_submission(kit, load_submission(path, kit.steps), Settings(only=only), find_sandbox(), out, jobs=2)
    assert (out / "results.json").is_file()
    return results


def _points(results: Results) -> float:
    return float(results.total.points)


def _status(results: Results) -> dict[str, str]:
    return {step.id[:2]: step.status for step in results.steps}


def _inserted(source: str, function: str, statement: str) -> str:
    """The source with a statement at the start of a function's body."""
    at = source.index("{\n", source.index(f" {function}(")) + 2
    return source[:at] + f"    {statement}\n" + source[at:]


def test_the_complete_sample_gets_everything(kit: BuiltKit, project: Project, tmp_path: Path) -> None:
    results = _grade(kit, project.samples / "complete", tmp_path)
    assert set(_status(results).values()) == {"passed"}
    assert _points(results) == 120
    assert all(step.cumulative.passed for step in results.steps)
    assert {image.share for step in results.steps for image in step.images} == {1.0}


def test_the_stubs_get_nothing(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, unsolved: Sources
) -> None:
    commented = {step: source + "// I looked at it.\n" for step, source in unsolved.items()}
    results = _grade(kit, make_submission("stubs", commented), tmp_path)
    assert set(_status(results).values()) == {"not-started"}
    assert _points(results) == 0
    assert "still the stub" in results.steps[0].messages[0]


def test_the_partial_sample_loses_points_in_step_04_and_nowhere_before(
    kit: BuiltKit, project: Project, tmp_path: Path
) -> None:
    results = _grade(kit, project.samples / "partial", tmp_path)
    status = _status(results)
    assert [status[number] for number in ("01", "02", "03", "04")] == ["passed", "passed", "passed", "partial"]
    assert {status[number] for number in ("05", "06", "07", "08", "09")} == {"not-started"}
    assert 0 < results.steps[3].points < results.steps[3].max
    wrong = [image for image in results.steps[3].images if not image.passed]
    assert wrong
    assert wrong[0].difference is not None
    assert (tmp_path / wrong[0].difference).is_file()


def test_broken_steps_cost_themselves_only(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources, unsolved: Sources
) -> None:
    """Step 01 does not build, 02 crashes, 03 ends the process, 04 is missing, 05 is only formatted, 07 hangs."""
    sources = dict(solved)
    sources["01-camera-rays"] += "\nint syntax error here;\n"
    sources["02-intersection"] = _inserted(
        solved["02-intersection"], "Sphere::intersect", "volatile int* nowhere = nullptr; *nowhere = 1;"
    )
    sources["03-phong-shading"] = "#include <cstdlib>\n" + _inserted(
        solved["03-phong-shading"], "shade", "std::_Exit(0);"
    )
    del sources["04-shadows"]
    sources["05-reflection"] = unsolved["05-reflection"].replace("    ", "\t")
    sources["07-tone-mapping"] = _inserted(
        solved["07-tone-mapping"], "tone_map", "for (volatile bool on = true; on;) {}"
    )
    results = _grade(kit, make_submission("broken", sources), tmp_path)
    status = _status(results)
    assert status["01"] == "does-not-build"
    assert results.steps[0].messages[0].startswith("It does not build: camera_rays.cpp:")
    assert status["02"] == "crashed"
    assert "SIGSEGV" in " ".join(results.steps[1].messages)
    assert any(test.passed for test in results.steps[1].tests), "a crash hides the other tests"
    assert status["03"] == "crashed"
    assert "shadows.cpp was not handed in." in results.steps[3].messages
    assert results.steps[3].not_taken == ""
    assert status["04"] == status["05"] == "not-started"
    assert status["07"] == "timeout"
    assert any(test.passed for test in results.steps[6].tests), "a hang hides the other tests"
    first = next(test for test in results.steps[6].tests if test.outcome == "timeout")
    assert f"after {kit.steps[6].seconds:g} seconds" in first.message, "the test in which all of them were stopped"
    assert status["06"] == status["08"] == status["09"] == "passed"


def test_partly_done_steps_name_what_is_left(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources, steps: list[Step]
) -> None:
    left = 'RAYSTEPS_TODO("03-phong-shading", "specular");'
    source = _inserted(solved["03-phong-shading"], "specular", left)
    results = _grade(kit, make_submission("partly", {steps[2].id: source}), tmp_path)
    result = results.steps[2]
    assert "RAYSTEPS_TODO is still in: specular. The tests pass: delete that line." in result.messages
    assert not any(test.waits_for for test in result.tests)


def test_what_is_not_written_yet_waits_aside(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources, steps: list[Step]
) -> None:
    source = solved["03-phong-shading"].replace("std::pow(cosine, fill.shine)", "0.0F")
    source = _inserted(source, "specular", 'RAYSTEPS_TODO("03-phong-shading", "specular");')
    result = _grade(kit, make_submission("waiting", {steps[2].id: source}), tmp_path).steps[2]
    assert "Not written yet: specular." in result.messages
    failed = [test for test in result.tests if not test.passed]
    assert {test.waits_for for test in failed} == {"specular"}
    assert not any("shade" in test.name for test in failed), "it is tried with the reference's specular"
    assert [bool(test.waits_for) for test in result.tests] == sorted(bool(test.waits_for) for test in result.tests)
    assert {item.waits_for for items in (result.images, result.hidden) for item in items if not item.passed} == {
        "specular"
    }
    assert any(message.startswith("Waiting for that: ") for message in result.messages)
    assert not any("failed" in message for message in result.messages)


def test_todo_lines_above_finished_code_cost_nothing(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources, steps: list[Step]
) -> None:
    source = solved["04-shadows"]
    for function in steps[3].functions:
        source = _inserted(source, function, f'RAYSTEPS_TODO("04-shadows", "{function}");')
    results = _grade(kit, make_submission("todo", {"04-shadows": source}), tmp_path / "out")
    assert results.steps[3].status == "passed"
    assert results.steps[3].points == results.steps[3].max
    assert results.steps[3].messages[0].startswith("RAYSTEPS_TODO is still in: ")


def test_brute_force_in_disguise_earns_no_more_than_a_tree_that_nobody_searches(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources
) -> None:
    """An octree of one leaf makes the right picture, but spares the rays nothing."""
    source = solved["06-octree"]
    start = source.index("    if (surfaces.empty()) {\n        return {};", source.index("Node build_octree("))
    source = (
        source[:start]
        + "    return Node{bounds_of(surfaces), surfaces, {}};\n"
        + source[source.index("}\n\n", start) :]
    )
    source = '#pragma GCC diagnostic ignored "-Wunused-function"\n' + source
    result = _grade(kit, make_submission("leaf", {"06-octree": source}), tmp_path / "out").steps[5]
    assert result.status == "partial", result.messages
    assert 0 < result.points <= 0.6 * result.max
    for image in result.images:
        assert not image.passed, image.name
        assert image.wrong_share is not None
        assert image.share_tested is not None
        assert image.max_share is not None
        assert image.wrong_share <= image.max_wrong
        assert image.share_tested > image.max_share
        assert image.message.startswith("The picture is right, but each ray tested ")
        assert image.work is not None
        assert image.reference_work is not None
        assert image.work.rays == image.reference_work.rays > 0
        assert image.work.surface_tests > 2 * image.reference_work.surface_tests > 0
        assert (image.work.boxes, image.reference_work.boxes > 1) == (1, True)
        assert 0 < image.work.bytes < image.reference_work.bytes


@pytest.mark.parametrize("name", ["with space", "unicöde"])
def test_names_of_submissions(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, unsolved: Sources, name: str
) -> None:
    assert _grade(kit, make_submission(name, unsolved), tmp_path / "o u t").submission == name


def test_steps_that_are_right_alone_and_do_not_fit_lose_only_the_part_for_that(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources, steps: list[Step]
) -> None:
    """A direction may be a little longer than 1 by rounding; a step that asks for more than that fits to no other."""
    longer = solved["01-camera-rays"].replace("glm::normalize(target)}", "glm::normalize(target) * 1.00002F}")
    strict = _inserted(
        solved["02-intersection"],
        "Sphere::intersect",
        "if (glm::abs(glm::length(ray.direction) - 1.0F) > 0.000005F) { return std::nullopt; }",
    )
    submission = make_submission("strict", {"01-camera-rays": longer, "02-intersection": strict})
    first, second = _grade(kit, submission, tmp_path / "out", "01-camera-rays", "02-intersection").steps
    assert first.status == "passed", first.messages
    assert second.status == "partial", second.messages
    assert second.points == pytest.approx(steps[1].points * 0.95)
    assert not second.cumulative.passed


def test_a_wrong_step_is_replaced_for_the_steps_after_it(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, solved: Sources
) -> None:
    wrong = solved["02-intersection"].replace("glm::normalize(plane_normal)", "plane_normal")
    sources = {**solved, "02-intersection": wrong}
    own = list(solved)[:4]
    results = _grade(kit, make_submission("second", {step: sources[step] for step in own}), tmp_path / "out", *own)
    assert [step.id for step in results.steps if step.status != "passed"] == ["02-intersection"]
    assert results.steps[2].cumulative.message == (
        "The picture is right. It was drawn with the reference's 02-intersection, which you do not have right yet."
    )
