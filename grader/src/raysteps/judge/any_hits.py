"""Searches through a tree for any hit before a distance: yes or no, and with how much work."""

from dataclasses import dataclass

from raysteps.judge.answers import Answer
from raysteps.judge.searches import hit_without_asking, problem_of, read_all, too_many_asked, words_of
from raysteps.judge.tokens import Tokens
from raysteps.judge.values import Inputs


@dataclass(frozen=True)
class AnyHit:
    """Whether one ray meets anything before the distance, and how many surfaces were asked for it."""

    asked: int
    found: bool


def _read_one(tokens: Tokens) -> AnyHit:
    return AnyHit(tokens.whole(), tokens.flag())


def _one_in_words(answer: AnyHit) -> str:
    return "true, something is hit nearer" if answer.found else "false, nothing is hit nearer"


def one_any_problem(expected: AnyHit, actual: AnyHit) -> str:
    if expected.found and not actual.found:
        return "a surface is hit nearer than the distance, and the answer is that none is"
    if actual.found and not expected.found:
        return "no surface is hit nearer than the distance, and the answer is that one is"
    return hit_without_asking(hit=actual.found, asked=actual.asked)


def _problem(inputs: Inputs, expected: tuple[AnyHit, ...], actual: tuple[AnyHit, ...]) -> str:
    return problem_of(inputs, (expected, actual), one_any_problem, too_many_asked)


ANY_HITS: Answer[tuple[AnyHit, ...]] = Answer(
    lambda tokens: read_all(tokens, _read_one),
    lambda answers: words_of(answers, _one_in_words),
    _problem,
)
