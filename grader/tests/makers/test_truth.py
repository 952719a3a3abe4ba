"""What `dev check` hands in, and what it makes of the grades."""

from collections import Counter
from dataclasses import replace

import pytest

from raysteps.course.manifest import Step
from raysteps.course.mutants import read_alternatives, read_mutants
from raysteps.course.project import Project
from raysteps.results.model import Diagnosis, StepResult, TestResult
from tools.grade_audit import ObservedGrade, problems_of, random_pairs, rounds_of, row_of, shortfalls, total
from tools.test_submissions import Entrant, Kind, half_done, mutants


def _seen(
    project: Project,
    step: Step,
    kind: Kind,
    points: float,
    *,
    diagnoses: list[Diagnosis] | None = None,
    status: str = "",
    at: int = 0,
) -> ObservedGrade:
    entrant = mutants(project, step)[at] if kind == "mutant" else Entrant(kind, step.id, kind, "")
    result = StepResult(step.id, "passed" if points == step.points else "partial", points, step.points, step.bonus)
    if status == "does-not-build":
        result.status = "does-not-build"
    result.tests = [TestResult("a test", points > step.points / 2)]
    result.diagnoses = diagnoses or []
    return ObservedGrade(entrant, result)


def _named(project: Project, step: Step, alike: list[str] | None = None, *, at: int = 0) -> list[Diagnosis]:
    mutant = read_mutants(project, step)[at]
    return [Diagnosis("mistake", mutant.id, mutant.name, alike=alike or [])]


def test_every_mistake_and_every_alternative_has_its_turn_beside_right_files(
    project: Project, steps: list[Step]
) -> None:
    rounds = rounds_of(project, steps)
    times = Counter((one.kind, one.step, one.name) for handed_in in rounds for one in handed_in.entrants)
    for step in steps:
        for mutant in read_mutants(project, step):
            assert times[("mutant", step.id, mutant.id)] == 1
        for alternative in read_alternatives(project, step):
            assert times[("alternative", step.id, alternative.name)] >= 1
        assert times[("stub", step.id, "stub")] == 1
    for handed_in in rounds:
        assert [one.step for one in handed_in.entrants] == [step.id for step in steps]
        every = {one.step for one in handed_in.entrants if one.kind != "reference"}
        assert every <= set(handed_in.graded)
    beside = sum(any(one.is_right for one in handed_in.entrants) for handed_in in rounds[2:])
    assert beside == len(rounds) - 2


def test_there_are_many_mistakes_and_three_other_ways_for_each_step(project: Project, steps: list[Step]) -> None:
    assert sum(len(read_mutants(project, step)) for step in steps) >= 60
    for step in steps:
        assert len(read_mutants(project, step)) >= 6
        assert len(read_alternatives(project, step)) >= 3


def test_every_mistake_is_another_change_of_the_reference(project: Project, steps: list[Step]) -> None:
    for step in steps:
        sources = [one.source for one in mutants(project, step)]
        assert len(set(sources)) == len(sources), step.id


def test_pairs_sit_in_two_steps_and_are_drawn_again_from_their_seed(project: Project, steps: list[Step]) -> None:
    pairs = random_pairs(project, steps, 40, seed=3)
    assert len(pairs) == 40
    for pair in pairs:
        wrong = [one.step for one in pair.entrants if one.kind == "mutant"]
        assert len(wrong) == 2
        assert set(pair.graded) == set(wrong)
        assert sum(one.kind == "reference" for one in pair.entrants) == len(steps) - 2
    assert pairs == random_pairs(project, steps, 40, seed=3)
    assert pairs != random_pairs(project, steps, 40, seed=4)


@pytest.mark.parametrize(
    ("kind", "points", "says"),
    [
        ("stub", 1.0, "a stub has 1 of"),
        ("stub", 6.0, "a stub has 6 of 10 points, for test 'a test'"),
        ("reference", 9.0, "it is right and has 9 of"),
        ("alternative", 9.5, "it is right and has 9.5 of"),
        ("mutant", 10.0, "nobody notices it"),
    ],
)
def test_points_that_are_not_true_are_told(
    project: Project, steps: list[Step], kind: Kind, points: float, says: str
) -> None:
    wrong = _seen(project, steps[0], kind, points)
    assert says in wrong.problem
    beside = _seen(project, steps[1], "mutant", 3.0)
    (told,) = problems_of([[wrong, beside]])
    assert says in told
    assert f"02 {beside.entrant.name}" in told


@pytest.mark.parametrize(
    ("kind", "points"), [("stub", 0.0), ("reference", 10.0), ("alternative", 10.0), ("mutant", 9.9)]
)
def test_points_that_are_true_are_not_told(project: Project, steps: list[Step], kind: Kind, points: float) -> None:
    assert not _seen(project, steps[0], kind, points).problem


def test_a_mistake_that_does_not_build_is_no_mistake(project: Project, steps: list[Step]) -> None:
    assert "does not build" in _seen(project, steps[0], "mutant", 0.0, status="does-not-build").problem


def test_a_mistake_is_named_when_the_first_diagnosis_is_it_or_says_both(project: Project, steps: list[Step]) -> None:
    step = steps[0]
    own, other = read_mutants(project, step)[:2]
    assert _seen(project, step, "mutant", 5.0, diagnoses=_named(project, step)).named
    assert _seen(project, step, "mutant", 5.0, diagnoses=_named(project, step, [own.name], at=1)).named
    assert not _seen(project, step, "mutant", 5.0, diagnoses=_named(project, step, [other.name], at=1)).named
    assert not _seen(project, step, "mutant", 5.0).named
    later = [*_named(project, step, at=1), *_named(project, step)]
    assert not _seen(project, step, "mutant", 5.0, diagnoses=later).named, "only the first counts"


def test_the_table_counts_each_file_once_and_knows_what_is_too_few(project: Project, steps: list[Step]) -> None:
    step = steps[0]
    seen = [
        _seen(project, step, "stub", 0.0),
        _seen(project, step, "reference", 10.0),
        _seen(project, step, "mutant", 4.0, diagnoses=_named(project, step)),
        _seen(project, step, "mutant", 8.0, at=1),
        _seen(project, step, "alternative", 10.0),
        _seen(project, step, "alternative", 10.0),
    ]
    row = row_of(step.id, seen)
    assert (row.mutants, row.caught, row.by_tests, row.named) == (2, 2, 1, 1)
    assert (row.alternatives, row.full) == (1, 1)
    assert len(shortfalls(total([row]))) == 2
    assert shortfalls(total([row_of(step.id, seen[:3])])) == []


def test_what_is_fair_follows_the_points_of_a_course(project: Project, steps: list[Step]) -> None:
    usual, doubled = half_done(project, steps[1]), half_done(project, replace(steps[1], points=steps[1].points * 2))
    for one, two in zip(usual, doubled, strict=True):
        assert one.band is not None
        assert two.band is not None
        assert (two.band.low, two.band.high) == (one.band.low * 2, one.band.high * 2)
