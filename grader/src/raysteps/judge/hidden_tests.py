"""Asks the functions of a step, compares with the reference, and says what is wrong."""

from collections import Counter
from collections.abc import Collection, Sequence
from functools import lru_cache
from math import inf
from statistics import median

from raysteps.common.errors import GraderFault
from raysteps.common.text import count, join_and, shorten
from raysteps.common.vectors import length, minus
from raysteps.course.manifest import Step
from raysteps.judge.answers import TooLarge, TooMuchWork, Verdict
from raysteps.judge.choice_sequence import Choice, ChoiceValue, InvalidChoice, Recorder, Replay, complexity
from raysteps.judge.counterexamples import LONGEST, Counterexamples
from raysteps.judge.functions import AGAIN, Case, Function, Group, functions_of, seed_of
from raysteps.judge.plan import FunctionPlan, Plan
from raysteps.judge.protocol import Inputs
from raysteps.judge.random_source import MAX_TRIES, RandomSource
from raysteps.judge.statistics import UnevenProblem
from raysteps.judge.worker import Ask, JudgedCase, TimeBudget, ask_worker, judge_reply
from raysteps.results.model import CaseGroup, HiddenResult, ImageResult, Termination

# The same question twice, and between them one that differs in a single input: whoever keeps something from call to
# call, or knows a question again by a part of it, gives the answer of another question.

_TRIES = 15  # to change one input and no other


def _redrawn(choice: Choice, draw: RandomSource) -> ChoiceValue:
    """Another value, between the same bounds."""
    if isinstance(choice.value, bool):
        return not choice.value
    if isinstance(choice.value, int):
        return draw.whole(round(choice.low), round(choice.high))
    if isinstance(choice.value, tuple):
        return draw.direction()
    return draw.fine(choice.low, choice.high)


def _with_one_changed(kind: Group, choices: Sequence[Choice], draw: RandomSource) -> Inputs | None:
    """None where the kind has no such case."""
    values = [choice.value for choice in choices]
    place = draw.whole(0, len(values) - 1)
    values[place] = _redrawn(choices[place], draw)
    try:
        return kind.make(Replay(values))
    except (InvalidChoice, ArithmeticError, ValueError, LookupError):
        return None


def _neighbour(kind: Group, choices: Sequence[Choice], inputs: Inputs, name: str, draw: RandomSource) -> Inputs | None:
    """Differs in the input of that name and, where that can be, in no other."""
    best: tuple[int, Inputs] | None = None
    for _ in range(_TRIES):
        other = _with_one_changed(kind, choices, draw)
        if other is None or other.keys() != inputs.keys() or other[name] == inputs[name]:
            continue
        different = sum(other[one] != inputs[one] for one in inputs)
        if best is None or different < best[0]:
            best = different, other
        if different == 1:
            break
    return None if best is None else best[1]


def cases_asked_again(function: Function, kind: str, seed: str, amount: int) -> list[Case]:
    """Three by three: a question, its neighbour, and the question once more. Each input is changed in its turn."""
    ordinary = function.groups[0]
    draw, turn = Recorder(seed), RandomSource(f"{seed}/neighbours")
    found: list[Inputs] = []
    for asked in range(MAX_TRIES):
        draw.choices.clear()
        inputs = ordinary.make(draw)
        names = list(inputs)
        other = _neighbour(ordinary, draw.choices, inputs, names[asked % len(names)], turn)
        if other is not None:
            found += [inputs, other, inputs]
        if len(found) >= amount:
            return [Case(function.name, kind, one) for one in found[:amount]]
    raise GraderFault(f"{function.name}: the judge finds no questions that differ in one input")


@lru_cache(maxsize=256)  # a class is asked the same questions
def _cases(step: str, function: str, amounts: tuple[tuple[str, int], ...], seed: int | str) -> tuple[Case, ...]:
    known = functions_of(step[:2])[function]
    cases: list[Case] = []
    for name, amount in amounts:
        if name == AGAIN:
            cases += cases_asked_again(known, name, seed_of(step, function, name, seed), amount)
            continue
        draw = RandomSource(seed_of(step, function, name, seed))
        make = known.by_name[name].make
        cases += [Case(function, name, make(draw)) for _ in range(amount)]
    return tuple(cases)


