"""Means and slopes."""

import math
from collections.abc import Sequence
from dataclasses import dataclass


def geometric_mean(values: Sequence[float]) -> float:
    """Of numbers above 0."""
    return math.exp(math.fsum(math.log(value) for value in values) / len(values))


@dataclass(frozen=True)
class Growth:
    """How y grows with x: about x to the power of `exponent`, and by `per_doubling` with each doubling of x."""

    exponent: float
    per_doubling: float


def _slope(xs: Sequence[float], ys: Sequence[float]) -> float:
    middle_x, middle_y = math.fsum(xs) / len(xs), math.fsum(ys) / len(ys)
    spread = math.fsum((x - middle_x) ** 2 for x in xs)
    return math.fsum((x - middle_x) * (y - middle_y) for x, y in zip(xs, ys, strict=True)) / spread


def growth(points: Sequence[tuple[float, float]]) -> Growth:
    """Lines of least squares through at least two points: log y over log x, and y over the doublings of x."""
    doublings = [math.log2(x) for x, _ in points]
    values = [y for _, y in points]
    return Growth(_slope(doublings, [math.log2(value) for value in values]), _slope(doublings, values))
