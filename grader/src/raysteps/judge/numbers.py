"""Numbers as the worker knows them: float32, in the shortest text that names it. What is computed with vectors before
that is in double precision."""

import math
import struct
from typing import TypeAlias

import numpy as np

from raysteps.common.vectors import Vector, add, dot

Number: TypeAlias = float | int

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


def mirrored(direction: Vector, normal: Vector) -> Vector:
    return add(direction, normal, -2 * dot(direction, normal))
