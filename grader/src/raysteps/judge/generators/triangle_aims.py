"""Cases of step 02: rays that are aimed at a triangle or beside it."""

from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector, add, cross, minus, rounded, times, unit
from raysteps.judge.surfaces import Triangle
from raysteps.judge.values import Inputs, Ray

_STEEP = 0.2  # least cosine between ray and normal: seen edge-on, rounding may decide


def case(t: Triangle, ray: Ray, draw: Draw) -> Inputs:
    return {"triangle": Triangle(t.a, t.b, t.c, draw.fill()), "ray": ray}


def normal_of(t: Triangle) -> Vector:
    return unit(cross(minus(t.b, t.a), minus(t.c, t.a)))


def inside(draw: Draw, t: Triangle) -> Vector:
    """Well within the edges."""
    u = draw.real(0.08, 0.8)
    return t.at(u, draw.real(0.08, 0.92 - u))


def beside(draw: Draw, t: Triangle) -> Vector:
    """A little outside of one edge, between its ends."""
    out, along = -draw.real(0.05, 0.3), draw.real(0.1, 0.9)
    corners = [(out, along), (along, out), (along - out, 1 - along)]
    return t.at(*corners[draw.whole(0, 2)])


def towards(draw: Draw, t: Triangle, point: Vector, side: float, distance: float) -> Ray:
    """Comes from the triangle's front (side 1) or back (side -1)."""
    direction = times(-1.0, draw.above(times(side, normal_of(t)), _STEEP))
    return Ray(rounded(add(point, direction, -distance)), rounded(direction))
