"""Exact directions along the axes."""

from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector


def next_axis(axis: Vector) -> Vector:
    """At a right angle to an axis, and as exact."""
    return axis[1], axis[2], axis[0]


def with_zeros(draw: Draw, axis: int, sign: float) -> Vector:
    """Along the axis of that number; the zeros have either sign."""
    x, y, z = (sign if i == axis else draw.sign() * 0.0 for i in range(3))
    return x, y, z