def make_cases(step: Step, plan: FunctionPlan, seed: int | str) -> Sequence[Case]:
    """The same seed makes the same cases on every machine."""
    return _cases(step.id, plan.name, tuple(plan.cases.items()), seed)


def make_all_cases(step: Step, plan: Plan, seed: int | str) -> None:
    """Those of all functions, so that they are there when they are wanted."""
    for function in plan.functions:
        make_cases(step, function, seed)


# How a function's share comes about.

_ORDINARY = 0.5  # of a function's points are for the first kind of cases, which are ordinary
_SOME = 0.25  # of the ordinary cases: below, the other kinds count less and less
_MOSTLY = 0.5  # of a function with a kind that is wrong: what is right beyond it counts less
_BEYOND = 1 / 3
_SPARES_NOTHING = 0.25  # a tree or a search is there to spare tests; one that spares none earns no more
_NEAR = 0.5  # of the share of wrong answers that come near the right ones
_MAY_MISS = 0.01  # of the cases of a kind, by rounding
_TOLD = 0.05  # of a kind's points, when answers that are wrong earn that much
_DIGITS = 6  # of a share
_REFERENCE_SECONDS = 600


def reference_lines(ask: Ask, cases: Sequence[Case], name: str) -> list[str]:
    """What the reference answers; one that does not is the kit's fault."""
    replies = ask_worker(ask, cases, TimeBudget(_REFERENCE_SECONDS, 1)).replies
    bad = next((reply for reply in replies if reply.outcome != "ok" or reply.line.startswith("bad-case")), None)
    if bad is not None:
        raise GraderFault(f"{name}: the reference does not answer the judge: {bad.note or bad.line}")
    return [reply.line for reply in replies]


def _group(name: str, judged: Sequence[JudgedCase]) -> CaseGroup:
    """Cases that were not asked any more count like those that were."""
    group = CaseGroup(name, len(judged), sum(not one.verdict.problem for one in judged))
    asked = [one.verdict for one in judged if one.asked]
    if _is_right(group):
        group.share = 1.0
    elif asked:
        credit = sum(one.credit for one in asked) / len(asked)
        group.share = round(max(credit, _NEAR * nearness(asked)), _DIGITS)
    return group


def nearness(verdicts: Sequence[Verdict]) -> float:
    """From 0 to 1, how much nearer the answers come to the right ones than one answer to all of them does, their median
    in each direction. No answer counts as more than twice as far off as that one."""
    pairs = [(one.right, one.given) for one in verdicts if one.right is not None]
    if not pairs:
        return 0.0
    x, y, z = (median(right[axis] for right, _ in pairs) for axis in range(3))
    far = off = 0.0
    for right, given in pairs:
        most = length(minus(right, (x, y, z)))
        gap = 2 * most if given is None else length(minus(right, given))
        far += most
        off += gap if gap < 2 * most else 2 * most
    return max(0.0, 1.0 - off / far) if 0 < far < inf else 0.0


def _groups(plan: FunctionPlan, judged: Sequence[JudgedCase]) -> list[CaseGroup]:
    return [_group(name, [one for one in judged if one.case.group == name]) for name in plan.cases]


def _is_right(group: CaseGroup) -> bool:
    return group.cases - group.right <= _MAY_MISS * group.cases


def constant_answer_share(judged: Sequence[JudgedCase]) -> float:
    """The share of cases that whoever always gives the same answer has right."""
    answers = Counter(one.verdict.constant for one in judged)
    most = max(answers.values(), default=0)
    return round(most / len(judged), _DIGITS) if most > 1 else 0.0


