"""Kinds of answers: how each is read, told in words, and compared with the reference's."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from raysteps.common.errors import GraderFault
from raysteps.common.text import printable, shorten
from raysteps.common.vectors import Vector, dot, length, minus
from raysteps.judge.protocol import Frame, Inputs, ProtocolError, Ray, TokenReader, text, vector_words

T = TypeVar("T")


class PlainlyWrong(str):
    """A problem that tells that something is wrong, and not how."""

    __slots__ = ()


def plainly_wrong(what: str) -> PlainlyWrong:
    """In words."""
    return PlainlyWrong(f"{what} is wrong")


class TooMuchWork(str):
    """A problem of an answer that is right, but spares no work."""

    __slots__ = ()


class TooLarge(str):
    """A problem of an answer that the judge does not look through: it earns nothing, and may be right."""

    __slots__ = ()


class NumericProblem(str):
    """A problem that ends in a number. Of two cases with the same `kind` the number may be another."""

    kind: str


def numeric_problem(kind: str, number: str) -> NumericProblem:
    """Both in one text."""
    problem = NumericProblem(f"{kind}: {number}")
    problem.kind = kind
    return problem


@dataclass(frozen=True)
class Verdict:
    """What the judge thinks of one answer; `problem` is empty when it is right. `credit`: how much of it is right,
    from 0 to 1. `right` and `given`: the two answers where they are vectors that can be near each other."""

    problem: str
    expected: str
    actual: str
    credit: float = 0.0
    constant: str = ""  # the right answer without what nobody answers by himself, to tell equal ones
    right: Vector | None = None
    given: Vector | None = None


@dataclass(frozen=True)
class Answer(Generic[T]):
    """`problem` is given inputs, the reference's answer and the student's; `credit` the same of a wrong answer that has
    parts: how many of them are right, from 0 to 1."""

    read: Callable[[TokenReader], T]
    words: Callable[[T], str]
    problem: Callable[[Inputs, T, T], str]
    credit: Callable[[Inputs, T, T], float] = lambda _inputs, _expected, _actual: 0.0
    constant: Callable[[T], str] | None = None  # `words` without what was counted
    near: Callable[[T], Vector] | None = None  # where an answer that is nearly right is worth something
    is_drawn: bool = False  # by chance: the reference's answer is one of many that are right

    def parse(self, line: str) -> T:
        tokens = TokenReader(line)
        value = self.read(tokens)
        tokens.end()
        return value

    def reference(self, name: str, inputs: Inputs, line: str) -> T:
        """The reference must be right by its own measure: a NaN or a lost surface is the kit's fault."""
        try:
            value = self.parse(line)
        except ProtocolError as error:
            raise GraderFault(f"{name}: the reference answers {shorten(line, 200)!r}: {error}") from error
        problem = self.problem(inputs, value, value)
        if problem:
            given = "; ".join(f"{key}: {value.words()}" for key, value in inputs.items())
            raise GraderFault(f"{name}: the reference fails: {problem}; given {shorten(given, 1000)}")
        return value

    def measured(self, name: str, inputs: Inputs, line: str) -> "MeasuredReference[T]":
        """What all others are compared with."""
        value = self.reference(name, inputs, line)
        shown = f"for instance {self.words(value)}" if self.is_drawn else self.words(value)
        constant = shown if self.constant is None else self.constant(value)
        right = self.near(value) if self.near is not None else None
        return MeasuredReference(line, value, Verdict("", shown, shown, 1.0, constant, right, right))

    def verdict(self, inputs: Inputs, reference: "MeasuredReference[T]", actual_line: str) -> Verdict:
        """Compares; whatever the student's line holds, it is an answer, and perhaps a wrong one."""
        expected, whole = reference.value, reference.verdict
        if actual_line == reference.line:  # as most are, and this one was measured
            return whole
        shown, constant, right = whole.expected, whole.constant, whole.right
        if actual_line.startswith("threw"):
            said = printable(actual_line.removeprefix("threw").strip())
            return Verdict(
                "an exception left the function",
                shown,
                f"an exception: {shorten(said, 200)}",
                constant=constant,
                right=right,
            )
        try:
            with np.errstate(all="ignore"):  # numbers that are none are wrong, and nothing for a terminal
                actual = self.parse(actual_line)
                problem = self.problem(inputs, expected, actual)
                problem = problem and (_no_number_said(problem, reference.line, actual_line) or problem)
                credit = self.credit(inputs, expected, actual) if problem else 1.0
                given = self.near(actual) if self.near is not None else None
                return Verdict(problem, shown, self.words(actual), credit, constant, right, given)
        except GraderFault:
            raise
        except Exception as error:  # the reference's answer was read just so: this is about the student's
            said = shorten(str(error), 200)
            return Verdict("no proper answer came", shown, said, constant=constant, right=right)


@dataclass(frozen=True)
class MeasuredReference(Generic[T]):
    """A line of the reference's, which is right by its own measure."""

    line: str
    value: T
    verdict: Verdict


# A number that is none is what is wrong, whatever else follows from it: a direction of infinite length points nowhere.

_NONE = {"nan": "NaN, which is no number", "inf": "infinite"}


def no_number(what: str, *numbers: float) -> str:
    """Whether one of them is infinite or NaN, in words."""
    odd = "nan" if any(map(math.isnan, numbers)) else "inf" if any(map(math.isinf, numbers)) else ""
    return f"{what} is {_NONE[odd]}" if odd else ""


