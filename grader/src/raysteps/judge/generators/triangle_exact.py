"""Cases of step 02: triangles in planes of the axes, where all numbers are exact."""

from raysteps.judge.drawing import Draw
from raysteps.judge.generators.axes import with_zeros
from raysteps.judge.generators.triangle_aims import case
from raysteps.judge.numbers import Vector, add
from raysteps.judge.surfaces import Triangle
from raysteps.judge.values import Inputs, Ray


def _flat_triangle(draw: Draw, legs: tuple[int, ...] = (1, 2, 3, 4)) -> tuple[Triangle, int]:
    """In a plane of two axes, with a right angle between two of these legs; and the number of the third axis."""
    axis, corner = draw.whole(0, 2), draw.simple_point(4)
    sizes = [draw.sign() * legs[draw.whole(0, len(legs) - 1)] for _ in range(2)]

    def moved(which: int, by: float) -> Vector:
        moves = [0.0, 0.0, 0.0]
        moves[(axis + which) % 3] = by
        return add(corner, (moves[0], moves[1], moves[2]))

    return Triangle(corner, moved(1, sizes[0]), moved(2, sizes[1])), axis


def _along_axis(axis: int, sign: float) -> Vector:
    return (sign * (axis == 0) + 0.0, sign * (axis == 1) + 0.0, sign * (axis == 2) + 0.0)


def simple_triangle(draw: Draw) -> Inputs:
    t, axis = _flat_triangle(draw)
    direction = _along_axis(axis, draw.sign())
    return case(t, Ray(add(t.at(0.25, 0.375), direction, -float(draw.whole(1, 6))), direction), draw)


def in_plane(draw: Draw) -> Inputs:
    """Along the plane, in it or beside it: numbers for which n . d is exactly 0."""
    t, axis = _flat_triangle(draw)
    along = _along_axis((axis + 1) % 3, draw.sign())
    beside = _along_axis(axis, draw.whole(-1, 1) / 2)
    return case(t, Ray(add(add(t.at(0.25, 0.375), along, -8.0), beside), along), draw)


def on_triangle(draw: Draw) -> Inputs:
    t, axis = _flat_triangle(draw)
    return case(t, Ray(t.at(0.25, 0.375), _along_axis(axis, draw.sign())), draw)


def on_edge(draw: Draw) -> Inputs:
    """Exactly through an edge, and not near a corner. Every term is exact, so all methods must agree: a hit."""
    t, axis = _flat_triangle(draw, legs=(1, 2, 4))
    share = draw.whole(1, 3) / 4
    corners = [(0.0, share), (share, 0.0), (share, 1 - share)]
    direction = _along_axis(axis, draw.sign())
    point = t.at(*corners[draw.whole(0, 2)])
    return case(t, Ray(add(point, direction, -float(draw.whole(1, 6))), direction), draw)


def signed_zeros(draw: Draw) -> Inputs:
    """Straight at it or past it, along an axis; the zeros of the direction have either sign."""
    t, axis = _flat_triangle(draw)
    u, v = ((0.25, 0.375), (0.5, 0.25), (0.75, 0.75), (-0.25, 0.5))[draw.whole(0, 3)]
    sign, distance = draw.sign(), float(draw.whole(1, 6))
    direction = with_zeros(draw, axis, sign)
    return case(t, Ray(add(t.at(u, v), direction, -distance), direction), draw)
