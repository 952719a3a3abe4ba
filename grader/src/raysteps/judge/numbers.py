"""Numbers as the worker knows them: float32, in the shortest text that names it."""

import math
import struct
from typing import TypeAlias

import numpy as np

Number: TypeAlias = float | int
Vector: TypeAlias = tuple[float, float, float]

_FLOAT = struct.Struct("f")


def f32(value: float) -> float:
    """The nearest float32."""
    rounded: float = _FLOAT.unpack(_FLOAT.pack(value))[0]
    return rounded


def text(value: Number) -> str:
    """Read back by the worker it is the same float32."""
    if isinstance(value, int):
        return str(value)
    if math.isnan(value):
        return "nan"
    if value == 0:
        return "-0" if math.copysign(1, value) < 0 else "0"
    return str(np.float32(value)).removesuffix(".0")


def rounded(v: Vector) -> Vector:
    """Each component as the nearest float32."""
    return f32(v[0]), f32(v[1]), f32(v[2])


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
    return times(1 / length(v), v)


def mirrored(direction: Vector, normal: Vector) -> Vector:
    return add(direction, normal, -2 * dot(direction, normal))
