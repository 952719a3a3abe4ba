"""The choices that a case is made of. Whoever changes a choice gets another case of the same kind: what the generator
guarantees, such as unit vectors and a distance from edges, still holds."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias, TypeVar

from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector
from raysteps.judge.simplicity import simplest_real

T = TypeVar("T")
Chosen: TypeAlias = float | int | bool | Vector

_MOST = 5000  # choices of one case
_AHEAD: Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Choice:
    """What was chosen, and between which bounds; the type of the value tells what kind of choice it was."""

    value: Chosen
    low: float = 0.0
    high: float = 0.0


class Unfit(Exception):
    """No case can be made from these choices."""


class Recorder(Draw):
    """Draws like any other, and remembers what was chosen."""

    def __init__(self, seed: str) -> None:
        super().__init__(seed)
        self.choices: list[Choice] = []

    def fine(self, low: float, high: float) -> float:
        value = super().fine(low, high)
        self.choices.append(Choice(value, low, high))
        return value

    def whole(self, low: int, high: int) -> int:
        value = super().whole(low, high)
        self.choices.append(Choice(value, low, high))
        return value

    def chance(self, share: float) -> bool:
        value = super().chance(share)
        self.choices.append(Choice(value))
        return value

    def direction(self) -> Vector:
        value = super().direction()
        self.choices.append(Choice(value))
        return value

    def until(self, good: Callable[[T], bool], make: Callable[[], T]) -> T:
        """What was not good is forgotten."""
        before = len(self.choices)

        def make_anew() -> T:
            del self.choices[before:]
            return make()

        return super().until(good, make_anew)


class Replay(Draw):
    """Chooses what it is told. Where nothing is left, or something of another kind is asked for, it takes something
    simple; `choices` are what was really chosen."""

    def __init__(self, values: Sequence[Chosen]) -> None:
        super().__init__("")
        self.choices: list[Choice] = []
        self._values = values
        self._next = 0

    def _told(self, kind: type) -> Chosen | None:
        if len(self.choices) >= _MOST:
            raise Unfit
        if self._next >= len(self._values) or type(self._values[self._next]) is not kind:
            return None
        self._next += 1
        return self._values[self._next - 1]

    def fine(self, low: float, high: float) -> float:
        told = self._told(float)
        value = min(max(told, low), high) if isinstance(told, float) else simplest_real(low, high)
        self.choices.append(Choice(value, low, high))
        return value

    def whole(self, low: int, high: int) -> int:
        told = self._told(int)
        value = min(max(told if isinstance(told, int) else 0, low), high)
        self.choices.append(Choice(value, low, high))
        return value

    def chance(self, share: float) -> bool:
        value = self._told(bool) is True
        self.choices.append(Choice(value))
        return value

    def direction(self) -> Vector:
        told = self._told(tuple)
        value = told if isinstance(told, tuple) else _AHEAD
        self.choices.append(Choice(value))
        return value

    def until(self, good: Callable[[T], bool], make: Callable[[], T]) -> T:
        """A second try would make the same."""
        found = make()
        if not good(found):
            raise Unfit
        return found
