"""Draws inputs at random. Everything is float32-exact, and the same seed draws the same everywhere."""

import math
import random
from collections.abc import Callable
from typing import TypeVar

from raysteps.common.errors import GraderFault
from raysteps.common.vectors import Vector, add, cross, dot, length, minus, times, unit
from raysteps.judge.protocol import Fill, Light, Ray, f32, rounded
from raysteps.judge.surfaces import Sphere, Triangle

T = TypeVar("T")
MAX_TRIES = 100_000


def circle(turn: float) -> tuple[float, float]:
    """Cosine and sine of so many turns; a quarter turn is exact."""
    if turn * 4 == (quarters := round(turn * 4)):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarters % 4]
    angle = 2 * math.pi * turn
    return math.cos(angle), math.sin(angle)


class RandomSource:
    """A source of random values. The first five are the choices that all others are made of: who changes these has
    another source (judge/choice_sequence.py)."""

    def __init__(self, seed: str) -> None:
        self._random = random.Random(seed)  # noqa: S311 - cases, not secrets

    def fine(self, low: float, high: float) -> float:
        """Not rounded to float32: for what is only computed with."""
        return low + (high - low) * self._random.random()

    def whole(self, low: int, high: int) -> int:
        """From low to high, both included."""
        return low + int(self._random.random() * (high - low + 1))

    def chance(self, share: float) -> bool:
        return self._random.random() < share

    def direction(self) -> Vector:
        """A unit vector; all directions are equally likely."""
        z = 2 * self._random.random() - 1
        angle = 2 * math.pi * self._random.random()
        radius = math.sqrt(1 - z * z)
        return rounded((radius * math.cos(angle), radius * math.sin(angle), z))

    def until(self, good: Callable[[T], bool], make: Callable[[], T]) -> T:
        """The first that is good. A kind of cases that finds none is the kit's fault, not an endless loop."""
        for _ in range(MAX_TRIES):
            found = make()
            if good(found):
                return found
        raise GraderFault(f"of {MAX_TRIES} cases that were drawn for the judge not one is usable")

    def real(self, low: float, high: float) -> float:
        return f32(self.fine(low, high))

    def logarithmic(self, low: float, high: float) -> float:
        """Each power of ten between them is as likely as any other."""
        return f32(math.exp(self.fine(math.log(low), math.log(high))))

    def sign(self) -> float:
        return 1.0 if self.chance(0.5) else -1.0

    def eighths(self, low: float, high: float) -> float:
        """A multiple of 1/8: sums and products of such numbers are exact."""
        return self.whole(math.ceil(low * 8), math.floor(high * 8)) / 8

    def point(self, reach: float) -> Vector:
        return self._reals(-reach, reach)

    def _reals(self, low: float, high: float) -> Vector:
        return rounded((self.fine(low, high), self.fine(low, high), self.fine(low, high)))

    def simple_point(self, reach: float) -> Vector:
        return self.eighths(-reach, reach), self.eighths(-reach, reach), self.eighths(-reach, reach)

    def slanted(self, least: float = 0.05) -> Vector:
        """A direction that is parallel to no axis and to no plane of the axes."""
        return self.until(lambda found: min(abs(x) for x in found) >= least, self.direction)

    def axis(self) -> Vector:
        """Along x, y or z, either way."""
        number, sign = self.whole(0, 2), self.sign()
        x, y, z = (sign if i == number else 0.0 for i in range(3))
        return x, y, z

    def diagonal(self) -> Vector:
        """Between three axes, as near to one as to the others; more than half of them with three equal parts, whose
        cross product with themselves, parts moved round, is zero."""
        side = self.sign() * f32(math.sqrt(1 / 3))
        if self.chance(0.5):
            return side, side, side
        return side, self.sign() * side, self.sign() * side

    def above(self, normal: Vector, low: float, high: float = 1.0) -> Vector:
        """A direction whose cosine with the normal lies between low and high."""
        side = unit(cross(normal, self.across(normal)))
        other = cross(normal, side)
        cosine, turn = self.fine(low, high), circle(self.fine(0, 1))
        sine = math.sqrt(max(0.0, 1 - cosine * cosine))
        found = add(times(cosine, normal), side, sine * turn[0])
        return rounded(unit(add(found, other, sine * turn[1])))

    def across(self, normal: Vector) -> Vector:
        """Some direction that is not along the normal."""
        return self.until(lambda found: abs(dot(found, normal)) < 0.9, self.direction)

    def ray_towards(self, target: Vector, distance: float) -> Ray:
        direction = self.direction()
        return Ray(rounded(add(target, direction, -distance)), direction)

    def color(self, low: float = 0.1, high: float = 1.0) -> Vector:
        return self._reals(low, high)

    def light(self, position: Vector) -> Light:
        return Light(position, self.color(0.3, 1.6))

    def fill(self) -> Fill:
        return Fill(
            self.color(), self.real(0.2, 1), self.real(0.2, 1), self.real(2, 40), self.real(0, 0.5), self.real(1, 2)
        )

    def sphere(self, reach: float = 5.0, low: float = 0.5, high: float = 3.0) -> Sphere:
        return Sphere(self.point(reach), self.real(low, high))

    def triangle(self, reach: float = 4.0) -> Triangle:
        """No sliver: wide in every direction."""

        def wide(t: Triangle) -> bool:
            area = length(cross(minus(t.b, t.a), minus(t.c, t.a)))
            longest = max(length(minus(t.b, t.a)), length(minus(t.c, t.b)), length(minus(t.a, t.c)))
            return area > 0.35 * longest * longest and longest > 0.3 * reach

        return self.until(wide, lambda: Triangle(self.point(reach), self.point(reach), self.point(reach)))


# Exact directions along the axes.


def next_axis(axis: Vector) -> Vector:
    """At a right angle to an axis, and as exact."""
    return axis[1], axis[2], axis[0]


def with_zeros(draw: RandomSource, axis: int, sign: float) -> Vector:
    """Along the axis of that number; the zeros have either sign."""
    x, y, z = (sign if i == axis else draw.sign() * 0.0 for i in range(3))
    return x, y, z
