"""The choices that a case is made of. Whoever changes a choice gets another case of the same kind: what the generator
guarantees, such as unit vectors and a distance from edges, still holds.
"""

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from itertools import permutations, product
from typing import NamedTuple, TypeAlias, TypeVar

from raysteps.common.vectors import Vector, dot
from raysteps.judge.protocol import Inputs, Number, rounded, text
from raysteps.judge.random_source import RandomSource

# Which numbers and inputs are simple, and what simpler ones there are.

_NEGATIVE_ZERO = 3.0
_NOT_FINITE = 2.0
_WHOLE = (0, 1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48, 50, 64, 100, 128, 200)
_PARTS = (0.5, 0.25, 0.75, 0.2, 0.4, 0.6, 0.8, 0.1, 0.3, 0.7, 0.9, 0.05, 1.5, 2.5, 0.01, 0.98, 0.001)
_LEEWAY = 0.25
_NEAREST = 8  # of many directions that are equally simple


@lru_cache(maxsize=1 << 14)
def _cost(size: float) -> float:
    digits = text(size).partition("e")[0].replace(".", "").strip("0")
    more = 0.0 if digits == "1" else 0.25
    return len(digits) + more + 0.5 * (size != int(size)) + 0.5 * abs(math.log10(size))


def cost(number: Number) -> float:
    """Least of all 0, then 1: few digits, no fraction, no sign, neither large nor small."""
    if number == 0:
        return _NEGATIVE_ZERO if math.copysign(1, number) < 0 else 0.0
    if not math.isfinite(number):
        return _NOT_FINITE
    return _cost(abs(float(number))) + (0.25 if number < 0 else 0.0)


def complexity(inputs: Inputs) -> tuple[int, float]:
    """The order of cases: fewer numbers first, and of as many the simpler ones."""
    numbers = [number for value in inputs.values() for number in value.numbers()]
    return len(numbers), round(sum(map(cost, numbers)), 3)


_REALS = sorted({sign * float(size) for size in (*_WHOLE, *_PARTS) for sign in (1, -1)} | {0.0}, key=cost)


@lru_cache(maxsize=1 << 12)
def _reals(low: float, high: float) -> Sequence[float]:
    return [number for number in _REALS if low <= number <= high]


def simplest_real(low: float, high: float) -> float:
    return next(iter(_reals(low, high)), low)


def simpler_reals(value: float, low: float, high: float) -> list[float]:
    """The simplest first, up to a little less simple ones: other numbers depend on it. With what rounding makes of the
    value."""
    near = [round(value), round(2 * value) / 2, round(value, 1), float(f"{value:.2g}")]
    found = {*_reals(low, high), *(float(number) for number in near if low <= number <= high)}
    found.discard(value)
    return sorted((number for number in found if cost(number) < cost(value) + _LEEWAY), key=lambda x: (cost(x), x))


def simpler_wholes(value: int, low: int, high: int) -> list[int]:
    """All of a few; of many the simple ones, and some on the way to the least."""
    if high - low <= _NEAREST:
        found = set(range(low, high + 1))
    else:
        near = {low, (value + low) // 2, value - 1, *_WHOLE, *(-size for size in _WHOLE)}
        found = {number for number in near if low <= number <= high}
    return sorted(found - {value}, key=lambda number: (cost(number), number))


def _all_of(sizes: Vector) -> list[Vector]:
    """In every order, with every sign."""
    turned = {(a * i, b * j, c * k) for a, b, c in permutations(sizes) for i, j, k in product((1, -1), repeat=3)}
    return sorted({rounded((a + 0.0, b + 0.0, c + 0.0)) for a, b, c in turned})


_AXES = _all_of((1.0, 0.0, 0.0))
_IN_A_PLANE = _all_of((0.6, 0.8, 0.0))
_SLANTED = _all_of((0.36, 0.48, 0.8))


def simpler_directions(value: Vector) -> list[Vector]:
    """Axes, and unit vectors of few digits; the nearest of them first."""
    kinds = (_AXES, _IN_A_PLANE, _SLANTED)
    if value in _AXES:
        kinds = (_AXES, [], [])
    near = [sorted(kind, key=lambda other: -dot(value, other))[:_NEAREST] for kind in kinds]
    return [direction for kind in near for direction in kind if direction != value]


T = TypeVar("T")
ChoiceValue: TypeAlias = float | int | bool | Vector

_MAX = 5000  # choices of one case
_AHEAD: Vector = (0.0, 0.0, 1.0)


class Choice(NamedTuple):
    """What was chosen, and between which bounds; the type of the value tells what kind of choice it was."""

    value: ChoiceValue
    low: float = 0.0
    high: float = 0.0


class InvalidChoice(Exception):
    """No case can be made from these choices."""


class Recorder(RandomSource):
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


class Replay(RandomSource):
    """Chooses what it is told. Where nothing is left, or something of another kind is asked for, it takes something
    simple; `choices` are what was really chosen."""

    def __init__(self, values: Sequence[ChoiceValue]) -> None:
        super().__init__("")
        self.choices: list[Choice] = []
        self._values = values
        self._next = 0

    def _told(self, kind: type) -> ChoiceValue | None:
        if len(self.choices) >= _MAX:
            raise InvalidChoice
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
            raise InvalidChoice
        return found
