"""Compares numbers. Each check gives a few words about what is wrong, or nothing; the words hold no numbers, so that
they can be shown where the cases must stay secret."""

import math
from dataclasses import dataclass

from raysteps.judge.numbers import Vector, dot, length, minus


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
    if math.isnan(actual):
        return "" if math.isnan(expected) else f"{what} is NaN"
    if expected == actual or abs(expected - actual) <= tolerance.of(expected) < math.inf:
        return ""
    return f"{what} is wrong"


def vector(what: str, expected: Vector, actual: Vector, tolerance: Tolerance = SMALL) -> str:
    """By the distance of the two."""
    if any(math.isnan(x) for x in actual):
        return f"{what} is NaN"
    gap = length(minus(expected, actual))
    return "" if gap <= tolerance.of(length(expected)) < math.inf else f"{what} is wrong"


def channels(what: str, expected: Vector, actual: Vector, tolerance: Tolerance = COLORS) -> str:
    """Each channel for itself."""
    problems = [real(what, *pair, tolerance) for pair in zip(expected, actual, strict=True)]
    return next((problem for problem in problems if problem), "")


def unit_length(what: str, actual: Vector) -> str:
    if any(math.isnan(x) for x in actual):
        return f"{what} is NaN"
    return "" if abs(length(actual) - 1) <= _UNIT else f"{what} does not have length 1"


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
        if wrong_length.endswith("NaN"):
            return wrong_length
        opposite = length(actual) > 0 and angle(expected, (-actual[0], -actual[1], -actual[2])) <= degrees
        return f"{what} points the other way" if opposite else f"{what} is wrong"
    return wrong_length


def off_surface(position: Vector, normal: Vector, origin: Vector, farthest: float = 0.0101) -> str:
    """Whether a ray starts a little off a surface, on the side that the normal points to."""
    offset = minus(origin, position)
    slack = 4e-7 * (length(position) + 1)  # float has no finer steps there
    if not length(offset) <= farthest + slack:
        return "the ray does not start at the hit"
    return "" if dot(offset, normal) > 0 else "the ray starts on the wrong side of the surface, or on it"
