"""Vectors of three floats, as Python computes: nothing is rounded to float32.

What looks alike and differs has stayed where it is. Records of the inspector hold words for numbers that are not
finite, and its sums follow Python's `sum`; figures are flat; the makers of scenes stand alone.
"""

import math
from typing import TypeAlias

Vector: TypeAlias = tuple[float, float, float]


def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def add(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    """a + factor * b"""
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


def minus(a: Vector, b: Vector) -> Vector:
    return add(a, b, -1.0)


def times(factor: float, v: Vector) -> Vector:
    return factor * v[0], factor * v[1], factor * v[2]


def length(v: Vector) -> float:
    return math.hypot(*v)


def unit(v: Vector) -> Vector:
    """The vector at length 1. It must not be zero."""
    return times(1 / length(v), v)
