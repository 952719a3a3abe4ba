"""How a step's points are shared out among its checks."""

import random

import pytest
from export_documents import mixed, step_result

from raysteps.common.text import apportion
from raysteps.course.manifest import Step
from raysteps.exports.items import entries_of
from raysteps.results.model import StepResult

pytestmark = pytest.mark.portable


def _hundredths(value: float) -> int:
    assert abs(value * 100 - round(value * 100)) < 1e-6, f"{value} is no whole number of hundredths"
    return round(value * 100)


def _check(result: StepResult, step: Step | None) -> None:
    entries = entries_of(result, step)
    assert sum(_hundredths(entry.points) for entry in entries) == _hundredths(result.points)
    assert sum(_hundredths(entry.most) for entry in entries) == _hundredths(result.max)
    for entry in entries:
        assert 0 <= entry.points <= entry.most
        if entry.item.share in (0.0, 1.0):
            assert entry.points == entry.most * entry.item.share, entry


@pytest.mark.parametrize("seed", range(200))
def test_sums_are_exact(steps: list[Step], seed: int) -> None:
    chance = random.Random(seed)
    step = chance.choice(steps)
    result = step_result(step, share=chance.choice([0.0, 1.0, chance.random()]))
    del result.tests[chance.randrange(8) :]
    del result.images[chance.randrange(4) :]
    del result.hidden[chance.randrange(4) :]
    # Whatever the grader says counts, also where the checks that are shown do not account for it.
    result.points = chance.choice([result.points, 0.0, step.points, round(chance.random() * step.points, 2)])
    _check(result, chance.choice([step, step, None]))


def test_the_usual_case_needs_no_entry_for_a_rest(steps: list[Step]) -> None:
    for result, step in zip(mixed(steps).steps, steps, strict=True):
        kinds = [entry.item.kind for entry in entries_of(result, step)]
        expected = ["test"] * 7 + ["picture"] * len(step.images) + ["hidden"] * 3 + ["together"]
        assert kinds == (expected if result.tests else ["step"])


def test_points_are_near_their_weights(steps: list[Step]) -> None:
    result = mixed(steps).steps[1]
    entries = entries_of(result, steps[1])
    for entry in entries:
        share = entry.item.weight * steps[1].points
        assert abs(entry.most - share) < 0.02, entry


def test_points_that_no_check_explains_are_named(steps: list[Step]) -> None:
    result = mixed(steps).steps[0]
    result.points = 6.0
    rest = entries_of(result, steps[0])[-1]
    assert (rest.item.kind, rest.points, rest.most) == ("step", 0.0, 4.0)
    assert rest.item.text == "Points that no single check accounts for."


def test_apportion() -> None:
    assert apportion(100, [1, 1, 1]) == [34, 33, 33]
    assert apportion(0, [1, 2]) == [0, 0]
    assert apportion(7, [0, 1, 0]) == [0, 7, 0]
    shares = [0.45, 0.15, 0.35, 0.05]
    assert apportion(150, shares) == apportion(150, [15 * share for share in shares])  # a tie, whatever the rounding
