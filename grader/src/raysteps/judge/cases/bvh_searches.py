"""Cases of step 09 with whole scenes: building a tree."""

from raysteps.judge.bvhs import BVH
from raysteps.judge.cases.octree_searches import BALLS, SLOPE, aimed, large_and_small, point_within, small_scene
from raysteps.judge.functions import Function, Group
from raysteps.judge.numbers import add, minus, rounded, times, unit
from raysteps.judge.protocol import Inputs, Ray
from raysteps.judge.random_source import RandomSource
from raysteps.judge.searches import CLOSEST_IN_BVH, Rays, WhoseBvh
from raysteps.judge.surfaces import Scripted, Sphere, Surface, Surfaces, Triangle

_FINE = 64  # coordinates are multiples of 1 / 64: short to write, and exact


def _scene(surfaces: tuple[Surface, ...]) -> Inputs:
    return {"surfaces": Surfaces(surfaces)}


def _ball(draw: RandomSource, place: tuple[float, float, float], reach: float, low: int, high: int) -> Sphere:
    x, y, z = (round(c * _FINE) / _FINE for c in add(place, draw.point(reach)))
    return Sphere((x, y, z), draw.whole(low, high) / _FINE)


def _clusters(draw: RandomSource) -> Inputs:
    """Three heaps far from one another, of very different size."""
    sizes = (draw.whole(3, 8), draw.whole(15, 20), draw.whole(35, 45))
    places = ((-20.0, -4.0, 0.0), (2.0, 3.0, 8.0), (9.0, -3.0, -6.0))
    return _scene(
        tuple(_ball(draw, place, 1.5, 4, 12) for place, n in zip(places, sizes, strict=True) for _ in range(n))
    )


def _long_row(draw: RandomSource) -> Inputs:
    """Along a diagonal, in mixed order."""
    step = (draw.whole(4, 8) / 8, draw.whole(2, 8) / 8, draw.whole(1, 4) / 8)
    places = sorted(range(100), key=lambda _: draw.fine(0, 1))
    return _scene(tuple(Sphere((i * step[0], i * step[1], i * step[2]), 0.25) for i in places))


def _in_one_place(draw: RandomSource) -> Inputs:
    thing = Sphere(draw.simple_point(4), draw.eighths(0.5, 2)) if draw.chance(0.5) else draw.triangle()
    return _scene((thing,) * draw.whole(20, 60))


def _one_middle(draw: RandomSource) -> Inputs:
    """Shells around one point: their middles are the same, their boxes are not."""
    center = draw.simple_point(4)
    return _scene(tuple(Sphere(center, (i + 1) / 4) for i in range(draw.whole(12, 30))))


