"""Cases of step 02: rays and triangles, rays and spheres, and the closest of several hits."""

from raysteps.common.vectors import Vector, add, cross, length, minus, times, unit
from raysteps.judge.functions import Function, Group
from raysteps.judge.hits import FOUND, HIT
from raysteps.judge.protocol import Inputs, Ray, rounded
from raysteps.judge.random_source import RandomSource, circle, next_axis, with_zeros
from raysteps.judge.surfaces import ScriptedSurface, Sphere, Surfaces, Triangle

# Rays that are aimed at a triangle or beside it.

_SIZES = (0.002, 1000.0)  # of a triangle's longest edge and of a sphere's radius
_NEAREST = 3e-4  # a hit nearer than 1e-4 may be left out
_NEAR = 9e-4  # a threshold of 1e-3, which many programs have here, leaves out what is nearer
_STEEP = 0.2  # least cosine between ray and normal: seen edge-on, rounding may decide
_SLACK = (2e-4, 8e-4)  # how far beside an edge, as a share of the triangle: so little that a slack of 0.001 hides it
_FLAT = (1.5e-4, 8e-4)  # cosine between ray and normal that who compares it with 0.001 takes for 0


def _triangle_case(t: Triangle, ray: Ray, draw: RandomSource) -> Inputs:
    return {"triangle": Triangle(t.a, t.b, t.c, draw.fill()), "ray": ray}


def _normal_of(t: Triangle) -> Vector:
    return unit(cross(minus(t.b, t.a), minus(t.c, t.a)))


def _inside(draw: RandomSource, t: Triangle) -> Vector:
    """Well within the edges."""
    u = draw.real(0.08, 0.8)
    return t.at(u, draw.real(0.08, 0.92 - u))


def _beside(draw: RandomSource, t: Triangle) -> Vector:
    """A little outside of one edge, between its ends."""
    out, along = -draw.real(0.05, 0.3), draw.real(0.1, 0.9)
    corners = [(out, along), (along, out), (along - out, 1 - along)]
    return t.at(*corners[draw.whole(0, 2)])


def _inside_or_beside(draw: RandomSource, t: Triangle) -> Vector:
    return _inside(draw, t) if draw.chance(0.7) else _beside(draw, t)


def _towards(draw: RandomSource, t: Triangle, point: Vector, side: float, distance: float) -> Ray:
    """Comes from the triangle's front (side 1) or back (side -1)."""
    direction = times(-1.0, draw.above(times(side, _normal_of(t)), _STEEP))
    return Ray(rounded(add(point, direction, -distance)), rounded(direction))


# Triangles in planes of the axes, where all numbers are exact.


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


def _simple_triangle(draw: RandomSource) -> Inputs:
    t, axis = _flat_triangle(draw)
    direction = _along_axis(axis, draw.sign())
    return _triangle_case(t, Ray(add(t.at(0.25, 0.375), direction, -float(draw.whole(1, 6))), direction), draw)


def _in_plane(draw: RandomSource) -> Inputs:
    """Along the plane, in it or beside it: numbers for which n . d is exactly 0."""
    t, axis = _flat_triangle(draw)
    along = _along_axis((axis + 1) % 3, draw.sign())
    beside = _along_axis(axis, draw.whole(-1, 1) / 2)
    return _triangle_case(t, Ray(add(add(t.at(0.25, 0.375), along, -8.0), beside), along), draw)


def _on_triangle(draw: RandomSource) -> Inputs:
    t, axis = _flat_triangle(draw)
    return _triangle_case(t, Ray(t.at(0.25, 0.375), _along_axis(axis, draw.sign())), draw)


def _on_edge(draw: RandomSource) -> Inputs:
    """Exactly through an edge, and not near a corner. Every term is exact, so all methods must agree: a hit."""
    t, axis = _flat_triangle(draw, legs=(1, 2, 4))
    share = draw.whole(1, 3) / 4
    corners = [(0.0, share), (share, 0.0), (share, 1 - share)]
    direction = _along_axis(axis, draw.sign())
    point = t.at(*corners[draw.whole(0, 2)])
    return _triangle_case(t, Ray(add(point, direction, -float(draw.whole(1, 6))), direction), draw)


