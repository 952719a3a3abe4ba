"""Points on surfaces, to see which boxes a surface touches."""

from functools import lru_cache
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector, add
from raysteps.judge.surfaces import Sphere, Surface, Triangle

Points: TypeAlias = npt.NDArray[np.float64]  # one in each row

_POINTS = 14  # on each surface


def _sphere_points(sphere: Sphere, draw: Draw) -> list[Vector]:
    return [add(sphere.center, draw.direction(), sphere.radius) for _ in range(_POINTS)]


def _triangle_points(t: Triangle, draw: Draw) -> list[Vector]:
    """The corners, and points all over it."""
    points = [t.a, t.b, t.c]
    while len(points) < _POINTS:
        u, v = draw.real(0, 1), draw.real(0, 1)
        if u + v <= 1:
            points.append(t.at(u, v))
    return points


def _points(surface: Surface, draw: Draw) -> Points:
    if isinstance(surface, Sphere):
        return np.array(_sphere_points(surface, draw))
    assert isinstance(surface, Triangle)
    return np.array(_triangle_points(surface, draw))


@lru_cache(maxsize=128)  # the reference's tree and a student's are looked at with the same ones
def points_on(surfaces: tuple[Surface, ...]) -> tuple[Points, ...]:
    """The same ones every time."""
    draw = Draw("points on surfaces")
    return tuple(_points(surface, draw) for surface in surfaces)
