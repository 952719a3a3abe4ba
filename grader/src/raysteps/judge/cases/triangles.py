"""Cases of step 02: rays and triangles; those with exact numbers have a module of their own."""

from raysteps.common.vectors import Vector, add, cross, length, minus, times, unit
from raysteps.judge.functions import Function, Group
from raysteps.judge.hits import HIT
from raysteps.judge.protocol import Inputs, Ray, rounded
from raysteps.judge.random_source import RandomSource, with_zeros
from raysteps.judge.surfaces import Triangle

# Cases of step 02: rays that are aimed at a triangle or beside it.

SIZES = (0.002, 1000.0)  # of a triangle's longest edge and of a sphere's radius
NEAREST = 3e-4  # a hit nearer than 1e-4 may be left out
_NEAR = 9e-4  # a threshold of 1e-3, which many programs have here, leaves out what is nearer
_STEEP = 0.2  # least cosine between ray and normal: seen edge-on, rounding may decide


def case(t: Triangle, ray: Ray, draw: RandomSource) -> Inputs:
    return {"triangle": Triangle(t.a, t.b, t.c, draw.fill()), "ray": ray}


def normal_of(t: Triangle) -> Vector:
    return unit(cross(minus(t.b, t.a), minus(t.c, t.a)))


def inside(draw: RandomSource, t: Triangle) -> Vector:
    """Well within the edges."""
    u = draw.real(0.08, 0.8)
    return t.at(u, draw.real(0.08, 0.92 - u))


def beside(draw: RandomSource, t: Triangle) -> Vector:
    """A little outside of one edge, between its ends."""
    out, along = -draw.real(0.05, 0.3), draw.real(0.1, 0.9)
    corners = [(out, along), (along, out), (along - out, 1 - along)]
    return t.at(*corners[draw.whole(0, 2)])


def towards(draw: RandomSource, t: Triangle, point: Vector, side: float, distance: float) -> Ray:
    """Comes from the triangle's front (side 1) or back (side -1)."""
    direction = times(-1.0, draw.above(times(side, normal_of(t)), _STEEP))
    return Ray(rounded(add(point, direction, -distance)), rounded(direction))


# Cases of step 02: triangles in planes of the axes, where all numbers are exact.


def _flat_triangle(draw: RandomSource, legs: tuple[int, ...] = (1, 2, 3, 4)) -> tuple[Triangle, int]:
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


def simple_triangle(draw: RandomSource) -> Inputs:
    t, axis = _flat_triangle(draw)
    direction = _along_axis(axis, draw.sign())
    return case(t, Ray(add(t.at(0.25, 0.375), direction, -float(draw.whole(1, 6))), direction), draw)


def in_plane(draw: RandomSource) -> Inputs:
    """Along the plane, in it or beside it: numbers for which n . d is exactly 0."""
    t, axis = _flat_triangle(draw)
    along = _along_axis((axis + 1) % 3, draw.sign())
    beside = _along_axis(axis, draw.whole(-1, 1) / 2)
    return case(t, Ray(add(add(t.at(0.25, 0.375), along, -8.0), beside), along), draw)


def on_triangle(draw: RandomSource) -> Inputs:
    t, axis = _flat_triangle(draw)
    return case(t, Ray(t.at(0.25, 0.375), _along_axis(axis, draw.sign())), draw)


def on_edge(draw: RandomSource) -> Inputs:
    """Exactly through an edge, and not near a corner. Every term is exact, so all methods must agree: a hit."""
    t, axis = _flat_triangle(draw, legs=(1, 2, 4))
    share = draw.whole(1, 3) / 4
    corners = [(0.0, share), (share, 0.0), (share, 1 - share)]
    direction = _along_axis(axis, draw.sign())
    point = t.at(*corners[draw.whole(0, 2)])
    return case(t, Ray(add(point, direction, -float(draw.whole(1, 6))), direction), draw)


def signed_zeros(draw: RandomSource) -> Inputs:
    """Straight at it or past it, along an axis; the zeros of the direction have either sign."""
    t, axis = _flat_triangle(draw)
    u, v = ((0.25, 0.375), (0.5, 0.25), (0.75, 0.75), (-0.25, 0.5))[draw.whole(0, 3)]
    sign, distance = draw.sign(), float(draw.whole(1, 6))
    direction = with_zeros(draw, axis, sign)
    return case(t, Ray(add(t.at(u, v), direction, -distance), direction), draw)


def _at_edge(draw: RandomSource, t: Triangle) -> Vector:
    """Within an edge or beyond it, by a little that float can tell; or so beside a corner."""
    off, along = draw.real(0.005, 0.02) * draw.sign(), draw.real(0.1, 0.8)
    points = [(off, along), (along, off), (along, 1 - along - off), (-abs(off), -abs(off)), (abs(off), abs(off))]
    return t.at(*points[draw.whole(0, 4)])


