"""Kinds of answers: how each is read, told in words, and compared with the reference's."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from raysteps.common.errors import GraderFault
from raysteps.common.text import printable, shorten
from raysteps.judge.numbers import Vector, text
from raysteps.judge.tokens import Garbled, Tokens
from raysteps.judge.values import Frame, Inputs, Ray, vector_words

T = TypeVar("T")


class Wasteful(str):
    """A problem of an answer that is right, but spares no work."""

    __slots__ = ()


class TooLarge(str):
    """A problem of an answer that the judge does not look through: it earns nothing, and may be right."""

    __slots__ = ()


@dataclass(frozen=True)
class Verdict:
    """What the judge thinks of one answer; `problem` is empty when it is right."""

    problem: str
    expected: str
    actual: str

    @property
    def wasteful(self) -> bool:
        return isinstance(self.problem, Wasteful)

    @property
    def decided(self) -> bool:
        """Whether the answer says anything about the function."""
        return not isinstance(self.problem, TooLarge)


@dataclass(frozen=True)
class Answer(Generic[T]):
    """`problem` is given inputs, the reference's answer and the student's."""

    read: Callable[[Tokens], T]
    words: Callable[[T], str]
    problem: Callable[[Inputs, T, T], str]

    def parse(self, line: str) -> T:
        tokens = Tokens(line)
        value = self.read(tokens)
        tokens.end()
        return value

    def reference(self, name: str, inputs: Inputs, line: str) -> T:
        """The reference must be right by its own measure: a NaN or a lost surface is the kit's fault."""
        try:
            value = self.parse(line)
        except Garbled as error:
            raise GraderFault(f"{name}: the reference answers {shorten(line, 200)!r}: {error}") from error
        problem = self.problem(inputs, value, value)
        if problem:
            given = "; ".join(f"{key}: {value.words()}" for key, value in inputs.items())
            raise GraderFault(f"{name}: the reference fails: {problem}; given {shorten(given, 1000)}")
        return value

    def verdict(self, name: str, inputs: Inputs, expected_line: str, actual_line: str) -> Verdict:
        """Compares; whatever the student's line holds, it is an answer, and perhaps a wrong one."""
        expected = self.reference(name, inputs, expected_line)
        if actual_line.startswith("threw"):
            said = printable(actual_line.removeprefix("threw").strip())
            return Verdict(
                "an exception left the function", self.words(expected), f"an exception: {shorten(said, 200)}"
            )
        try:
            actual = self.parse(actual_line)
            return Verdict(self.problem(inputs, expected, actual), self.words(expected), self.words(actual))
        except (Garbled, OverflowError) as error:
            return Verdict("no proper answer came", self.words(expected), str(error))


def read_vector(tokens: Tokens) -> Vector:
    return tokens.vector()


def read_ray(tokens: Tokens) -> Ray:
    return Ray(tokens.vector(), tokens.vector())


def read_frame(tokens: Tokens) -> Frame:
    return Frame(tokens.vector(), tokens.vector(), tokens.vector(), tokens.real(), tokens.real())


def read_whole(tokens: Tokens) -> int:
    return tokens.whole(-(1 << 31))


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
