"""Wrong files that were written apart from the catalogue: its mistakes must be named, others must not be."""

import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from conftest import MakeSubmission, Sources

from raysteps.course.manifest import Step
from raysteps.course.mutants import read_mutants, replaced_once
from raysteps.course.project import Project
from raysteps.exports.items import step_text
from raysteps.grading.pipeline import grade_submission
from raysteps.results.model import Results, Settings
from raysteps.sandbox.detect import find_sandbox
from raysteps.submission.load import load_submission
from raysteps.toolchain.kit_artifacts import BuiltKit

_FOLDER = Path(__file__).parent / "held_out"
_CASES: list[dict[str, Any]] = tomllib.loads((_FOLDER / "cases.toml").read_text(encoding="utf-8"))["cases"]
_QUICK = ("02-intersection", "04-shadows")  # to learn the mistakes of a step takes half a minute


def _source(case: dict[str, Any], project: Project) -> str:
    step, base = case["step"], case.get("base")
    path = project.solutions / step / "alternatives" / f"{base}.cpp" if base else _FOLDER / f"{step}.cpp"
    source = path.read_text(encoding="utf-8")
    for find, replace in case["edits"]:
        source = replaced_once(source, find, replace, f"{case['name']}: {find!r}")
    return source


def _grade(kit: BuiltKit, make: MakeSubmission, out: Path, sources: Sources) -> Results:
    """In one process, and without the smallest wrong cases, which is quicker: what a mistake looks like does not depend
    on it."""
    submission = load_submission(make("held-out", sources), kit.steps)
    settings = Settings("diagnosis", only=tuple(sources))
    return grade_submission(kit.in_one_process(), submission, settings, find_sandbox(), out)


def _params() -> Iterator[Any]:
    for case in _CASES:
        marks = [] if case["step"] in _QUICK else [pytest.mark.slow]
        yield pytest.param(case, id=f"{case['step'][:2]} {case['name']}", marks=marks)


@pytest.mark.parametrize("case", list(_params()))
def test_a_mistake_is_named_or_has_no_name(
    case: dict[str, Any], whole_kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission
) -> None:
    sources = {case["step"]: _source(case, whole_kit.project)}
    (result,) = _grade(whole_kit, make_submission, tmp_path / "out", sources).steps
    assert result.status != "passed"
    named = {found.id for found in result.diagnoses if found.kind == "mistake"}
    assert named == set(case["expect"]), result.diagnoses


def test_the_files_without_a_mistake_are_right(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission, steps: list[Step]
) -> None:
    sources = {step.id: (_FOLDER / f"{step.id}.cpp").read_text(encoding="utf-8") for step in steps}
    results = _grade(kit, make_submission, tmp_path / "out", sources)
    assert {step.status for step in results.steps} == {"passed"}
    assert not any(step.diagnoses for step in results.steps)


def test_two_steps_have_a_mistake_each(kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission) -> None:
    cases = {name: next(case for case in _CASES if case["name"] == name) for name in ("far root first", "no offset")}
    results = _grade(
        kit, make_submission, tmp_path / "out", {case["step"]: _source(case, kit.project) for case in cases.values()}
    )
    first, second = (step.diagnoses[0] for step in results.steps)
    assert (first.id, second.id) == ("far-end-of-sphere", "no-threshold")
    assert first.seen_in[0] == "Sphere::intersect"
    said = step_text(results.steps[0])
    assert f"This is what you get when {first.title}." in said
    assert f"Hint: {first.hint}" in said


@pytest.mark.slow
def test_what_only_some_pictures_lack_has_no_cause_that_all_would_show(
    kit: BuiltKit, tmp_path: Path, make_submission: MakeSubmission
) -> None:
    """Facing mirrors show nothing of each other, but balls show the floor: a ray is cast."""
    edit = ("sum += weight *", "if (d == 1 || hit->fill.ks <= 0) sum += weight *")
    source = _source({"step": "05-reflection", "name": "own light once", "edits": [edit]}, kit.project)
    (result,) = _grade(kit, make_submission, tmp_path / "out", {"05-reflection": source}).steps
    (found,) = (one for one in result.diagnoses if one.id == "no-mirrors")
    assert found.seen_in == ["facing-mirrors", "facing-mirrors-shallow"]
    assert found.hint
    assert not found.cause


def test_every_expected_mistake_is_in_the_catalogue(whole_kit: BuiltKit) -> None:
    known = {step.id: {mutant.id for mutant in read_mutants(whole_kit.project, step)} for step in whole_kit.steps}
    assert all(set(case["expect"]) <= known[case["step"]] for case in _CASES)
    assert sum(bool(case["expect"]) for case in _CASES) >= 12
    assert any(not case["expect"] for case in _CASES)
