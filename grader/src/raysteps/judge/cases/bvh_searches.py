"""Cases of step 09 with whole scenes: searching a tree."""

import math
from functools import partial

from raysteps.common.vectors import add, minus, unit
from raysteps.judge.cases.search_cases import (
    Distance,
    MakeRays,
    RaysInScene,
    aimed,
    aimed_from_inside,
    aimed_ray,
    along_axis,
    among_many,
    between,
    closest,
    fixed,
    from_far,
    from_inside,
    looking_away,
    many_rays,
    no_surfaces,
    occluded_each,
    one_ray,
    over_a_ground,
    search,
    slope_and_balls,
    times_first,
)
from raysteps.judge.cases.tree_scenes import BALLS, SLOPE, any_scene, dense_scene, large_and_small, small_scene
from raysteps.judge.functions import Function, Group, Make
from raysteps.judge.protocol import Ray, rounded
from raysteps.judge.random_source import RandomSource
from raysteps.judge.searches import ANY_IN_BVH, CLOSEST_IN_BVH, WhoseBvh
from raysteps.judge.surfaces import Scripted, Triangle

# The closest hit.


def _long_triangles(draw: RandomSource) -> RaysInScene:
    """Their boxes overlap: what is hit through the nearer box may lie behind what is in the other one."""
    surfaces = (SLOPE, *small_scene(draw, 20, 25))
    return surfaces, (aimed(draw, surfaces[1:], 16),)


def _balls_in_a_row(draw: RandomSource) -> RaysInScene:
    """Through two of the balls, in any direction."""
    far, near = draw.until(lambda pair: pair[0] != pair[1], lambda: (draw.whole(0, 63), draw.whole(0, 63)))
    way = minus(BALLS[far].center, BALLS[near].center)
    direction = rounded(unit(add(way, draw.point(0.3))))
    return BALLS, (Ray(rounded(add(BALLS[near].center, direction, -25)), direction),)


def _at_one_distance(draw: RandomSource) -> RaysInScene:
    """Several are the nearest at once: the first in the scene counts."""
    nearest = draw.eighths(1, 8)
    others = [nearest + draw.eighths(0.5, 6) for _ in range(draw.whole(3, 12))]
    surfaces = [Scripted(distance) for distance in (*others, nearest, nearest, *((nearest,) * draw.whole(0, 4)))]
    surfaces.sort(key=lambda _: draw.fine(0, 1))
    return tuple(surfaces), (Ray(draw.point(5), draw.direction()),)


def _same_spheres(draw: RandomSource) -> RaysInScene:
    """Each of the spheres is there several times."""
    spheres = tuple(sphere for sphere in small_scene(draw, 8, 0) for _ in range(5))
    mixed = tuple(sorted(spheres, key=lambda _: draw.fine(0, 1)))
    return mixed, (aimed(draw, mixed, 16),)


def _in_a_dense_scene(draw: RandomSource) -> RaysInScene:
    return many_rays(draw, dense_scene(draw))


def _through_slopes(draw: RandomSource) -> RaysInScene:
    """The boxes of all of them overlap: who looks for the nearest hit asks them all, and any hit is enough."""
    slopes = []
    for _ in range(64):
        up = draw.eighths(0, 3)
        slopes.append(Triangle((-8.0, -8.0, up - 8), (24.0, -8.0, up + 8), (-8.0, 24.0, up + 8)))
    rays = (draw.ray_towards(draw.point(3), 25) for _ in range(24))
    return tuple(slopes), tuple(rays)


_closest = partial(search, WhoseBvh, closest)