def _triangle_signed_zeros(draw: RandomSource) -> Inputs:
    """Straight at it or past it, along an axis; the zeros of the direction have either sign."""
    t, axis = _flat_triangle(draw)
    u, v = ((0.25, 0.375), (0.5, 0.25), (0.75, 0.75), (-0.25, 0.5))[draw.whole(0, 3)]
    sign, distance = draw.sign(), float(draw.whole(1, 6))
    direction = with_zeros(draw, axis, sign)
    return _triangle_case(t, Ray(add(t.at(u, v), direction, -distance), direction), draw)


def _at_edge(draw: RandomSource, t: Triangle, low: float, high: float) -> Vector:
    """Within an edge or beyond it, by a little that float can tell; or so beside a corner."""
    off, along = draw.real(low, high) * draw.sign(), draw.real(0.1, 0.8)
    points = [(off, along), (along, off), (along, 1 - along - off), (-abs(off), -abs(off)), (abs(off), abs(off))]
    return t.at(*points[draw.whole(0, 4)])


def _any_triangle(draw: RandomSource) -> Inputs:
    t = draw.triangle()
    return _triangle_case(t, _towards(draw, t, _inside_or_beside(draw, t), draw.sign(), draw.real(1, 10)), draw)


def _from_side(draw: RandomSource, side: float) -> Inputs:
    t = draw.triangle()
    return _triangle_case(t, _towards(draw, t, _inside(draw, t), side, draw.real(1, 10)), draw)


def _beside_edge(draw: RandomSource) -> Inputs:
    t = draw.triangle()
    return _triangle_case(t, _towards(draw, t, _beside(draw, t), draw.sign(), draw.real(1, 10)), draw)


def _triangle_behind(draw: RandomSource) -> Inputs:
    t = draw.triangle()
    return _triangle_case(t, _towards(draw, t, _inside(draw, t), draw.sign(), -draw.real(0.5, 10)), draw)


def _small_triangle(draw: RandomSource) -> Inputs:
    """Its area is tiny, and nothing else about it is: who compares it with a small number loses it, or hits what is
    beside it."""
    t = _of_size(draw, draw.logarithmic(_SIZES[0], 10 * _SIZES[0]), draw.point(1))
    return _triangle_case(t, _towards(draw, t, _inside_or_beside(draw, t), draw.sign(), draw.real(0.5, 1)), draw)


def _of_size(draw: RandomSource, size: float, place: Vector) -> Triangle:
    """No sliver; its longest edge is so long, and never shorter by rounding."""
    shape = draw.triangle(1.0)
    longest = max(length(minus(*pair)) for pair in ((shape.a, shape.b), (shape.b, shape.c), (shape.c, shape.a)))
    a, b, c = (rounded(add(place, corner, 1.01 * size / longest)) for corner in (shape.a, shape.b, shape.c))
    return Triangle(a, b, c)


def _close_to_edge(draw: RandomSource) -> Inputs:
    t = draw.triangle()
    return _triangle_case(t, _towards(draw, t, _at_edge(draw, t, 0.005, 0.02), draw.sign(), draw.real(1, 5)), draw)


def _very_close_to_edge(draw: RandomSource) -> Inputs:
    """Seen from near and not at a slant, so that rounding is far less than what is beside the edge."""
    t = draw.triangle(2.0)
    direction = times(-1.0, draw.above(times(draw.sign(), _normal_of(t)), 0.6))
    target = _at_edge(draw, t, *_SLACK)
    return _triangle_case(t, Ray(rounded(add(target, direction, -draw.real(1, 2))), rounded(direction)), draw)


def _very_flat(draw: RandomSource) -> Inputs:
    """The plane goes through the centre of the world, along two axes: no difference of two numbers loses digits."""
    axis, legs = draw.whole(0, 2), (draw.real(1, 4), draw.real(1, 4))

    def at(of_first: float, of_second: float, height: float = 0.0) -> Vector:
        parts = [0.0, 0.0, 0.0]
        parts[axis], parts[(axis + 1) % 3], parts[(axis + 2) % 3] = height, of_first, of_second
        return parts[0], parts[1], parts[2]

    corner, signs = (draw.real(-1, 1), draw.real(-1, 1)), (draw.sign(), draw.sign())
    a = at(*corner)
    t = Triangle(a, rounded(add(a, at(signs[0] * legs[0], 0.0))), rounded(add(a, at(0.0, signs[1] * legs[1]))))
    (across, along), flat = circle(draw.fine(0, 1)), draw.sign() * draw.logarithmic(*_FLAT)
    direction = rounded(unit(at(across, along, flat)))
    return _triangle_case(t, Ray(rounded(add(_inside(draw, t), direction, -draw.real(1, 4))), direction), draw)


