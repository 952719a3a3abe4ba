"""Turns what was seen of a step into points and a status, and results into an exit code."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from raysteps.common.text import count
from raysteps.course.manifest import Step

if TYPE_CHECKING:  # `list` and `next` ask what a step is worth, and no result
    from raysteps.results.model import Results, Status, StepResult


def max_points(step: Step, *, judged: bool) -> float:
    """What the step is worth: without the judge's plan, as in a student's kit, the visible part."""
    share = 1.0 if judged else 1.0 - step.weight_hidden
    return round(step.points * share, 2)


def _share(passed: Sequence[bool]) -> float:
    return sum(passed) / len(passed) if passed else 0.0


def _hidden_share(result: StepResult) -> float:
    weight = sum(item.weight for item in result.hidden)
    return sum(item.share * item.weight for item in result.hidden) / weight if weight else 0.0


def is_right(result: StepResult) -> bool:
    """Whether the step by itself, between steps of the reference, is all that it should be."""
    passed = [item.passed for items in (result.tests, result.images, result.hidden) for item in items]
    return bool(passed) and all(passed)


def status_and_points(result: StepResult, step: Step) -> tuple[Status, float]:
    """Visible tests and pictures by their share that passed, hidden items by what was earned of each, and whether the
    step works together with the steps before it."""
    tests, images = [test.passed for test in result.tests], [image.passed for image in result.images]
    points = step.points * (step.weight_tests * _share(tests) + step.weight_images * _share(images))
    points += step.points * step.weight_hidden * _hidden_share(result)
    points += step.points * step.weight_together * result.cumulative.passed
    outcomes = {item.outcome for items in (result.tests, result.images, result.hidden) for item in items}
    if is_right(result) and result.cumulative.passed:
        return "passed", result.max
    if "crashed" in outcomes:
        return "crashed", round(points, 2)
    if "timeout" in outcomes:
        return "timeout", round(points, 2)
    return ("partial" if points > 0 else "failed"), round(points, 2)


def sum_up(result: StepResult) -> list[str]:
    """What failed, in numbers, and the first crash or timeout."""
    messages = []
    failed = [test for test in result.tests if not test.passed]
    if failed:
        messages.append(f"{len(failed)} of {count(len(result.tests), 'test')} failed.")
    wrong = [image for image in result.images if not image.passed]
    if wrong:
        messages.append(f"{len(wrong)} of {count(len(result.images), 'picture')} did not pass.")
    missed = [item for item in result.hidden if not item.passed]
    if missed:
        messages.append(f"{len(missed)} of {count(len(result.hidden), 'hidden item')} lost points.")
    outcomes = [(item.outcome, item.message) for items in (result.tests, result.images) for item in items]
    bad = [message for outcome, message in outcomes if outcome in ("crashed", "timeout")]
    return messages + bad[:1]


def exit_code(results: Results) -> int:
    """0 all passed (a bonus need not be started), 3 when building is the only trouble, else 1."""
    open_steps = [
        step for step in results.steps if step.status != "passed" and not (step.bonus and step.status == "not-started")
    ]
    if not open_steps:
        return 0
    return 3 if all(step.status == "does-not-build" for step in open_steps) else 1
