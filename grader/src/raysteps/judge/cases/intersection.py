"""Cases of step 02: the closest of several hits; triangles and spheres have modules of their own."""

from raysteps.common.vectors import add, cross, times, unit
from raysteps.judge.cases.triangles import SIZES, TRIANGLE_INTERSECT, close_by
from raysteps.judge.functions import Function, Group
from raysteps.judge.hits import FOUND, HIT
from raysteps.judge.protocol import Inputs, Ray, rounded
from raysteps.judge.random_source import RandomSource, next_axis, with_zeros
from raysteps.judge.surfaces import Scripted, Sphere, Surfaces

# Cases of step 02: rays and spheres.


def _case(s: Sphere, ray: Ray, draw: RandomSource) -> Inputs:
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
    return _case(s, _at_sphere(draw, s, low, high, s.radius + draw.real(1, 10)), draw)


def _inside_sphere(draw: RandomSource) -> Inputs:
    s = draw.sphere(high=20.0)
    origin = rounded(add(s.center, draw.direction(), s.radius * draw.real(0.0, 0.85)))
    return _case(s, Ray(origin, draw.direction()), draw)


def _sphere_behind(draw: RandomSource) -> Inputs:
    s = draw.sphere()
    return _case(s, _at_sphere(draw, s, 0.0, 0.9, -(s.radius + draw.real(0.5, 10))), draw)


def _beside_sphere(draw: RandomSource) -> Inputs:
    s = draw.sphere()
    return _case(s, _at_sphere(draw, s, 1.05, 3.0, s.radius + draw.real(1, 10)), draw)


def _simple_sphere(draw: RandomSource) -> Inputs:
    """At the centre of the world or at simple numbers; the ray goes through the centre or forms a 3-4-5 triangle."""
    center = (0.0, 0.0, 0.0) if draw.chance(0.5) else draw.simple_point(4)
    direction = draw.axis()
    start = add(center, direction, -float(draw.whole(6, 12)))
    if draw.chance(0.5):
        return _case(Sphere(center, float(draw.whole(1, 5))), Ray(start, direction), draw)
    beside = next_axis(direction)
    return _case(Sphere(center, 5.0), Ray(add(start, beside, 3.0), direction), draw)


def _from_center(draw: RandomSource) -> Inputs:
    s = Sphere(draw.simple_point(4), draw.eighths(1, 6))
    return _case(s, Ray(s.center, draw.direction()), draw)


def _far_sphere(draw: RandomSource) -> Inputs:
    s = draw.sphere(low=0.6, high=1.2)
    return _case(s, _at_sphere(draw, s, 0.0, 0.7, draw.real(15, 25)), draw)


def _nearly_tangent(draw: RandomSource) -> Inputs:
    s = draw.sphere(reach=3.0, low=1.0)
    low, high = (0.95, 0.985) if draw.chance(0.5) else (1.015, 1.05)
    return _case(s, _at_sphere(draw, s, low, high, s.radius + draw.real(0.5, 3)), draw)


def _exactly_tangent(draw: RandomSource) -> Inputs:
    """The ray touches the sphere in one point. All numbers are small and whole, so that every method sees a 0."""
    direction = draw.axis()
    beside = times(draw.sign(), next_axis(direction))
    s = Sphere(draw.simple_point(4), float(draw.whole(1, 4)))
    start = add(add(s.center, direction, -float(draw.whole(5, 9))), beside, s.radius)
    return _case(s, Ray(start, direction), draw)


def _close_origin(draw: RandomSource) -> Inputs:
    """Just outside the sphere or just inside, on the way in or out."""
    s = draw.sphere(reach=2.0, low=1.0)
    outward, off = draw.direction(), close_by(draw)
    direction = draw.above(times(draw.sign(), outward), 0.4)
    return _case(s, Ray(rounded(add(s.center, outward, s.radius + off)), direction), draw)


def _on_sphere(draw: RandomSource) -> Inputs:
    """One of the two distances is exactly 0, even for a method that divides by the radius."""
    outward = draw.axis()
    s = Sphere(draw.simple_point(4), float(2 ** draw.whole(-1, 2)))
    return _case(s, Ray(add(s.center, outward, s.radius), times(draw.sign(), outward)), draw)


def _any_size(draw: RandomSource) -> Inputs:
    """The distance is up to 30 times the radius: farther away a method that is right on paper loses its digits."""
    radius = draw.logarithmic(*SIZES)
    s = Sphere(draw.point(min(1.0, 300 * radius) if radius < 1 else 0.1 * radius), radius)
    return _case(s, _at_sphere(draw, s, 0.0, 0.7, radius * (1 + draw.logarithmic(0.1, 30))), draw)


def _signed_zeros(draw: RandomSource) -> Inputs:
    """Along an axis; the zeros of the direction have either sign."""
    s, axis, sign = Sphere(draw.simple_point(4), float(draw.whole(1, 5))), draw.whole(0, 2), draw.sign()
    direction = with_zeros(draw, axis, sign)
    return _case(s, Ray(add(s.center, direction, -float(draw.whole(6, 12))), direction), draw)


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


def _distances(draw: RandomSource, count: int) -> list[float]:
    """Well apart, in random order."""
    found: list[float] = []
    for _ in range(count):
        apart = draw.until(lambda new: all(abs(new - other) > 0.2 for other in found), lambda: draw.real(0.5, 30))
        found.append(apart)
    return found


def _list(draw: RandomSource, distances: list[float], missed: int) -> Inputs:
    surfaces = [Scripted(distance) for distance in distances]
    for _ in range(missed):
        surfaces.insert(draw.whole(0, len(surfaces)), Scripted(None))
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