def _sliver(draw: RandomSource) -> Inputs:
    """Long and thin, hit well within or missed beside its long edge."""
    a, along = draw.point(2), draw.direction()
    side = unit(cross(along, draw.across(along)))
    tip = add(add(a, along, draw.real(8, 20)), side, draw.real(-0.2, 0.2))
    t = Triangle(a, rounded(tip), rounded(add(a, side, draw.real(0.1, 0.3))))
    u = draw.real(0.2, 0.7)
    v = draw.real(0.1, 0.9 - u) if draw.chance(0.7) else -draw.real(0.2, 1)
    return _triangle_case(t, _towards(draw, t, t.at(u, v), draw.sign(), draw.real(1, 5)), draw)


def _grazing(draw: RandomSource) -> Inputs:
    t, side = draw.triangle(), draw.sign()
    direction = times(-1.0, draw.above(times(side, _normal_of(t)), 0.02, 0.08))
    return _triangle_case(t, Ray(rounded(add(_inside(draw, t), direction, -draw.real(1, 5))), rounded(direction)), draw)


def _close_by(draw: RandomSource) -> float:
    """How far before a surface, or behind it: half of them so near that a threshold leaves them out."""
    return draw.logarithmic(_NEAREST, _NEAR if draw.chance(0.5) else 0.1) * draw.sign()


def _close_to_triangle(draw: RandomSource) -> Inputs:
    """Just before the triangle, or just behind it."""
    t = draw.triangle(2.0)
    return _triangle_case(t, _towards(draw, t, _inside(draw, t), draw.sign(), _close_by(draw)), draw)


def _triangle_of_any_size(draw: RandomSource) -> Inputs:
    """The distance goes with the size, and up to 10 000: so it is for some of them whatever is drawn."""
    size = draw.logarithmic(0.3 * _SIZES[1] if draw.chance(0.2) else 10 * _SIZES[0], _SIZES[1])
    t = _of_size(draw, size, draw.point(min(size, 1.0)))
    direction = times(-1.0, draw.above(times(draw.sign(), _normal_of(t)), 0.5))
    distance = size * draw.logarithmic(3 if size > 0.3 * _SIZES[1] else 0.1, 10)
    target = _inside_or_beside(draw, t)
    return _triangle_case(t, Ray(rounded(add(target, direction, -distance)), rounded(direction)), draw)


TRIANGLE_INTERSECT = Function(
    "Triangle::intersect",
    HIT,
    (
        Group("hit or missed from any side", _any_triangle),
        Group("simple numbers", _simple_triangle, exact=True),
        Group("seen from the front", lambda d: _from_side(d, 1.0)),
        Group("seen from behind", lambda d: _from_side(d, -1.0)),
        Group("small triangles", _small_triangle),
        Group("at a grazing angle", _grazing),
        Group("at a very flat angle", _very_flat),
        Group("of any size", _triangle_of_any_size),
        Group("long and thin", _sliver),
        Group("close to an edge", _close_to_edge),
        Group("very close to an edge", _very_close_to_edge),
        Group("origin close to the triangle", _close_to_triangle),
        Group("along an axis, with zeros of either sign", _triangle_signed_zeros, exact=True),
        Group("on an edge", _on_edge, exact=True),
        Group("beside an edge", _beside_edge),
        Group("behind the origin", _triangle_behind),
        Group("along the plane", _in_plane, exact=True),
        Group("origin on the triangle", _on_triangle, exact=True),
    ),
)


# Rays and spheres.


def _sphere_case(s: Sphere, ray: Ray, draw: RandomSource) -> Inputs:
    return {"sphere": Sphere(s.center, s.radius, draw.fill()), "ray": ray}


