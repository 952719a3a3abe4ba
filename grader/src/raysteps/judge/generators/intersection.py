"""Cases of step 02: the closest of several hits; triangles and spheres have modules of their own."""

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.sphere_cases import SPHERE_INTERSECT
from raysteps.judge.generators.triangle_cases import TRIANGLE_INTERSECT
from raysteps.judge.hits import FOUND
from raysteps.judge.surfaces import Scripted, Surfaces
from raysteps.judge.values import Inputs, Ray


def _distances(draw: Draw, count: int) -> list[float]:
    """Well apart, in random order."""
    found: list[float] = []
    for _ in range(count):
        apart = draw.until(lambda new: all(abs(new - other) > 0.2 for other in found), lambda: draw.real(0.5, 30))
        found.append(apart)
    return found


def _list(draw: Draw, distances: list[float], missed: int) -> Inputs:
    surfaces = [Scripted(distance) for distance in distances]
    for _ in range(missed):
        surfaces.insert(draw.whole(0, len(surfaces)), Scripted(None))
    return {"surfaces": Surfaces(tuple(surfaces)), "ray": Ray(draw.point(5), draw.direction())}


def _near_and_far(draw: Draw) -> Inputs:
    """Far ones alone, or beside a very near one: a search that starts with a largest distance of its own loses them."""
    far = [draw.real(1e4, 1e5), draw.real(1e6, 1e7)]
    return _list(
        draw, far[draw.whole(0, 1) :] if draw.chance(0.5) else [*far, draw.real(0.001, 0.01)], draw.whole(0, 2)
    )


def _many(draw: Draw) -> Inputs:
    return _list(draw, _distances(draw, draw.whole(30, 50)), draw.whole(0, 10))


def _sorted(draw: Draw, *, nearest_first: bool) -> Inputs:
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
        Group("all missed", lambda d: _list(d, [], d.whole(1, 5)), telling=False),
        Group("no surfaces", lambda d: _list(d, [], 0), telling=False),
    ),
)

FUNCTIONS = (TRIANGLE_INTERSECT, SPHERE_INTERSECT, _CLOSEST_HIT)
