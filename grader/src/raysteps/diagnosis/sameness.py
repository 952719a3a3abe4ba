"""Whether two wrong answers are wrong in the same way."""

import math

from raysteps.diagnosis.answers import Said
from raysteps.judge.bvhs import BVH
from raysteps.judge.functions import Case, Function
from raysteps.judge.tokens import Garbled
from raysteps.judge.trees import TREE

_ABSOLUTE = 2e-4
_RELATIVE = 2e-3
_MOST_WORDS = 2000
_WORDS_ONLY = 0.25  # of the weight of an answer with the same numbers
_TURNED = 0.8  # of the weight of the same number
_MOSTLY = 0.6


def _close(one: str, other: str) -> bool:
    """Whether two words of answers are the same, or nearly the same number."""
    if one == other:
        return True
    try:
        a, b = float(one), float(other)
    except ValueError:
        return False
    if math.isnan(a) or math.isnan(b):
        return math.isnan(a) and math.isnan(b)
    return abs(a - b) <= _ABSOLUTE + _RELATIVE * max(abs(a), abs(b)) < math.inf


def _agreement(right_line: str, mistake_line: str, my_line: str) -> float:
    """Of the words that are wrong in one of the two, the share in which they are the same. Opposite signs count less:
    who takes the wrong end of a sphere turns its normal in one way or the other. Without any word that is the same they
    count nothing: light that is taken away is not light that is added."""
    rights, mistakes, mines = right_line.split(), mistake_line.split(), my_line.split()
    if not len(mistakes) == len(mines) <= _MOST_WORDS:
        return 0.0
    rights = rights if len(rights) == len(mines) else [""] * len(mines)
    pairs = [
        (mistake, own)
        for right, mistake, own in zip(rights, mistakes, mines, strict=True)
        if not (_close(right, mistake) and _close(right, own))
    ]
    worth = [_worth(*pair) for pair in pairs]
    if not pairs:
        return 1.0
    return sum(worth) / len(worth) if max(worth) == 1.0 else 0.0


def _worth(mistake: str, mine: str) -> float:
    if _close(mistake, mine):
        return 1.0
    turned = mistake.removeprefix("-") if mistake.startswith("-") else f"-{mistake}"
    return _TURNED if {mistake, mine} == {"0", "1"} or _close(turned, mine) else 0.0


def _fits(function: Function, case: Case, mistake: str, mine: str) -> bool:
    """Whether the judge would call my answer right if the mistake's were the truth."""
    try:
        expected, actual = function.answer.parse(mistake), function.answer.parse(mine)
        return not function.answer.problem(case.inputs, expected, actual)
    except (Garbled, ArithmeticError, ValueError):
        return False


def likeness(function: Function, case: Case, right: str, mistake: Said, mine: Said) -> float:
    """From 0 to 1, for two answers that are both wrong. `right`: what the reference answers."""
    if mistake.line == mine.line and mistake.problem == mine.problem:
        return 1.0
    same_problem = mistake.problem == mine.problem
    if not mistake.line or not mine.line:
        return 0.0  # one of them gave no answer
    if function.answer in (TREE, BVH) or mistake.line.startswith("#") or mine.line.startswith("#"):
        return 1.0 if same_problem else 0.0  # everybody divides space in another way
    if mistake.line.startswith("threw") or mine.line.startswith("threw"):
        return 1.0 if same_problem else 0.0
    if _fits(function, case, mistake.line, mine.line):
        return 1.0
    if not same_problem:
        return 0.0
    agreement = _agreement(right, mistake.line, mine.line)
    return agreement if agreement >= _MOSTLY else _WORDS_ONLY
