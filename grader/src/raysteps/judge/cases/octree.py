"""Cases of step 06."""

from raysteps.judge.cases.octree_boxes import BOUNDS_OF, CLIP, SPLIT
from raysteps.judge.cases.octree_overlaps import SPHERE_OVERLAPS, TRIANGLE_OVERLAPS
from raysteps.judge.cases.octree_searches import (
    BALLS,
    BUILD_OCTREE,
    CLOSEST_HIT_IN_OCTREE,
    aimed,
    large_and_small,
    point_within,
    search,
    small_scene,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.numbers import add, f32, minus, rounded, times, unit
from raysteps.judge.protocol import Inputs, Ray, Real
from raysteps.judge.random_source import RandomSource
from raysteps.judge.searches import ANY_HITS
from raysteps.judge.surfaces import Surface, Triangle

# Cases of step 06: is anything hit before a distance?

# Over all the balls; its edges are powers of 2, so that a ray straight down meets it at an exact distance.
_LID = Triangle((-16.0, -16.0, 8.0), (48.0, -16.0, 8.0), (-16.0, 48.0, 8.0))


def _asked(surfaces: tuple[Surface, ...], rays: list[Ray], distance: float, *, own: bool) -> Inputs:
    return {**search(surfaces, rays, own=own), "distance": Real(distance)}


def _one_ray(draw: RandomSource, *, own: bool) -> Inputs:
    surfaces = small_scene(draw, draw.whole(25, 40), draw.whole(4, 10))
    ray = aimed(draw, surfaces, 15) if draw.chance(0.8) else draw.ray_towards(draw.point(9), 20)
    return _asked(surfaces, [ray], draw.real(7, 17), own=own)


def _from_inside(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 35, 8)
    origin = draw.point(4)
    way = minus(point_within(draw, surfaces[draw.whole(0, len(surfaces) - 1)]), origin)
    return _asked(surfaces, [Ray(origin, rounded(unit(way)))], draw.real(0.5, 6), own=draw.chance(0.5))


def _along_axis(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 35, 6)
    direction = draw.axis()
    target = point_within(draw, surfaces[draw.whole(0, 34)])
    return _asked(surfaces, [Ray(rounded(add(target, direction, -16)), direction)], draw.real(9, 18), own=False)


def _in_a_later_box(draw: RandomSource) -> Inputs:
    """At the end of a way through boxes whose balls the ray passes by."""
    ball = BALLS[draw.whole(0, len(BALLS) - 1)]
    return _asked(BALLS, [draw.ray_towards(ball.center, 25)], draw.real(30, 60), own=draw.chance(0.5))


def _under_the_lid(draw: RandomSource) -> tuple[Ray, float]:
    """A ray from above, and how far it is to the lid; the balls lie below."""
    direction = rounded(unit((draw.real(-0.6, 0.6), draw.real(-0.6, 0.6), -1.0)))
    ball = BALLS[draw.whole(0, len(BALLS) - 1)]
    ray = Ray(rounded(add(ball.center, direction, -30)), direction)
    return ray, (8 - ray.origin[2]) / direction[2]


def _all_beyond(draw: RandomSource) -> Inputs:
    """The ray meets something, but too late."""
    ray, distance = _under_the_lid(draw)
    return _asked((_LID, *BALLS), [ray], f32(distance * draw.real(0.1, 0.9)), own=draw.chance(0.5))


def _close_to_a_hit(draw: RandomSource) -> Inputs:
    """The distance ends closely before the lid, or closely behind it."""
    ray, distance = _under_the_lid(draw)
    return _asked((_LID, *BALLS), [ray], f32(distance * (1 + 0.01 * draw.sign())), own=draw.chance(0.5))


def _exactly(draw: RandomSource) -> Inputs:
    """The lid at the very distance, where it is not nearer, or an eighth before it."""
    height = float(draw.whole(1, 8))
    ray = Ray((draw.eighths(-6, 6), draw.eighths(-6, 6), 8.0 + height), (0.0, 0.0, -1.0))
    return _asked((_LID, *BALLS), [ray], height + (0.125 if draw.chance(0.5) else 0.0), own=draw.chance(0.5))


def _looking_away(draw: RandomSource) -> Inputs:
    """Everything is behind the ray."""
    surfaces = small_scene(draw, 25, 6)
    direction = draw.direction()
    ray = Ray(rounded(times(draw.real(10, 20), direction)), direction)
    return _asked(surfaces, [ray], draw.real(10, 50), own=draw.chance(0.5))


def _from_far(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 25, 6)
    return _asked(surfaces, [aimed(draw, surfaces, 100)], draw.real(93, 102), own=draw.chance(0.5))


def _over_a_ground(draw: RandomSource) -> Inputs:
    """Something large and many little things: rays that meet the one or the others, or neither so soon."""
    surfaces = large_and_small(draw)
    ray = Ray(draw.point(4), draw.slanted()) if draw.chance(0.5) else aimed(draw, surfaces[2:], 7)
    return _asked(surfaces, [ray], draw.real(2, 9), own=True)


def _many_rays(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 200, 0, largest=0.3)
    return _asked(surfaces, [aimed(draw, surfaces, 16) for _ in range(24)], draw.real(13, 15), own=True)


OCCLUDED_IN_OCTREE = Function(
    "occluded_in_octree",
    ANY_HITS,
    (
        Group("in three levels of boxes", lambda d: _one_ray(d, own=False), telling=False),
        Group("in the tree of build_octree", lambda d: _one_ray(d, own=True), telling=False),
        Group("from inside", _from_inside, telling=False),
        Group("along an axis", _along_axis, telling=False),
        Group("in a later box", _in_a_later_box, telling=False),
        Group("everything beyond the distance", _all_beyond, telling=False),
        Group("close before or behind a hit", _close_to_a_hit, telling=False),
        Group("exactly at the distance", _exactly, telling=False, exact=True),
        Group("from far away", _from_far, telling=False),
        Group("everything behind the ray", _looking_away, telling=False),
        Group("large ones among small ones", _over_a_ground, telling=False),
        Group("few surfaces are asked", _many_rays),
        Group("no surfaces", lambda d: _asked((), [d.ray_towards((0.0, 0.0, 0.0), 5)], 9.0, own=True), telling=False),
    ),
    yes_or_no=True,
)


FUNCTIONS = (
    CLIP,
    SPHERE_OVERLAPS,
    TRIANGLE_OVERLAPS,
    BOUNDS_OF,
    SPLIT,
    BUILD_OCTREE,
    CLOSEST_HIT_IN_OCTREE,
    OCCLUDED_IN_OCTREE,
)
