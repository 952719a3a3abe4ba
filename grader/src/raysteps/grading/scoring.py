"""Turns what was seen of a step into points and a status, and results into an exit code."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from raysteps.common.text import count, join_and
from raysteps.course.manifest import Step

if TYPE_CHECKING:  # `list` and `next` ask what a step is worth, and no result
    from raysteps.results.model import HiddenResult, ImageResult, Results, StepResult, TestResult
    from raysteps.results.statuses import Status


def max_points(step: Step, *, judged: bool) -> float:
    """What the step is worth: without the judge's plan, as in a student's kit, the visible part."""
    share = 1.0 if judged else 1.0 - step.weight_hidden
    return round(step.points * share, 1)


def test_weights(step: Step, all_tests: Mapping[str, Sequence[str]], missing: Collection[str]) -> dict[str, float]:
    """By name of the test: those of one function share what the function is worth. One that names no function counts
    like the average of the others. `missing`: functions that are not written; a test that needs one says nothing of
    the others that it names, where these have tests of their own."""
    alone = {name for names in all_tests.values() if not set(names) & set(missing) for name in names}
    tests = {
        test: [name for name in names if name not in alone or not set(names) & set(missing)]
        for test, names in all_tests.items()
    }
    amounts = Counter(function for functions in tests.values() for function in functions)
    weights = {
        name: sum(step.share_of(function) / amounts[function] for function in functions)
        for name, functions in tests.items()
    }
    known = [weight for weight in weights.values() if weight]
    average = sum(known) / len(known) if known else 1.0
    return {name: round(weight or average, 6) for name, weight in weights.items()}


def still_missing(
    unfinished: Collection[str],
    all_tests: Mapping[str, Sequence[str]],
    passed: Collection[str],
    hidden: Collection[HiddenResult] = (),
) -> list[str]:
    """Of the functions with a RAYSTEPS_TODO those that are not written. One that passes half of its own tests, or half
    of its hidden cases, is: the line was forgotten, or put in so that what another one fails weighs less. A stub passes
    fewer, by luck."""
    right = {item.name for item in hidden if item.kind == "function" and item.share >= 0.5}
    found = []
    for name in unfinished:
        naming = {test: set(names) for test, names in all_tests.items() if name in names}
        own = {test for test, names in naming.items() if names == {name}} or set(naming)
        if name not in right and 2 * len(own & set(passed)) < len(own):
            found.append(name)
    return found


def is_right(result: StepResult) -> bool:
    """Whether the step by itself, between steps of the reference, is all that it should be."""
    passed = [item.passed for items in (result.tests, result.images, result.hidden) for item in items]
    return bool(passed) and all(passed)


_LEAST = 0.1  # points: what a step has is a multiple of it, and with a mistake so much less than all


def status_and_points(result: StepResult, step: Step) -> tuple[Status, float]:
    """Visible tests, pictures and hidden items by what was earned of each, and whether the step works together with the
    steps before it."""
    points = step.points * (step.weight_tests * result.share_of_tests + step.weight_images * result.share_of_images)
    points += step.points * step.weight_hidden * result.share_of_hidden
    points += step.points * step.weight_together * result.cumulative.passed
    outcomes = {item.outcome for items in (result.tests, result.images, result.hidden) for item in items}
    if is_right(result) and result.cumulative.passed:
        return "passed", result.max
    points = min(round(points, 1), round(result.max - _LEAST, 1))
    if "crashed" in outcomes:
        return "crashed", points
    if "timeout" in outcomes:
        return "timeout", points
    return ("partial" if points > 0 else "failed"), points


def sum_up(result: StepResult) -> list[str]:
    """The first crash or timeout, what failed, in numbers, and what waits."""
    kinds: tuple[tuple[str, str, Sequence[TestResult | ImageResult | HiddenResult]], ...] = (
        ("test", "failed", result.tests),
        ("picture", "did not pass", result.images),
        ("hidden item", "lost points", result.hidden),
    )
    messages, waiting = [], []
    for noun, verb, items in kinds:
        failed = [item for item in items if not item.passed and not item.waits_for]
        if failed:
            messages.append(f"{len(failed)} of {count(len(items), noun)} {verb}.")
        aside = sum(bool(item.waits_for) for item in items)
        waiting += [count(aside, noun)] if aside else []
    if waiting:
        passed = sum(test.passed for test in result.tests)
        right = "" if messages or not passed else f" All that is written is right: {count(passed, 'test')} passed."
        messages.append(f"Waiting for that: {join_and(waiting)}.{right}")
    outcomes = [(item.outcome, item.message) for items in (result.tests, result.images) for item in items]
    bad = [message for outcome, message in outcomes if outcome in ("crashed", "timeout")]
    return bad[:1] + messages


def exit_code(results: Results) -> int:
    """0 all passed (a bonus need not be started), 3 when building is the only trouble, else 1."""
    open_steps = [
        step for step in results.steps if step.status != "passed" and not (step.bonus and step.status == "not-started")
    ]
    if not open_steps:
        return 0
    return 3 if all(step.status == "does-not-build" for step in open_steps) else 1
