"""Cases of step 02."""

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.hits import FOUND, HIT
from raysteps.judge.numbers import Vector, add, cross, minus, rounded, times, unit
from raysteps.judge.surfaces import Scripted, Sphere, Surfaces, Triangle
from raysteps.judge.values import Inputs, Ray

_STEEP = 0.2  # least cosine between ray and normal: seen edge-on, rounding may decide


def _inputs(surface: Sphere | Triangle, ray: Ray, draw: Draw) -> Inputs:
    if isinstance(surface, Sphere):
        return {"sphere": Sphere(surface.center, surface.radius, draw.fill()), "ray": ray}
    return {"triangle": Triangle(surface.a, surface.b, surface.c, draw.fill()), "ray": ray}


def _normal(t: Triangle) -> Vector:
    return unit(cross(minus(t.b, t.a), minus(t.c, t.a)))


def _at(t: Triangle, u: float, v: float) -> Vector:
    return add(add(t.a, minus(t.b, t.a), u), minus(t.c, t.a), v)


def _inside(draw: Draw, t: Triangle) -> Vector:
    """Well within the edges."""
    u = draw.real(0.08, 0.8)
    return _at(t, u, draw.real(0.08, 0.92 - u))


def _beside(draw: Draw, t: Triangle) -> Vector:
    """A little outside of one edge, between its ends."""
    out, along = -draw.real(0.05, 0.3), draw.real(0.1, 0.9)
    corners = [(out, along), (along, out), (along - out, 1 - along)]
    return _at(t, *corners[draw.whole(0, 2)])


def _towards(draw: Draw, t: Triangle, point: Vector, side: float, distance: float) -> Ray:
    """Comes from the triangle's front (side 1) or back (side -1)."""
    direction = times(-1.0, draw.above(times(side, _normal(t)), _STEEP))
    return Ray(rounded(add(point, direction, -distance)), rounded(direction))


def _any_triangle(draw: Draw) -> Inputs:
    t = draw.triangle()
    point = _inside(draw, t) if draw.chance(0.7) else _beside(draw, t)
    return _inputs(t, _towards(draw, t, point, draw.sign(), draw.real(1, 10)), draw)


def _from_side(draw: Draw, side: float) -> Inputs:
    t = draw.triangle()
    return _inputs(t, _towards(draw, t, _inside(draw, t), side, draw.real(1, 10)), draw)


def _beside_edge(draw: Draw) -> Inputs:
    t = draw.triangle()
    return _inputs(t, _towards(draw, t, _beside(draw, t), draw.sign(), draw.real(1, 10)), draw)


def _triangle_behind(draw: Draw) -> Inputs:
    t = draw.triangle()
    return _inputs(t, _towards(draw, t, _inside(draw, t), draw.sign(), -draw.real(0.5, 10)), draw)


def _flat_triangle(draw: Draw) -> tuple[Triangle, int]:
    """In a plane of two axes, with a right angle; and the number of the third axis."""
    axis, corner = draw.whole(0, 2), draw.simple_point(4)
    legs = [draw.sign() * draw.whole(1, 4) for _ in range(2)]

    def moved(which: int, by: float) -> Vector:
        moves = [0.0, 0.0, 0.0]
        moves[(axis + which) % 3] = by
        return add(corner, (moves[0], moves[1], moves[2]))

    return Triangle(corner, moved(1, legs[0]), moved(2, legs[1])), axis


def _along_axis(axis: int, sign: float) -> Vector:
    return (sign * (axis == 0) + 0.0, sign * (axis == 1) + 0.0, sign * (axis == 2) + 0.0)


def _simple_triangle(draw: Draw) -> Inputs:
    t, axis = _flat_triangle(draw)
    direction = _along_axis(axis, draw.sign())
    return _inputs(t, Ray(add(_at(t, 0.25, 0.375), direction, -float(draw.whole(1, 6))), direction), draw)


def _in_plane(draw: Draw) -> Inputs:
    """Along the plane, in it or beside it: numbers for which n . d is exactly 0."""
    t, axis = _flat_triangle(draw)
    along = _along_axis((axis + 1) % 3, draw.sign())
    beside = _along_axis(axis, draw.whole(-1, 1) / 2)
    return _inputs(t, Ray(add(add(_at(t, 0.25, 0.375), along, -8.0), beside), along), draw)


def _on_triangle(draw: Draw) -> Inputs:
    t, axis = _flat_triangle(draw)
    return _inputs(t, Ray(_at(t, 0.25, 0.375), _along_axis(axis, draw.sign())), draw)


def _small_triangle(draw: Draw) -> Inputs:
    t, place = draw.triangle(), draw.point(3)
    a, b, c = (rounded(add(place, corner, 0.05)) for corner in (t.a, t.b, t.c))
    t = Triangle(a, b, c)
    return _inputs(t, _towards(draw, t, _inside(draw, t), draw.sign(), draw.real(1, 4)), draw)