def _in_one_plane(draw: RandomSource) -> Inputs:
    height, axis = draw.eighths(-2, 2), draw.whole(0, 2)

    def at(x: float, y: float) -> tuple[float, float, float]:
        corner = [x, y]
        corner.insert(axis, height)
        return corner[0], corner[1], corner[2]

    grid = [(float(i % 6), float(i // 6)) for i in range(30)]
    return _scene(tuple(Triangle(at(x, y), at(x + 0.75, y), at(x, y + 0.75)) for x, y in grid))


def _growing(draw: RandomSource) -> Inputs:
    """Each twice as far and as large as the one before: all middles but a few are in the first bin."""
    sign, count = draw.sign(), draw.whole(14, 20)
    axis = draw.whole(0, 2)
    places = [tuple(sign * 2.0**i if a == axis else 0.0 for a in range(3)) for i in range(-4, count - 4)]
    return _scene(tuple(Sphere((p[0], p[1], p[2]), max(map(abs, p)) / 4) for p in places))


def _far_away(draw: RandomSource) -> Inputs:
    sign = draw.sign()
    away = (sign * 64.0, sign * 80.0, sign * 100.0)
    return _scene(tuple(_ball(draw, away, 5, 6, 40) for _ in range(25)))


BUILD_BVH = Function(
    "build_bvh",
    BVH,
    (
        Group("spheres and triangles", lambda d: _scene(small_scene(d, 30, 8))),
        Group("many small spheres", lambda d: _scene(small_scene(d, 110, 0, largest=0.3)), saves=True),
        Group("heaps of different size", _clusters),
        Group("a long row", _long_row),
        Group("large ones among small ones", lambda d: _scene(large_and_small(d))),
        Group("all in one place", _in_one_place),
        Group("one within the other", _one_middle),
        Group("all in one plane", _in_one_plane),
        Group("each twice as large", _growing),
        Group("far from the centre of the world", _far_away),
        Group("two surfaces", lambda d: _scene(small_scene(d, 1, 1))),
        Group("a single surface", lambda d: _scene(small_scene(d, 1, 0) if d.chance(0.5) else small_scene(d, 0, 1))),
        Group("no surfaces", lambda d: _scene(()), telling=False),
    ),
)


# Cases of step 09 with whole scenes: the closest hit in a tree.


def _search(surfaces: tuple[Surface, ...], rays: list[Ray], *, own: bool) -> Inputs:
    return {"tree": WhoseBvh(own), "surfaces": Surfaces(surfaces), "rays": Rays(tuple(rays))}


def _one_ray(draw: RandomSource, *, own: bool) -> Inputs:
    surfaces = small_scene(draw, draw.whole(25, 40), draw.whole(4, 10))
    ray = aimed(draw, surfaces, 15) if draw.chance(0.8) else draw.ray_towards(draw.point(9), 20)
    return _search(surfaces, [ray], own=own)


def from_inside(draw: RandomSource, surfaces: tuple[Surface, ...]) -> Ray:
    origin = draw.point(4)
    way = minus(point_within(draw, surfaces[draw.whole(0, len(surfaces) - 1)]), origin)
    return Ray(origin, rounded(unit(way)))


def _from_inside(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 35, 8)
    return _search(surfaces, [from_inside(draw, surfaces)], own=draw.chance(0.5))


def along_axis(draw: RandomSource, surfaces: tuple[Surface, ...]) -> Ray:
    direction = draw.axis()
    target = point_within(draw, surfaces[draw.whole(0, 34)])
    return Ray(rounded(add(target, direction, -16)), direction)


def _along_axis(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 35, 6)
    return _search(surfaces, [along_axis(draw, surfaces)], own=draw.chance(0.5))


def _long_triangles(draw: RandomSource) -> Inputs:
    """Their boxes overlap: what is hit through the nearer box may lie behind what is in the other one."""
    surfaces = (SLOPE, *small_scene(draw, 20, 25))
    return _search(surfaces, [aimed(draw, surfaces[1:], 16)], own=draw.chance(0.5))


def _later_box(draw: RandomSource) -> Inputs:
    return _search((SLOPE, *BALLS), [draw.ray_towards(draw.point(6), 25)], own=draw.chance(0.5))


def _balls_in_a_row(draw: RandomSource) -> Inputs:
    """Through two of the balls, in any direction."""
    far, near = draw.until(lambda pair: pair[0] != pair[1], lambda: (draw.whole(0, 63), draw.whole(0, 63)))
    way = minus(BALLS[far].center, BALLS[near].center)
    direction = rounded(unit(add(way, draw.point(0.3))))
    ray = Ray(rounded(add(BALLS[near].center, direction, -25)), direction)
    return _search(BALLS, [ray], own=draw.chance(0.5))


def _at_one_distance(draw: RandomSource) -> Inputs:
    """Several are the nearest at once: the first in the scene counts."""
    nearest = draw.eighths(1, 8)
    others = [nearest + draw.eighths(0.5, 6) for _ in range(draw.whole(3, 12))]
    surfaces = [Scripted(distance) for distance in (*others, nearest, nearest, *((nearest,) * draw.whole(0, 4)))]
    surfaces.sort(key=lambda _: draw.fine(0, 1))
    return _search(tuple(surfaces), [Ray(draw.point(5), draw.direction())], own=draw.chance(0.3))


def _same_spheres(draw: RandomSource) -> Inputs:
    """Each of the spheres is there several times."""
    spheres = tuple(sphere for sphere in small_scene(draw, 8, 0) for _ in range(5))
    mixed = tuple(sorted(spheres, key=lambda _: draw.fine(0, 1)))
    return _search(mixed, [aimed(draw, mixed, 16)], own=draw.chance(0.5))


def _looking_away(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 25, 6)
    direction = draw.direction()
    return _search(surfaces, [Ray(rounded(times(draw.real(10, 20), direction)), direction)], own=draw.chance(0.5))


def _from_far(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 25, 6)
    return _search(surfaces, [aimed(draw, surfaces, 100)], own=draw.chance(0.5))


def _over_a_ground(draw: RandomSource) -> Inputs:
    surfaces = large_and_small(draw)
    ray = Ray(draw.point(4), draw.slanted()) if draw.chance(0.5) else aimed(draw, surfaces[2:], 7)
    return _search(surfaces, [ray], own=True)


def dense_scene(draw: RandomSource) -> tuple[Surface, ...]:
    """Few rays get far in it."""
    return tuple(Sphere(draw.simple_point(5), draw.eighths(0.25, 0.75)) for _ in range(200))


def _many_rays(draw: RandomSource, surfaces: tuple[Surface, ...], *, own: bool) -> Inputs:
    return _search(surfaces, [aimed(draw, surfaces, 16) for _ in range(24)], own=own)


CLOSEST_HIT_IN_BVH = Function(
    "closest_hit_in_bvh",
    CLOSEST_IN_BVH,
    (
        Group("in a tree that is given", lambda d: _one_ray(d, own=False), telling=False),
        Group("in the tree of build_bvh", lambda d: _one_ray(d, own=True), telling=False),
        Group("from inside", _from_inside),
        Group("along an axis", _along_axis),
        Group("boxes that overlap", _long_triangles),
        Group("a slope among balls", _later_box, telling=False),
        Group("one ball behind another", _balls_in_a_row),
        Group("several at one distance", _at_one_distance, exact=True),
        Group("several in one place", _same_spheres),
        Group("from far away", _from_far),
        Group("everything behind the ray", _looking_away, telling=False),
        Group("large ones among small ones", _over_a_ground),
        Group(
            "few surfaces are asked", lambda d: _many_rays(d, small_scene(d, 200, 0, largest=0.3), own=True), saves=True
        ),
        Group("what lies behind is spared", lambda d: _many_rays(d, dense_scene(d), own=False)),
        Group("no surfaces", lambda d: _search((), [d.ray_towards((0.0, 0.0, 0.0), 5)], own=True), telling=False),
    ),
)