def _no_number_said(problem: str, right_line: str, line: str) -> str:
    """The same of a whole answer, where the right one holds no such number and the problem does not tell."""
    if type(problem) not in (str, PlainlyWrong) or "NaN" in problem or "infinite" in problem:
        return ""
    if not any(odd in line for odd in _NONE):  # long lines have many words
        return ""
    odd = {word.removeprefix("-") for word in line.split()} & {*_NONE} - {*right_line.replace("-", "").split()}
    return f"the answer holds a number that is {_NONE['nan' if 'nan' in odd else 'inf']}" if odd else ""


def read_vector(tokens: TokenReader) -> Vector:
    return tokens.vector()


def read_ray(tokens: TokenReader) -> Ray:
    return Ray(tokens.vector(), tokens.vector())


def read_frame(tokens: TokenReader) -> Frame:
    return Frame(tokens.vector(), tokens.vector(), tokens.vector(), tokens.real(), tokens.real())


def read_whole(tokens: TokenReader) -> int:
    return tokens.whole(-(1 << 31))


def itself(v: Vector) -> Vector:
    """What is near to a vector."""
    return v


def words_of_vector(v: Vector) -> str:
    return vector_words(v)


def words_of_ray(ray: Ray) -> str:
    return ray.words()


def words_of_frame(frame: Frame) -> str:
    return frame.words()


def words_of_number(number: float | int) -> str:
    return text(number)


def first(*problems: str) -> str:
    """The first thing that is wrong, or nothing."""
    return next((problem for problem in problems if problem), "")


def share_right(*problems: str) -> float:
    """How many of the parts have no problem."""
    return problems.count("") / len(problems)


def share_beyond(easy: int, *problems: str) -> float:
    """As `share_right`, but 0 where only some of the last `easy` parts are right: one answer to all questions has
    these."""
    return share_right(*problems) if "" in problems[: len(problems) - easy] else 0.0


# Compares numbers. Each check gives a few words about what is wrong, or nothing; the words hold no numbers, so that
# they can be shown where the cases must stay secret.


@dataclass(frozen=True)
class Tolerance:
    """What two correct methods may differ by."""

    absolute: float = 1e-4
    relative: float = 1e-4

    def of(self, size: float) -> float:
        return self.absolute + self.relative * abs(size)


LENGTHS = Tolerance(1e-3, 5e-4)  # distances and positions
COLORS = Tolerance(2e-4, 1e-3)
SMALL = Tolerance(1e-4, 1e-4)
_UNIT = 1e-3
_DEGREES = 0.3


def real(what: str, expected: float, actual: float, tolerance: Tolerance = SMALL) -> str:
    """NaN equals nothing, unless NaN is right."""
    if math.isnan(actual) and math.isnan(expected):
        return ""
    if expected == actual or abs(expected - actual) <= tolerance.of(expected) < math.inf:
        return ""
    return no_number(what, actual) or plainly_wrong(what)


def vector(what: str, expected: Vector, actual: Vector, tolerance: Tolerance = SMALL) -> str:
    """By the distance of the two."""
    gap = length(minus(expected, actual))
    if gap <= tolerance.of(length(expected)) < math.inf:
        return ""
    return no_number(what, *actual) or plainly_wrong(what)


def channels(what: str, expected: Vector, actual: Vector, tolerance: Tolerance = COLORS) -> str:
    """Each channel for itself."""
    problems = [real(what, *pair, tolerance) for pair in zip(expected, actual, strict=True)]
    return next((problem for problem in problems if problem), "")


def number_answer(what: str, tolerance: Tolerance) -> Answer[float]:
    """One number, compared with the reference's."""
    return Answer(
        lambda tokens: tokens.real(),
        words_of_number,
        lambda _, expected, actual: real(what, expected, actual, tolerance),
    )


def unit_length(what: str, actual: Vector) -> str:
    if abs(length(actual) - 1) <= _UNIT:
        return ""
    return no_number(what, *actual) or f"{what} does not have length 1"


def angle(a: Vector, b: Vector) -> float:
    """In degrees; exact for small ones too."""
    size = length(a) * length(b)
    if not 0 < size < math.inf:
        return math.inf
    return math.degrees(2 * math.asin(min(1.0, length(minus(_scaled(a), _scaled(b))) / 2)))


def _scaled(v: Vector) -> Vector:
    size = length(v)
    return v[0] / size, v[1] / size, v[2] / size


def direction(what: str, expected: Vector, actual: Vector, degrees: float = _DEGREES) -> str:
    """Same direction, and length 1."""
    wrong_length = unit_length(what, actual)
    if not angle(expected, actual) <= degrees:
        odd = no_number(what, *actual)
        if odd:
            return odd
        opposite = length(actual) > 0 and angle(expected, (-actual[0], -actual[1], -actual[2])) <= degrees
        return f"{what} points the other way" if opposite else plainly_wrong(what)
    return wrong_length


FARTHEST = 0.0101  # that a ray may start from its hit; the kit's threshold is 0.001


def ray_start_problem(position: Vector, normal: Vector, origin: Vector, farthest: float = FARTHEST) -> str:
    """Whether a ray starts a little off a surface, on the side that the normal points to."""
    offset = minus(origin, position)
    slack = 4e-7 * (length(position) + 1)  # float has no finer steps there
    if not length(offset) <= farthest + slack:
        return "the ray does not start at the hit"
    if dot(offset, normal) > 0:
        return ""
    return f"the ray starts {'on' if length(offset) <= slack else 'on the wrong side of'} the surface"
