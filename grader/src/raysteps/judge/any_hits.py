"""Searches through a tree for any hit before a distance: yes or no, and with how much work."""

from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.judge.answers import Answer, first
from raysteps.judge.searches import MOST_RAYS, too_many_asked
from raysteps.judge.tokens import Garbled, Tokens
from raysteps.judge.values import Inputs


@dataclass(frozen=True)
class AnyHit:
    """Whether one ray meets anything before the distance, and how many surfaces were asked for it."""

    asked: int
    found: bool


def _read(tokens: Tokens) -> tuple[AnyHit, ...]:
    answers: list[AnyHit] = []
    while not tokens.at_end():
        if len(answers) == MOST_RAYS:
            raise Garbled("the answer is too long")
        answers.append(AnyHit(tokens.whole(), tokens.flag()))
    return tuple(answers)


def _one_in_words(answer: AnyHit) -> str:
    found = "true, something is hit nearer" if answer.found else "false, nothing is hit nearer"
    return f"{found}, {answer.asked} surfaces asked"


def _words(answers: Sequence[AnyHit]) -> str:
    return "; ".join(map(_one_in_words, answers[:2])) + ("; and more" if len(answers) > 2 else "") or "nothing"


def _one_problem(expected: AnyHit, actual: AnyHit) -> str:
    if expected.found and not actual.found:
        return "a surface is hit nearer than the distance, and the answer is that none is"
    if actual.found and not expected.found:
        return "no surface is hit nearer than the distance, and the answer is that one is"
    return "a hit came without asking a surface" if actual.found and actual.asked == 0 else ""


def _problem(inputs: Inputs, expected: tuple[AnyHit, ...], actual: tuple[AnyHit, ...]) -> str:
    if len(expected) != len(actual):
        return "no proper answer came"
    return first(
        *(_one_problem(*pair) for pair in zip(expected, actual, strict=True)),
        too_many_asked(inputs, [answer.asked for answer in actual]),
    )


ANY_HITS = Answer(_read, _words, _problem)