def function_share(plan: FunctionPlan, groups: Sequence[CaseGroup], judged: Sequence[JudgedCase]) -> float:
    """Half of it is for ordinary cases, beyond what one answer to all of them gives, and half for the other kinds by
    their weights; these count in full only where at least a quarter of the first half is earned."""
    ordinary, *others = groups
    free = constant_answer_share([one for one in judged if one.case.group == ordinary.name])
    usual = max(0.0, (ordinary.share - free) / (1 - free)) if free < 1 else ordinary.share
    weight = sum(plan.kind_weights[group.name] for group in others)
    if not weight:
        return usual
    rest = sum(group.share * plan.kind_weights[group.name] for group in others) / weight
    return _ORDINARY * usual + (1 - _ORDINARY) * rest * min(1.0, usual / _SOME)


def _with_a_mistake(share: float) -> float:
    """A feature that is missing is seldom most of the cases, and costs more than these."""
    return min(share, _MOSTLY + _BEYOND * (share - _MOSTLY))


# Points for few tests of objects. A picture counts the tests that are asked for, and a search may do the arithmetic of
# every object itself, so few that were counted prove nothing: what must have spared them is the tree, which the judge
# looks at. Where it spares nothing, few tests earn nothing either.

_MAX_WASTE = 0.5  # of a kind of cases
_TOO_GOOD = 0.25  # of what is allowed: not even rays into the empty sky make it so little


def spares_nothing(function: Function, judged: Sequence[JudgedCase]) -> bool:
    """No case of a kind is right, and most are not because they spare no work: another mistake says nothing. Cases
    count that were asked, and whose answer could be read."""
    for group in function.groups:
        problems = [one.verdict.problem for one in judged if one.asked and one.case.group == group.name]
        readable = [problem for problem in problems if not isinstance(problem, TooLarge)]
        wasteful = sum(isinstance(problem, TooMuchWork) for problem in readable)
        if group.saves and all(readable) and wasteful > _MAX_WASTE * len(readable):
            return True
    return False


def unspared(images: Sequence[ImageResult], hidden: Sequence[HiddenResult]) -> str:
    """Why few tests in the pictures of the step earn nothing, or nothing. Where most of a picture is sky, few objects
    are tested without any merit: so a step of which another picture tests too many keeps its points."""
    return "" if any(_is_above(image) for image in images) else why_unspared(hidden)


def revoke_tree_points(images: Sequence[ImageResult], hidden: Sequence[HiddenResult]) -> None:
    """Of the visible pictures in which few objects may be tested."""
    why = why_unspared(hidden)
    every_one = unspared(images, hidden)
    for image in images:
        if not why or image.max_share is None:
            continue
        few = (image.share_tested or 0) < _TOO_GOOD * image.max_share
        if image.passed and (few or every_one):
            image.passed, image.outcome, image.message = False, "wrong", why
        if not image.passed:
            image.share = 0.0


def _is_above(image: ImageResult) -> bool:
    return image.max_share is not None and (image.share_tested or 0) > image.max_share


def why_unspared(hidden: Sequence[HiddenResult]) -> str:
    """In words; nothing where the judge's cases are spared something."""
    names = [item.name for item in hidden if item.spares_nothing]
    if not names:
        return ""
    return (
        f"The picture is right, but nothing spared its few tests of objects: in the judge's cases {join_and(names)} "
        f"{'spares' if len(names) == 1 else 'spare'} a ray nothing. Let the tree spare them, and test a surface by "
        "surface->hit(ray) only."
    )


# What a student is told.


def _first_wrong(judged: Sequence[JudgedCase], wrong: Sequence[CaseGroup]) -> JudgedCase | None:
    """Of the first kind that is wrong, the simplest case; rather one that was asked."""
    for group in wrong:
        found = [one for one in judged if one.case.group == group.name and one.verdict.problem]
        if found:
            return min(found, key=lambda one: (not one.asked, complexity(one.case.inputs)))
    return None


_KEPT = (
    " A question was asked, then a similar one, then the first again, and the answers do not fit together. Does the "
    "function keep something from one call to the next, as in a `static` variable?"
)