def _at_sphere(draw: Draw, s: Sphere, low: float, high: float, distance: float) -> Ray:
    """Passes the centre at low to high radii; the origin is that far from there."""
    direction = draw.direction()
    side = unit(cross(direction, draw.across(direction)))
    passed = add(s.center, side, s.radius * draw.real(low, high))
    return Ray(rounded(add(passed, direction, -distance)), direction)


def _any_sphere(draw: Draw) -> Inputs:
    s = draw.sphere()
    low, high = (0.0, 0.9) if draw.chance(0.7) else (1.1, 2.0)
    return _inputs(s, _at_sphere(draw, s, low, high, s.radius + draw.real(1, 10)), draw)


def _inside_sphere(draw: Draw) -> Inputs:
    s = draw.sphere(high=20.0)
    origin = rounded(add(s.center, draw.direction(), s.radius * draw.real(0.0, 0.85)))
    return _inputs(s, Ray(origin, draw.direction()), draw)


def _sphere_behind(draw: Draw) -> Inputs:
    s = draw.sphere()
    return _inputs(s, _at_sphere(draw, s, 0.0, 0.9, -(s.radius + draw.real(0.5, 10))), draw)


def _beside_sphere(draw: Draw) -> Inputs:
    s = draw.sphere()
    return _inputs(s, _at_sphere(draw, s, 1.05, 3.0, s.radius + draw.real(1, 10)), draw)


def _simple_sphere(draw: Draw) -> Inputs:
    """At the centre of the world or at simple numbers; the ray goes through the centre or forms a 3-4-5 triangle."""
    center = (0.0, 0.0, 0.0) if draw.chance(0.5) else draw.simple_point(4)
    direction = draw.axis()
    start = add(center, direction, -float(draw.whole(6, 12)))
    if draw.chance(0.5):
        return _inputs(Sphere(center, float(draw.whole(1, 5))), Ray(start, direction), draw)
    beside = (direction[1], direction[2], direction[0])
    return _inputs(Sphere(center, 5.0), Ray(add(start, beside, 3.0), direction), draw)


def _from_center(draw: Draw) -> Inputs:
    s = Sphere(draw.simple_point(4), draw.eighths(1, 6))
    return _inputs(s, Ray(s.center, draw.direction()), draw)


def _far_sphere(draw: Draw) -> Inputs:
    s = draw.sphere(low=0.6, high=1.2)
    return _inputs(s, _at_sphere(draw, s, 0.0, 0.7, draw.real(15, 25)), draw)


def _distances(draw: Draw, count: int) -> list[float]:
    """Well apart, in random order."""
    found: list[float] = []
    while len(found) < count:
        distance = draw.real(0.5, 30)
        if all(abs(distance - other) > 0.2 for other in found):
            found.append(distance)
    return found


def _list(draw: Draw, distances: list[float], missed: int) -> Inputs:
    surfaces = [Scripted(distance) for distance in distances]
    for _ in range(missed):
        surfaces.insert(draw.whole(0, len(surfaces)), Scripted(None))
    return {"surfaces": Surfaces(tuple(surfaces)), "ray": Ray(draw.point(5), draw.direction())}


def _sorted(draw: Draw, *, nearest_first: bool) -> Inputs:
    return _list(draw, sorted(_distances(draw, draw.whole(2, 6)), reverse=not nearest_first), 0)


FUNCTIONS = (
    Function(
        "Triangle::intersect",
        HIT,
        (
            Group("hit or missed from any side", _any_triangle),
            Group("simple numbers", _simple_triangle),
            Group("seen from the front", lambda d: _from_side(d, 1.0)),
            Group("seen from behind", lambda d: _from_side(d, -1.0)),
            Group("small triangles", _small_triangle),
            Group("beside an edge", _beside_edge, telling=False),
            Group("behind the origin", _triangle_behind, telling=False),
            Group("along the plane", _in_plane, telling=False),
            Group("origin on the triangle", _on_triangle, telling=False),
        ),
    ),
    Function(
        "Sphere::intersect",
        HIT,
        (
            Group("hit or missed from outside", _any_sphere),
            Group("simple numbers", _simple_sphere),
            Group("origin inside", _inside_sphere),
            Group("origin in the centre", _from_center),
            Group("far away", _far_sphere),
            Group("behind the origin", _sphere_behind, telling=False),
            Group("passed by", _beside_sphere, telling=False),
        ),
    ),
    Function(
        "closest_hit",
        FOUND,
        (
            Group("several hits", lambda d: _list(d, _distances(d, d.whole(2, 8)), d.whole(0, 4))),
            Group("a single surface", lambda d: _list(d, _distances(d, 1), 0)),
            Group("the nearest first", lambda d: _sorted(d, nearest_first=True)),
            Group("the nearest last", lambda d: _sorted(d, nearest_first=False)),
            Group("one hit among misses", lambda d: _list(d, _distances(d, 1), d.whole(2, 6))),
            Group("all missed", lambda d: _list(d, [], d.whole(1, 5)), telling=False),
            Group("no surfaces", lambda d: _list(d, [], 0), telling=False),
        ),
    ),
)
