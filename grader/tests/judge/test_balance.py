"""Questions with two answers only: whoever gives one of them to all must not have nearly all of them right, or a few
wrong answers cost as much as all."""

from statistics import mean

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.judge.functions import Function, functions_of
from raysteps.judge.hidden_tests import constant_answer_share, make_cases, reference_lines
from raysteps.judge.plan import FunctionPlan, read_plan
from raysteps.judge.worker import JudgedCase, reference_answers
from raysteps.toolchain.kit_artifacts import BuiltKit

_SEEDS = range(1, 9)
_MAX = 0.66  # of the ordinary cases, on average
_EVER = 0.8


def _yes_or_no(steps: list[Step], project: Project) -> list[tuple[Step, FunctionPlan, Function]]:
    plans = [(step, plan) for step in steps if (plan := read_plan(project, step)) is not None]
    asked = [(step, one, functions_of(step.number)[one.name]) for step, plan in plans for one in plan.functions]
    return [(step, one, function) for step, one, function in asked if function.yes_or_no]


def test_no_constant_answer_is_right_in_most_ordinary_cases(kit: BuiltKit, project: Project, steps: list[Step]) -> None:
    found = _yes_or_no(steps, project)
    assert len(found) == 5
    for step, plan, function in found:
        shares = [_for_nothing(kit, step, plan, function, seed) for seed in _SEEDS]
        assert mean(shares) <= _MAX, (function.name, shares)
        assert max(shares) <= _EVER, (function.name, shares)


def _for_nothing(kit: BuiltKit, step: Step, plan: FunctionPlan, function: Function, seed: int) -> float:
    ordinary = function.groups[0].name
    cases = [case for case in make_cases(step, plan, seed) if case.group == ordinary]
    lines = reference_lines(lambda stdin, _seconds: reference_answers(kit, stdin), cases, function.name)
    verdicts = [case.verdict(function.answer, line, line) for case, line in zip(cases, lines, strict=True)]
    return constant_answer_share(
        [JudgedCase(case, verdict, "ok") for case, verdict in zip(cases, verdicts, strict=True)]
    )