def _keeps_something(judged: Sequence[JudgedCase]) -> bool:
    """Whether one question was answered in two ways, or a similar one like the one before it."""
    again = [one for one in judged if one.case.group == AGAIN]
    for first, other, last in zip(again[::3], again[1::3], again[2::3], strict=False):
        if all(one.asked and one.outcome in ("ok", "wrong") for one in (first, other, last)):
            in_two_ways = bool(last.verdict.problem) and not first.verdict.problem
            if in_two_ways or (other.verdict.problem and other.verdict.actual == first.verdict.actual):
                return True
    return False


_PARTLY = (
    " Answers that come near, or are right in part, earn something; a function that is wrong somewhere earns two "
    "thirds at most."
)


def _earns_in_part(group: CaseGroup) -> bool:
    return group.share - group.right / group.cases >= _TOLD


def _in_words(group: CaseGroup) -> str:
    earned = f", {100 * group.share:.0f} % earned" if _earns_in_part(group) else ""
    return f"{group.name} ({group.right} of {group.cases} right{earned})"


def _message(name: str, groups: Sequence[CaseGroup], wrong: Sequence[CaseGroup], found: JudgedCase, kept: bool) -> str:
    right = len(groups) - len(wrong)
    kinds = "; ".join(map(_in_words, wrong))
    partly = _PARTLY if any(map(_earns_in_part, wrong)) else ""
    text = f"{name}: {right} of {count(len(groups), 'kind')} of cases {'is' if right == 1 else 'are'} right; "
    again = _KEPT if kept and found.case.group == AGAIN else ""
    return f"{text}wrong: {kinds}.{partly} In a case of '{found.case.group}': {found.verdict.problem}.{again}"


def _outcome(judged: Sequence[JudgedCase]) -> Termination:
    outcomes = {one.outcome for one in judged}
    bad: tuple[Termination, ...] = ("crashed", "timeout", "wrong")
    return next((outcome for outcome in bad if outcome in outcomes), "ok")


def _result(
    step: Step, plan: FunctionPlan, judged: Sequence[JudgedCase], seed: int, examples: Counterexamples | None
) -> HiddenResult:
    groups = _groups(plan, judged)
    wrong = [group for group in groups if not _is_right(group)]
    share = _with_a_mistake(function_share(plan, groups, judged)) if wrong else 1.0
    result = HiddenResult(plan.name, "function", round(share, _DIGITS), plan.weight, groups=groups)
    result.spares_nothing = spares_nothing(functions_of(step.number)[plan.name], judged)
    if result.spares_nothing:
        result.share = min(result.share, _SPARES_NOTHING)
    found = _first_wrong(judged, wrong)
    if found is not None:
        result.message = shorten(_message(plan.name, groups, wrong, found, _keeps_something(judged)), LONGEST)
        if isinstance(found.verdict.problem, UnevenProblem):
            result.histogram = found.verdict.problem.histogram  # a smaller case has too few samples to show it
        alone = found.case.group != AGAIN  # else it may be right when it is asked alone
        if examples is not None and alone and result.share > examples.above:
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
    examples: Counterexamples | None = None,
    hung: Collection[str] = (),
) -> list[HiddenResult]:
    """One result for each function, whatever the student's worker does. `seconds`: the limit of one run of it.
    Without `examples`, wrong cases are shown as they were asked. `hung`: functions that did so before."""
    results = []
    budget = TimeBudget(step.seconds if seconds is None else seconds, len(plan.functions))
    for function_plan in plan.functions:
        function = functions_of(step.number)[function_plan.name]
        cases = make_cases(step, function_plan, seed)
        expected = reference_lines(reference, cases, function.name)
        budget.known_to_hang = function.name in hung
        replies = ask_worker(student, cases, budget)
        judged = [judge_reply(function, *three) for three in zip(cases, expected, replies.replies, strict=True)]
        result = _result(step, function_plan, judged, seed, examples)
        result.seconds = round(replies.seconds, 3)
        results.append(result)
    return results