CLOSEST_HIT_IN_BVH = Function(
    "closest_hit_in_bvh",
    CLOSEST_IN_BVH,
    (
        Group("in a tree that is given", _closest(one_ray, own=0)),
        Group("in the tree of build_bvh", _closest(one_ray, own=1)),
        Group("from inside", _closest(from_inside)),
        Group("along an axis", _closest(along_axis)),
        Group("boxes that overlap", _closest(_long_triangles)),
        Group("a slope among balls", _closest(slope_and_balls)),
        Group("one ball behind another", _closest(_balls_in_a_row)),
        Group("several at one distance", _closest(_at_one_distance, own=0.3), exact=True),
        Group("several in one place", _closest(_same_spheres)),
        Group("from far away", _closest(from_far)),
        Group("everything behind the ray", _closest(looking_away)),
        Group("large ones among small ones", _closest(over_a_ground, own=1)),
        Group("few surfaces are asked", _closest(among_many, own=1), saves=True),
        Group("what lies behind is spared", _closest(_in_a_dense_scene, own=0)),
        Group("no surfaces", _closest(no_surfaces, own=1)),
    ),
)


# Is anything hit before a distance?


def _aimed_from_anywhere(draw: RandomSource) -> RaysInScene:
    surfaces = any_scene(draw)
    return surfaces, (aimed_from_inside(draw, surfaces) if draw.chance(0.5) else aimed(draw, surfaces, 15),)


def _several_distances(draw: RandomSource) -> RaysInScene:
    """The nearest is among them once or more."""
    nearest = draw.eighths(1, 8)
    others = [nearest + draw.eighths(0, 6) for _ in range(draw.whole(0, 9))]
    surfaces = [Scripted(distance) for distance in (*others, nearest)]
    surfaces.sort(key=lambda _: draw.fine(0, 1))
    return tuple(surfaces), (Ray(draw.point(5), draw.direction()),)


def _out_of_the_shell(draw: RandomSource) -> RaysInScene:
    """From among the little things, past the ground or onto it."""
    return large_and_small(draw), (Ray(draw.point(4), draw.slanted()),)


def _more(draw: RandomSource) -> float:
    return draw.real(1.1, 2)


def _less(draw: RandomSource) -> float:
    return draw.real(0.3, 0.9)


_BEYOND_THE_FIRST = times_first(_more)
_BEFORE_THE_FIRST = times_first(_less)
_EITHER = times_first(lambda draw: _more(draw) if draw.chance(0.6) else _less(draw))


def _of_the_first(factor: float) -> Distance:
    """So many times the distance of the first hit; with 1 exactly that."""
    return times_first(lambda _: factor)


def _occluded(rays: MakeRays, distance: Distance, own: float = 0.5) -> Make:
    return search(WhoseBvh, occluded_each(distance), rays, own)


OCCLUDED_IN_BVH = Function(
    "occluded_in_bvh",
    ANY_IN_BVH,
    (
        Group("hit or not", _occluded(one_ray, _EITHER, own=0)),
        Group("in the tree of build_bvh", _occluded(one_ray, _EITHER, own=1)),
        Group("a hit before the distance", _occluded(aimed_ray, _BEYOND_THE_FIRST)),
        Group("all hits beyond the distance", _occluded(aimed_ray, _BEFORE_THE_FIRST)),
        Group("just before the distance", _occluded(_aimed_from_anywhere, _of_the_first(1.002))),
        Group("just beyond the distance", _occluded(_aimed_from_anywhere, _of_the_first(0.998))),
        Group(
            "exactly at the distance",
            _occluded(_several_distances, _of_the_first(1), own=0.3),
            exact=True,
        ),
        Group("as far as it may be", _occluded(aimed_ray, fixed(math.inf))),
        Group("from inside", _occluded(from_inside, _BEYOND_THE_FIRST)),
        Group("along an axis", _occluded(along_axis, _BEYOND_THE_FIRST)),
        Group("large ones among small ones", _occluded(_out_of_the_shell, _of_the_first(1.2), own=1)),
        Group("everything behind the ray", _occluded(lambda d: looking_away(d, 12), between(5, 50))),
        Group("few surfaces are asked", _occluded(among_many, fixed(40.0), own=1), saves=True),
        Group("the first hit ends the search", _occluded(_through_slopes, fixed(60.0), own=0)),
        Group("no surfaces", _occluded(no_surfaces, fixed(9.0), own=1)),
    ),
    yes_or_no=True,
)
