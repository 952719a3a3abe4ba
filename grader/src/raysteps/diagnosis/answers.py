"""What a program answers to the fixed cases of a step.

They are drawn from a word of their own: so they say nothing about the seed of a grade, and what a known mistake answers
to them is computed once.
"""

import hashlib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from raysteps.judge.functions import Case, Function
from raysteps.judge.generators import functions_of
from raysteps.judge.judging import make_cases, reference_lines
from raysteps.judge.plan import Plan
from raysteps.judge.time_budget import TimeBudget
from raysteps.judge.worker_client import Ask, Reply, ask_worker
from raysteps.kit.built_kit import BuiltKit
from raysteps.kit.manifest import Step
from raysteps.programs.asking import reference_answers
from raysteps.sandbox.task import Ran

_SEED = "diagnosis"
_LONGEST = 6000  # characters; of a longer answer its hash will do


@dataclass(frozen=True)
class Said:
    """A wrong answer. `problem` is what the judge finds wrong; not `known`: it was never asked."""

    line: str
    problem: str
    known: bool = True


Answers: TypeAlias = Mapping[str, Mapping[int, Said]]  # by function, then by number of the case; only what is not right


@dataclass(frozen=True)
class Questions:
    """To one function, with what the reference answers."""

    function: Function
    cases: Sequence[Case]
    right: Sequence[str]


def _right_answers(kit: BuiltKit, function: str, cases: Sequence[Case]) -> list[str]:
    def ask(stdin: bytes, _seconds: float) -> Ran:
        return reference_answers(kit, stdin)

    return reference_lines(ask, cases, function)


def questions_of(kit: BuiltKit, step: Step, plan: Plan, names: Collection[str]) -> dict[str, Questions]:
    """By function, in the order of the step; the same for everybody."""
    found = {}
    for function in plan.functions:
        if function.name in names:
            cases = make_cases(step, function, _SEED)
            known = functions_of(step.number)[function.name]
            found[function.name] = Questions(known, cases, _right_answers(kit, function.name, cases))
    return found


def _said(function: Function, case: Case, right: str, reply: Reply) -> Said | None:
    """None for a right answer."""
    if not reply.asked:
        return Said("", "", known=False)
    if reply.outcome != "ok":
        return Said("", reply.outcome)
    if reply.line == right:
        return None
    problem = function.answer.verdict(case.function, case.inputs, right, reply.line).problem
    if not problem:
        return None
    long = len(reply.line) > _LONGEST
    return Said("#" + hashlib.sha256(reply.line.encode()).hexdigest()[:32] if long else reply.line, str(problem))


def listen(questions: Mapping[str, Questions], ask: Ask, seconds: float) -> Answers:
    """Asks a program. `seconds`: the limit of one run of its worker."""
    budget = TimeBudget(seconds, len(questions))
    heard: dict[str, dict[int, Said]] = {}
    for name, known in questions.items():
        replies = ask_worker(ask, known.cases, budget).replies
        said = [_said(known.function, *three) for three in zip(known.cases, known.right, replies, strict=True)]
        heard[name] = {number: one for number, one in enumerate(said) if one is not None}
    return heard
