"""Cases of step 02: rays and triangles; those with exact numbers have a module of their own."""

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.triangle_aims import beside, case, inside, normal_of, towards
from raysteps.judge.generators.triangle_exact import in_plane, on_edge, on_triangle, signed_zeros, simple_triangle
from raysteps.judge.hits import HIT
from raysteps.judge.numbers import Vector, add, cross, rounded, times, unit
from raysteps.judge.surfaces import Triangle
from raysteps.judge.values import Inputs, Ray


def _at_edge(draw: Draw, t: Triangle) -> Vector:
    """Within an edge or beyond it, by a little that float can tell; or so beside a corner."""
    off, along = draw.real(0.005, 0.02) * draw.sign(), draw.real(0.1, 0.8)
    points = [(off, along), (along, off), (along, 1 - along - off), (-abs(off), -abs(off)), (abs(off), abs(off))]
    return t.at(*points[draw.whole(0, 4)])


def _any_triangle(draw: Draw) -> Inputs:
    t = draw.triangle()
    point = inside(draw, t) if draw.chance(0.7) else beside(draw, t)
    return case(t, towards(draw, t, point, draw.sign(), draw.real(1, 10)), draw)


def _from_side(draw: Draw, side: float) -> Inputs:
    t = draw.triangle()
    return case(t, towards(draw, t, inside(draw, t), side, draw.real(1, 10)), draw)


def _beside_edge(draw: Draw) -> Inputs:
    t = draw.triangle()
    return case(t, towards(draw, t, beside(draw, t), draw.sign(), draw.real(1, 10)), draw)


def _triangle_behind(draw: Draw) -> Inputs:
    t = draw.triangle()
    return case(t, towards(draw, t, inside(draw, t), draw.sign(), -draw.real(0.5, 10)), draw)


def _small_triangle(draw: Draw) -> Inputs:
    """Its area is tiny, and nothing else about it is: who compares it with a small number loses it."""
    t, place = draw.triangle(), draw.point(3)
    a, b, c = (rounded(add(place, corner, 0.005)) for corner in (t.a, t.b, t.c))
    t = Triangle(a, b, c)
    return case(t, towards(draw, t, inside(draw, t), draw.sign(), draw.real(1, 4)), draw)


def _close_to_edge(draw: Draw) -> Inputs:
    t = draw.triangle()
    return case(t, towards(draw, t, _at_edge(draw, t), draw.sign(), draw.real(1, 5)), draw)


def _sliver(draw: Draw) -> Inputs:
    """Long and thin, hit well within or missed beside its long edge."""
    a, along = draw.point(2), draw.direction()
    side = unit(cross(along, draw.across(along)))
    tip = add(add(a, along, draw.real(8, 20)), side, draw.real(-0.2, 0.2))
    t = Triangle(a, rounded(tip), rounded(add(a, side, draw.real(0.1, 0.3))))
    u = draw.real(0.2, 0.7)
    v = draw.real(0.1, 0.9 - u) if draw.chance(0.7) else -draw.real(0.2, 1)
    return case(t, towards(draw, t, t.at(u, v), draw.sign(), draw.real(1, 5)), draw)


def _grazing(draw: Draw) -> Inputs:
    t, side = draw.triangle(), draw.sign()
    direction = times(-1.0, draw.above(times(side, normal_of(t)), 0.02, 0.08))
    return case(t, Ray(rounded(add(inside(draw, t), direction, -draw.real(1, 5))), rounded(direction)), draw)


def _close_origin(draw: Draw) -> Inputs:
    """Just before the triangle, or just behind it."""
    t = draw.triangle(2.0)
    distance = draw.real(0.02, 0.08) * draw.sign()
    return case(t, towards(draw, t, inside(draw, t), draw.sign(), distance), draw)


def _tiny_or_huge(draw: Draw) -> Inputs:
    shape, tiny = draw.triangle(4.0), draw.chance(0.5)
    factor, place = (draw.real(0.006, 0.02), draw.point(0.5)) if tiny else (draw.real(50, 500), draw.point(20))
    a, b, c = (rounded(add(place, corner, factor)) for corner in (shape.a, shape.b, shape.c))
    t = Triangle(a, b, c)
    direction = times(-1.0, draw.above(times(draw.sign(), normal_of(t)), 0.5))
    distance = draw.real(0.5, 2) if tiny else draw.real(10, 500)
    return case(t, Ray(rounded(add(inside(draw, t), direction, -distance)), rounded(direction)), draw)


TRIANGLE_INTERSECT = Function(
    "Triangle::intersect",
    HIT,
    (
        Group("hit or missed from any side", _any_triangle, telling=False),
        Group("simple numbers", simple_triangle, exact=True),
        Group("seen from the front", lambda d: _from_side(d, 1.0)),
        Group("seen from behind", lambda d: _from_side(d, -1.0)),
        Group("small triangles", _small_triangle),
        Group("at a grazing angle", _grazing),
        Group("tiny and huge", _tiny_or_huge),
        Group("long and thin", _sliver, telling=False),
        Group("close to an edge", _close_to_edge, telling=False),
        Group("origin close to the triangle", _close_origin, telling=False),
        Group("along an axis, with zeros of either sign", signed_zeros, telling=False, exact=True),
        Group("on an edge", on_edge, exact=True),
        Group("beside an edge", _beside_edge, telling=False),
        Group("behind the origin", _triangle_behind, telling=False),
        Group("along the plane", in_plane, telling=False, exact=True),
        Group("origin on the triangle", on_triangle, telling=False, exact=True),
    ),
)
