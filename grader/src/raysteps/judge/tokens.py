"""Reads the words of an answer. They come from a student's process: anything may stand there."""

from raysteps.judge.numbers import Vector

_MOST_DIGITS = 40
_LONGEST = 2_000_000  # characters; the largest tree is half as long


class Garbled(Exception):
    """An answer that does not have the form that the worker writes."""


class Tokens:
    """The words of one answer, from left to right."""

    def __init__(self, line: str) -> None:
        if len(line) > _LONGEST:
            raise Garbled("the answer is too long")
        self._words = line.split()
        self._next = 0

    def word(self) -> str:
        if self._next >= len(self._words):
            raise Garbled("the answer is too short")
        self._next += 1
        return self._words[self._next - 1]

    def real(self) -> float:
        found = self.word()
        try:
            return float(found) if len(found) <= _MOST_DIGITS else _refuse(found)
        except ValueError:
            return _refuse(found)

    def whole(self, low: int = 0, high: int = 1 << 31) -> int:
        return self.wholes(1, low, high)[0]

    def wholes(self, size: int, low: int, high: int) -> tuple[int, ...]:
        """Many at once."""
        found = self._words[self._next : self._next + size]
        if len(found) < size:
            raise Garbled("the answer is too short")
        self._next += size
        try:
            numbers = tuple(int(word) if len(word) <= _MOST_DIGITS else low - 1 for word in found)
        except ValueError:
            raise Garbled("the answer holds a word where a whole number belongs") from None
        if numbers and not low <= min(numbers) <= max(numbers) <= high:
            raise Garbled("the answer holds a number out of range")
        return numbers

    def flag(self) -> bool:
        return self.whole(0, 1) == 1

    def vector(self) -> Vector:
        return self.real(), self.real(), self.real()

    def at_end(self) -> bool:
        return self._next == len(self._words)

    def end(self) -> None:
        if not self.at_end():
            raise Garbled("the answer is too long")


def _refuse(found: str) -> float:
    raise Garbled("the answer holds a word where a number belongs")
