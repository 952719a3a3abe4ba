"""The hidden cases: repeatable, float32-exact, complete."""

import struct
from dataclasses import replace
from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault
from raysteps.common.vectors import dot
from raysteps.course.manifest import Step, choose, kit_steps
from raysteps.course.project import Project
from raysteps.judge.answers import Answer, ray_start_problem
from raysteps.judge.hidden_tests import make_cases
from raysteps.judge.plan import Plan, read_plan
from raysteps.judge.protocol import f32, text, vec_of

pytestmark = pytest.mark.portable

_MANY = 20  # ordinary cases at least
_FEW = 3  # kinds of cases at least, so that a share says something


def _plan(project: Project, step: Step) -> Plan:
    plan = read_plan(project, step)
    assert plan is not None
    return plan


def _lines(project: Project, step: Step, seed: int) -> list[str]:
    lines = []
    for plan in _plan(project, step).functions:
        cases = make_cases(step, plan, seed)
        lines += [case.line(i) for i, case in enumerate(cases)]
    return lines


def test_every_step_has_a_plan(project: Project, steps: list[Step]) -> None:
    for step in steps:
        plan = _plan(project, step)
        assert [function.name for function in plan.functions] == list(step.functions)
        for function in plan.functions:
            assert len(function.cases) >= _FEW, function.name
            ordinary = next(iter(function.cases.values()))
            assert ordinary >= _MANY, function.name


def test_the_same_seed_makes_the_same_cases(project: Project, steps: list[Step]) -> None:
    for step in steps:
        lines = _lines(project, step, 7)
        assert lines == _lines(project, step, 7), step.id
        other = _lines(project, step, 8)
        assert len(lines) == len(other)
        same = sum(line == twin for line, twin in zip(lines, other, strict=True))
        assert same < 0.2 * len(lines), step.id


def test_numbers_read_back_as_the_same_float32(project: Project, steps: list[Step]) -> None:
    for step in steps:
        for line in _lines(project, step, 3):
            for word in line.split()[2:]:
                value = float(word)
                assert text(f32(value)) in (word, f"{word}.0"), line


@pytest.mark.parametrize(
    ("value", "expected"),
    [(0.1, "0.1"), (1.0, "1"), (-0.0, "-0"), (float("nan"), "nan"), (float("-inf"), "-inf"), (3, "3"), (1e-5, "1e-05")],
)
def test_shortest_text(value: float, expected: str) -> None:
    assert text(f32(value) if isinstance(value, float) else value) == expected


def test_text_of_any_float() -> None:
    for bits in range(0, 1 << 32, 9_999_991):
        (value,) = struct.unpack("f", struct.pack("I", bits))
        if value == value:
            assert struct.pack("f", float(text(value))) == struct.pack("f", value)


def _with_plan(tmp_path: Path, step: Step, content: str) -> Project:
    path = tmp_path / "solutions" / step.id / "cases.toml"
    path.parent.mkdir(parents=True)
    path.write_text(content, encoding="utf-8")
    return Project(tmp_path)


def test_a_students_kit_has_no_plan(tmp_path: Path, steps: list[Step]) -> None:
    assert read_plan(Project(tmp_path), steps[0]) is None


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("weight = 1", "weight = 0", r":\d+:1: not a plan of hidden cases: weight: expected a number above 0; found 0"),
        (
            "weight = 1",
            "weigth = 1",
            r":\d+:1: not a plan of hidden cases: unknown key 'weigth'; did you mean weight\?",
        ),
        ("weight = 1", "weight = ", r":\d+:\d+: is not TOML: .*nothing stands behind the ="),
        (
            "weight = 1",
            "weight = 1\ncolour = 2",
            r":\d+:1: not a plan of hidden cases: unknown key 'colour'; known are",
        ),
        (
            '"any ray" = 40',
            '"0.5: deep [0]" = {cases = 1, weight = 1, foo = 2}',
            r":\d+:1: not a plan of hidden cases: unknown key 'foo'; known are",
        ),
        ('size = "', 'size = "big', ':1: not a plan .*: size: expected a size in pixels, such as "151x113"; found'),
        ('"any ray" = 40', '"any rays" = 40', ":1: 'any rays' is no kind of cases of point_at; did you mean any ray"),
        ('"any ray" = 40\n', "", r":\d+:1: 'any ray' is missing, a kind of .*: any ray, simple numbers"),
        ('"any ray" = 40', '"any ray" = "40"', ":4:1: .*: any ray: expected a whole number or a table; found '40'"),
        (
            "[functions.point_at.cases]",
            "[functions.point_to.cases]",
            "list the functions .*: point_at, .*; found point_to",
        ),
        ('of = "few-pixels"', 'of = "many-pixels"', r":\d+:1: must list a twin for each picture"),
    ],
)
def test_a_bad_plan_is_the_kits_fault(
    tmp_path: Path, project: Project, steps: list[Step], old: str, new: str, said: str
) -> None:
    good = (project.solutions / steps[0].id / "cases.toml").read_text(encoding="utf-8")
    assert old in good
    bad = good.replace(old, new, 1)
    with pytest.raises(GraderFault, match=said):
        read_plan(_with_plan(tmp_path, steps[0], bad), steps[0])


@pytest.mark.parametrize(("number", "name"), [("12", "turned_to"), ("13", "cosine_direction")])
def test_every_grade_asks_for_normals_with_three_parts_that_are_the_same(
    project: Project, number: str, name: str
) -> None:
    """And so do the cases by which mistakes are known: two at least, so that one has a name."""
    (step,) = choose(kit_steps(project), [number])
    plan = next(one for one in _plan(project, step).functions if one.name == name)
    for seed in ("diagnosis", *range(1, 21)):
        normals = [vec_of(case.inputs, "normal") for case in make_cases(step, plan, seed)]
        assert sum(len(set(normal)) == 1 for normal in normals) >= 2, seed


def test_every_eye_sees_the_side_of_the_normal(project: Project, steps: list[Step]) -> None:
    """Whoever asks, and answers black for the others, is right."""
    (step,) = choose(steps, ["03"])
    (plan,) = (one for one in _plan(project, step).functions if one.name == "specular")
    for case in make_cases(step, plan, 1):
        assert dot(vec_of(case.inputs, "to_eye"), vec_of(case.inputs, "normal")) >= 0, case.group


def test_a_ray_that_starts_on_its_surface_is_not_one_from_the_wrong_side() -> None:
    up, hit = (0.0, 0.0, 1.0), (0.0, 0.0, 5.0)
    assert ray_start_problem(hit, up, (0.0, 0.0, 5.001)) == ""
    assert ray_start_problem(hit, up, hit) == "the ray starts on the surface"
    assert ray_start_problem(hit, up, (0.0, 0.0, 4.999)) == "the ray starts on the wrong side of the surface"


def test_of_an_answer_by_chance_the_reference_has_one_of_many() -> None:
    sure = Answer(
        lambda tokens: tokens.real(), str, lambda _inputs, expected, actual: "" if expected == actual else "off"
    )
    for answer, expected in ((sure, "1.5"), (replace(sure, is_drawn=True), "for instance 1.5")):
        reference = answer.measured("f", {}, "1.5")
        verdict = answer.verdict({}, reference, "2.5")
        assert (verdict.problem, verdict.expected, verdict.actual) == ("off", expected, "2.5")
