"""Whether two wrong answers are wrong in the same way."""

import math

from raysteps.diagnosis.answers import Said
from raysteps.judge.functions import Case, Function
from raysteps.judge.tokens import Garbled
from raysteps.judge.trees import TREE

_ABSOLUTE = 2e-4
_RELATIVE = 2e-3
_MOST_WORDS = 2000
_WORDS_ONLY = 0.25  # of the weight of an answer with the same numbers


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


def _same_words(one: str, other: str) -> bool:
    ones, others = one.split(), other.split()
    return len(ones) == len(others) <= _MOST_WORDS and all(_close(*pair) for pair in zip(ones, others, strict=True))


def _fits(function: Function, case: Case, mistake: str, mine: str) -> bool:
    """Whether the judge would call my answer right if the mistake's were the truth."""
    try:
        expected, actual = function.answer.parse(mistake), function.answer.parse(mine)
        return not function.answer.problem(case.inputs, expected, actual)
    except (Garbled, ArithmeticError, ValueError):
        return False


def likeness(function: Function, case: Case, mistake: Said, mine: Said) -> float:
    """From 0 to 1, for two answers that are both wrong."""
    if mistake.line == mine.line and mistake.problem == mine.problem:
        return 1.0
    same_problem = mistake.problem == mine.problem
    if not mistake.line or not mine.line:
        return 0.0  # one of them gave no answer
    if function.answer is TREE or mistake.line.startswith("#") or mine.line.startswith("#"):
        return 1.0 if same_problem else 0.0  # everybody divides space in another way
    if mistake.line.startswith("threw") or mine.line.startswith("threw"):
        return 1.0 if same_problem else 0.0
    if same_problem and _same_words(mistake.line, mine.line):
        return 1.0
    if _fits(function, case, mistake.line, mine.line):
        return 1.0
    return _WORDS_ONLY if same_problem else 0.0
