"""Asks the functions of a step, compares with the reference, and says what is wrong."""

from collections.abc import Sequence
from functools import lru_cache

from raysteps.common.errors import GraderFault
from raysteps.common.text import count, shorten
from raysteps.course.manifest import Step
from raysteps.judge.choice_sequence import complexity
from raysteps.judge.counterexamples import LONGEST, Examples
from raysteps.judge.functions import Case, functions_of, seed_of
from raysteps.judge.plan import FunctionPlan, Plan
from raysteps.judge.random_source import RandomSource
from raysteps.judge.spared_work import spares_nothing
from raysteps.judge.worker import Ask, JudgedCase, TimeBudget, ask_worker, judge_reply
from raysteps.results.model import CaseGroup, HiddenResult, Termination

ORDINARY_SHARE = 0.9  # of the first kind of cases must be right, or the function earns nothing
_REFERENCE_SECONDS = 600


@lru_cache(maxsize=256)  # a class is asked the same questions
def _cases(step: str, function: str, amounts: tuple[tuple[str, int], ...], seed: int | str) -> tuple[Case, ...]:
    known = functions_of(step[:2])[function]
    cases: list[Case] = []
    for name, amount in amounts:
        draw = RandomSource(seed_of(step, function, name, seed))
        make = known.by_name[name].make
        cases += [Case(function, name, make(draw)) for _ in range(amount)]
    return tuple(cases)


def make_cases(step: Step, plan: FunctionPlan, seed: int | str) -> Sequence[Case]:
    """The same seed makes the same cases on every machine."""
    return _cases(step.id, plan.name, tuple(plan.cases.items()), seed)


def reference_lines(ask: Ask, cases: Sequence[Case], name: str) -> list[str]:
    """What the reference answers; one that does not is the kit's fault."""
    replies = ask_worker(ask, cases, TimeBudget(_REFERENCE_SECONDS, 1)).replies
    bad = next((reply for reply in replies if reply.outcome != "ok" or reply.line.startswith("bad-case")), None)
    if bad is not None:
        raise GraderFault(f"{name}: the reference does not answer the judge: {bad.note or bad.line}")
    return [reply.line for reply in replies]


def _group(name: str, judged: Sequence[JudgedCase]) -> CaseGroup:
    right = sum(not one.verdict.problem for one in judged)
    return CaseGroup(name, len(judged), right)


def _groups(plan: FunctionPlan, judged: Sequence[JudgedCase]) -> list[CaseGroup]:
    return [_group(name, [one for one in judged if one.case.group == name]) for name in plan.cases]


def _is_right(group: CaseGroup, may_miss: float) -> bool:
    return group.cases - group.right <= may_miss * group.cases


def _first_wrong(judged: Sequence[JudgedCase], wrong: Sequence[CaseGroup]) -> JudgedCase | None:
    """Of the first kind that is wrong, the simplest case; rather one that was asked."""
    for group in wrong:
        found = [one for one in judged if one.case.group == group.name and one.verdict.problem]
        if found:
            return min(found, key=lambda one: (not one.asked, complexity(one.case.inputs)))
    return None


def _message(
    name: str, groups: Sequence[CaseGroup], wrong: Sequence[CaseGroup], found: JudgedCase, share: float
) -> str:
    right = len(groups) - len(wrong)
    kinds = "; ".join(f"{group.name} ({group.right} of {group.cases} right)" for group in wrong)
    text = f"{name}: {right} of {count(len(groups), 'kind')} of cases {'is' if right == 1 else 'are'} right; "
    text += f"wrong: {kinds}. In a case of '{found.case.group}': {found.verdict.problem}."
    if share == 0 and right:
        least = f"at least {ORDINARY_SHARE * 100:.0f} % of '{groups[0].name}'"
        text += f" Until {least} are right, the other kinds do not count."
    return text


def _outcome(judged: Sequence[JudgedCase]) -> Termination:
    outcomes = {one.outcome for one in judged}
    bad: tuple[Termination, ...] = ("crashed", "timeout", "wrong")
    return next((outcome for outcome in bad if outcome in outcomes), "ok")


def _result(
    step: Step, plan: FunctionPlan, judged: Sequence[JudgedCase], seed: int, examples: Examples | None
) -> HiddenResult:
    groups = _groups(plan, judged)
    wrong = [group for group in groups if not _is_right(group, plan.may_miss)]
    ordinary = groups[0].right >= ORDINARY_SHARE * groups[0].cases
    share = (len(groups) - len(wrong)) / len(groups) if ordinary else 0.0
    result = HiddenResult(plan.name, "function", round(share, 6), plan.weight, groups=groups)
    result.spares_nothing = spares_nothing(functions_of(step.number)[plan.name], judged)
    found = _first_wrong(judged, wrong)
    if found is not None:
        result.message = shorten(_message(plan.name, groups, wrong, found, share), LONGEST)
        if examples is not None:
            place = [one.case for one in judged if one.case.group == found.case.group].index(found.case)
            found, result.case = examples.smallest(step, found, place, seed)
        result.given = shorten(found.case.given(), LONGEST)
        result.expected = shorten(found.verdict.expected, LONGEST)
        result.actual = shorten(found.verdict.actual, LONGEST)
        result.outcome = _outcome(judged)
    return result


def run_hidden_tests(
    step: Step,
    plan: Plan,
    student: Ask,
    reference: Ask,
    seed: int,
    seconds: float | None = None,
    examples: Examples | None = None,
) -> list[HiddenResult]:
    """One result for each function, whatever the student's worker does. `seconds`: the limit of one run of it.
    Without `examples`, wrong cases are shown as they were asked."""
    results = []
    budget = TimeBudget(step.seconds if seconds is None else seconds, len(plan.functions))
    for function_plan in plan.functions:
        function = functions_of(step.number)[function_plan.name]
        cases = make_cases(step, function_plan, seed)
        expected = reference_lines(reference, cases, function.name)
        replies = ask_worker(student, cases, budget)
        judged = [judge_reply(function, *three) for three in zip(cases, expected, replies.replies, strict=True)]
        result = _result(step, function_plan, judged, seed, examples)
        result.seconds = round(replies.seconds, 3)
        results.append(result)
    return results