def _at_sphere(draw: RandomSource, s: Sphere, low: float, high: float, distance: float) -> Ray:
    """Passes the centre at low to high radii; the origin is that far from there."""
    direction = draw.direction()
    side = unit(cross(direction, draw.across(direction)))
    passed = add(s.center, side, s.radius * draw.real(low, high))
    return Ray(rounded(add(passed, direction, -distance)), direction)


def _any_sphere(draw: RandomSource) -> Inputs:
    s = draw.sphere()
    low, high = (0.0, 0.9) if draw.chance(0.7) else (1.1, 2.0)
    return _sphere_case(s, _at_sphere(draw, s, low, high, s.radius + draw.real(1, 10)), draw)


def _inside_sphere(draw: RandomSource) -> Inputs:
    s = draw.sphere(high=20.0)
    origin = rounded(add(s.center, draw.direction(), s.radius * draw.real(0.0, 0.85)))
    return _sphere_case(s, Ray(origin, draw.direction()), draw)


def _sphere_behind(draw: RandomSource) -> Inputs:
    s = draw.sphere()
    return _sphere_case(s, _at_sphere(draw, s, 0.0, 0.9, -(s.radius + draw.real(0.5, 10))), draw)


def _beside_sphere(draw: RandomSource) -> Inputs:
    s = draw.sphere()
    return _sphere_case(s, _at_sphere(draw, s, 1.05, 3.0, s.radius + draw.real(1, 10)), draw)


def _simple_sphere(draw: RandomSource) -> Inputs:
    """At the centre of the world or at simple numbers; the ray goes through the centre or forms a 3-4-5 triangle."""
    center = (0.0, 0.0, 0.0) if draw.chance(0.5) else draw.simple_point(4)
    direction = draw.axis()
    start = add(center, direction, -float(draw.whole(6, 12)))
    if draw.chance(0.5):
        return _sphere_case(Sphere(center, float(draw.whole(1, 5))), Ray(start, direction), draw)
    beside = next_axis(direction)
    return _sphere_case(Sphere(center, 5.0), Ray(add(start, beside, 3.0), direction), draw)


def _from_center(draw: RandomSource) -> Inputs:
    s = Sphere(draw.simple_point(4), draw.eighths(1, 6))
    return _sphere_case(s, Ray(s.center, draw.direction()), draw)


def _far_sphere(draw: RandomSource) -> Inputs:
    s = draw.sphere(low=0.6, high=1.2)
    return _sphere_case(s, _at_sphere(draw, s, 0.0, 0.7, draw.real(15, 25)), draw)


def _nearly_tangent(draw: RandomSource) -> Inputs:
    s = draw.sphere(reach=3.0, low=1.0)
    low, high = (0.95, 0.985) if draw.chance(0.5) else (1.015, 1.05)
    return _sphere_case(s, _at_sphere(draw, s, low, high, s.radius + draw.real(0.5, 3)), draw)


_WHOLE = ((3.0, 4.0), (4.0, 3.0), (6.0, 8.0), (8.0, 6.0), (5.0, 12.0), (12.0, 5.0))  # legs of right triangles


def _exactly_tangent(draw: RandomSource) -> Inputs:
    """The ray touches the sphere in one point. All numbers are small and whole, the distance of the centre from the
    start among them, so that every method sees a 0."""
    direction = draw.axis()
    beside = times(draw.sign(), next_axis(direction))
    radius, way = _WHOLE[draw.whole(0, len(_WHOLE) - 1)]
    s = Sphere(draw.simple_point(4), radius)
    start = add(add(s.center, direction, -way), beside, radius)
    return _sphere_case(s, Ray(start, direction), draw)


def _close_origin(draw: RandomSource) -> Inputs:
    """Just outside the sphere or just inside, on the way in or out."""
    s = draw.sphere(reach=2.0, low=1.0)
    outward, off = draw.direction(), _close_by(draw)
    direction = draw.above(times(draw.sign(), outward), 0.4)
    return _sphere_case(s, Ray(rounded(add(s.center, outward, s.radius + off)), direction), draw)


def _on_sphere(draw: RandomSource) -> Inputs:
    """One of the two distances is exactly 0, even for a method that divides by the radius."""
    outward = draw.axis()
    s = Sphere(draw.simple_point(4), float(2 ** draw.whole(-1, 2)))
    return _sphere_case(s, Ray(add(s.center, outward, s.radius), times(draw.sign(), outward)), draw)