def _any_triangle(draw: RandomSource) -> Inputs:
    t = draw.triangle()
    point = inside(draw, t) if draw.chance(0.7) else beside(draw, t)
    return case(t, towards(draw, t, point, draw.sign(), draw.real(1, 10)), draw)


def _from_side(draw: RandomSource, side: float) -> Inputs:
    t = draw.triangle()
    return case(t, towards(draw, t, inside(draw, t), side, draw.real(1, 10)), draw)


def _beside_edge(draw: RandomSource) -> Inputs:
    t = draw.triangle()
    return case(t, towards(draw, t, beside(draw, t), draw.sign(), draw.real(1, 10)), draw)


def _triangle_behind(draw: RandomSource) -> Inputs:
    t = draw.triangle()
    return case(t, towards(draw, t, inside(draw, t), draw.sign(), -draw.real(0.5, 10)), draw)


def _small_triangle(draw: RandomSource) -> Inputs:
    """Its area is tiny, and nothing else about it is: who compares it with a small number loses it."""
    t = _of_size(draw, draw.logarithmic(SIZES[0], 10 * SIZES[0]), draw.point(1))
    return case(t, towards(draw, t, inside(draw, t), draw.sign(), draw.real(0.5, 1)), draw)


def _of_size(draw: RandomSource, size: float, place: Vector) -> Triangle:
    """No sliver; its longest edge is so long, and never shorter by rounding."""
    shape = draw.triangle(1.0)
    longest = max(length(minus(*pair)) for pair in ((shape.a, shape.b), (shape.b, shape.c), (shape.c, shape.a)))
    a, b, c = (rounded(add(place, corner, 1.01 * size / longest)) for corner in (shape.a, shape.b, shape.c))
    return Triangle(a, b, c)


def _close_to_edge(draw: RandomSource) -> Inputs:
    t = draw.triangle()
    return case(t, towards(draw, t, _at_edge(draw, t), draw.sign(), draw.real(1, 5)), draw)


def _sliver(draw: RandomSource) -> Inputs:
    """Long and thin, hit well within or missed beside its long edge."""
    a, along = draw.point(2), draw.direction()
    side = unit(cross(along, draw.across(along)))
    tip = add(add(a, along, draw.real(8, 20)), side, draw.real(-0.2, 0.2))
    t = Triangle(a, rounded(tip), rounded(add(a, side, draw.real(0.1, 0.3))))
    u = draw.real(0.2, 0.7)
    v = draw.real(0.1, 0.9 - u) if draw.chance(0.7) else -draw.real(0.2, 1)
    return case(t, towards(draw, t, t.at(u, v), draw.sign(), draw.real(1, 5)), draw)


def _grazing(draw: RandomSource) -> Inputs:
    t, side = draw.triangle(), draw.sign()
    direction = times(-1.0, draw.above(times(side, normal_of(t)), 0.02, 0.08))
    return case(t, Ray(rounded(add(inside(draw, t), direction, -draw.real(1, 5))), rounded(direction)), draw)


def close_by(draw: RandomSource) -> float:
    """How far before a surface, or behind it: half of them so near that a threshold leaves them out."""
    return draw.logarithmic(NEAREST, _NEAR if draw.chance(0.5) else 0.1) * draw.sign()


def _close_origin(draw: RandomSource) -> Inputs:
    """Just before the triangle, or just behind it."""
    t = draw.triangle(2.0)
    return case(t, towards(draw, t, inside(draw, t), draw.sign(), close_by(draw)), draw)


def _any_size(draw: RandomSource) -> Inputs:
    """The distance goes with the size, and up to 10 000."""
    size = draw.logarithmic(10 * SIZES[0], SIZES[1])
    t = _of_size(draw, size, draw.point(min(size, 1.0)))
    direction = times(-1.0, draw.above(times(draw.sign(), normal_of(t)), 0.5))
    distance = size * draw.logarithmic(0.1, 10)
    return case(t, Ray(rounded(add(inside(draw, t), direction, -distance)), rounded(direction)), draw)


TRIANGLE_INTERSECT = Function(
    "Triangle::intersect",
    HIT,
    (
        Group("hit or missed from any side", _any_triangle),
        Group("simple numbers", simple_triangle, exact=True),
        Group("seen from the front", lambda d: _from_side(d, 1.0)),
        Group("seen from behind", lambda d: _from_side(d, -1.0)),
        Group("small triangles", _small_triangle),
        Group("at a grazing angle", _grazing),
        Group("of any size", _any_size),
        Group("long and thin", _sliver),
        Group("close to an edge", _close_to_edge),
        Group("origin close to the triangle", _close_origin),
        Group("along an axis, with zeros of either sign", signed_zeros, exact=True),
        Group("on an edge", on_edge, exact=True),
        Group("beside an edge", _beside_edge),
        Group("behind the origin", _triangle_behind),
        Group("along the plane", in_plane, exact=True),
        Group("origin on the triangle", on_triangle, exact=True),
    ),
)