def _any_size(draw: RandomSource) -> Inputs:
    """The distance is up to 30 times the radius: farther away a method that is right on paper loses its digits."""
    radius = draw.logarithmic(*_SIZES)
    s = Sphere(draw.point(min(1.0, 300 * radius) if radius < 1 else 0.1 * radius), radius)
    return _sphere_case(s, _at_sphere(draw, s, 0.0, 0.7, radius * (1 + draw.logarithmic(0.1, 30))), draw)


def _signed_zeros(draw: RandomSource) -> Inputs:
    """Along an axis; the zeros of the direction have either sign."""
    s, axis, sign = Sphere(draw.simple_point(4), float(draw.whole(1, 5))), draw.whole(0, 2), draw.sign()
    direction = with_zeros(draw, axis, sign)
    return _sphere_case(s, Ray(add(s.center, direction, -float(draw.whole(6, 12))), direction), draw)


SPHERE_INTERSECT = Function(
    "Sphere::intersect",
    HIT,
    (
        Group("hit or missed from outside", _any_sphere),
        Group("simple numbers", _simple_sphere, exact=True),
        Group("origin inside", _inside_sphere),
        Group("origin in the centre", _from_center),
        Group("far away", _far_sphere),
        Group("of any size", _any_size),
        Group("along an axis, with zeros of either sign", _signed_zeros, exact=True),
        Group("nearly tangent", _nearly_tangent),
        Group("exactly tangent", _exactly_tangent, exact=True),
        Group("origin close to the sphere", _close_origin),
        Group("origin on the sphere", _on_sphere, exact=True),
        Group("behind the origin", _sphere_behind),
        Group("passed by", _beside_sphere),
    ),
)


# The closest of several.


def _distances(draw: RandomSource, count: int) -> list[float]:
    """Well apart, in random order."""
    found: list[float] = []
    for _ in range(count):
        apart = draw.until(lambda new: all(abs(new - other) > 0.2 for other in found), lambda: draw.real(0.5, 30))
        found.append(apart)
    return found


def _list(draw: RandomSource, distances: list[float], missed: int) -> Inputs:
    surfaces = [ScriptedSurface(distance) for distance in distances]
    for _ in range(missed):
        surfaces.insert(draw.whole(0, len(surfaces)), ScriptedSurface(None))
    return {"surfaces": Surfaces(tuple(surfaces)), "ray": Ray(draw.point(5), draw.direction())}


def _near_and_far(draw: RandomSource) -> Inputs:
    """Far ones alone, or beside a very near one: a search that starts with a largest distance of its own loses them."""
    far = [draw.real(1e4, 1e5), draw.real(1e6, 1e7)]
    return _list(
        draw, far[draw.whole(0, 1) :] if draw.chance(0.5) else [*far, draw.real(0.001, 0.01)], draw.whole(0, 2)
    )


def _many(draw: RandomSource) -> Inputs:
    return _list(draw, _distances(draw, draw.whole(30, 50)), draw.whole(0, 10))


def _sorted(draw: RandomSource, *, nearest_first: bool) -> Inputs:
    return _list(draw, sorted(_distances(draw, draw.whole(2, 6)), reverse=not nearest_first), 0)


_CLOSEST_HIT = Function(
    "closest_hit",
    FOUND,
    (
        Group("several hits", lambda d: _list(d, _distances(d, d.whole(2, 8)), d.whole(0, 4))),
        Group("a single surface", lambda d: _list(d, _distances(d, 1), 0)),
        Group("the nearest first", lambda d: _sorted(d, nearest_first=True)),
        Group("the nearest last", lambda d: _sorted(d, nearest_first=False)),
        Group("one hit among misses", lambda d: _list(d, _distances(d, 1), d.whole(2, 6))),
        Group("very near and very far", _near_and_far),
        Group("many surfaces", _many),
        Group("all missed", lambda d: _list(d, [], d.whole(1, 5))),
        Group("no surfaces", lambda d: _list(d, [], 0)),
    ),
)

FUNCTIONS = (TRIANGLE_INTERSECT, SPHERE_INTERSECT, _CLOSEST_HIT)
