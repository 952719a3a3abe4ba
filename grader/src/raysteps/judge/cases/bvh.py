"""Cases of step 09."""

import math

from raysteps.judge.cases.bvh_costs import SPLIT_COST, SURFACE_AREA
from raysteps.judge.cases.bvh_searches import BUILD_BVH, CLOSEST_HIT_IN_BVH, along_axis, dense_scene, from_inside
from raysteps.judge.cases.octree_searches import aimed, large_and_small, small_scene
from raysteps.judge.functions import Function, Group
from raysteps.judge.numbers import f32, rounded, times
from raysteps.judge.protocol import Inputs, Ray
from raysteps.judge.random_source import RandomSource
from raysteps.judge.searches import ANY_IN_BVH, Reach, Reaches, WhoseBvh
from raysteps.judge.surfaces import Scripted, Surface, Surfaces, first_distance

# Cases of step 09 with whole scenes: is anything hit before a distance?

_FAR = 60.0  # the distance where nothing is met


def _search(surfaces: tuple[Surface, ...], reaches: list[Reach], *, own: bool) -> Inputs:
    return {"tree": WhoseBvh(own), "surfaces": Surfaces(surfaces), "rays": Reaches(tuple(reaches))}


def _up_to(ray: Ray, surfaces: tuple[Surface, ...], times_first: float) -> Reach:
    """So many times as far as the first hit."""
    return Reach(ray, f32(min(first_distance(surfaces, ray), _FAR) * times_first))


def _times(draw: RandomSource, *, hits: bool) -> float:
    return draw.real(1.1, 2) if hits else draw.real(0.3, 0.9)


def _any_scene(draw: RandomSource) -> tuple[Surface, ...]:
    return small_scene(draw, draw.whole(25, 40), draw.whole(4, 10))


def _one_ray(draw: RandomSource, *, own: bool) -> Inputs:
    surfaces = _any_scene(draw)
    ray = aimed(draw, surfaces, 15) if draw.chance(0.8) else draw.ray_towards(draw.point(9), 20)
    return _search(surfaces, [_up_to(ray, surfaces, _times(draw, hits=draw.chance(0.6)))], own=own)


def _hit(draw: RandomSource) -> Inputs:
    surfaces = _any_scene(draw)
    ray = aimed(draw, surfaces, 15)
    return _search(surfaces, [_up_to(ray, surfaces, _times(draw, hits=True))], own=draw.chance(0.5))


def _too_far(draw: RandomSource) -> Inputs:
    """There are hits, all of them beyond the distance."""
    surfaces = _any_scene(draw)
    ray = aimed(draw, surfaces, 15)
    return _search(surfaces, [_up_to(ray, surfaces, _times(draw, hits=False))], own=draw.chance(0.5))


def _close_to_the_hit(draw: RandomSource, times_first: float) -> Inputs:
    surfaces = _any_scene(draw)
    ray = from_inside(draw, surfaces) if draw.chance(0.5) else aimed(draw, surfaces, 15)
    return _search(surfaces, [_up_to(ray, surfaces, times_first)], own=draw.chance(0.5))


def _exactly_there(draw: RandomSource) -> Inputs:
    """Not nearer than the distance: just as near."""
    nearest = draw.eighths(1, 8)
    others = [nearest + draw.eighths(0, 6) for _ in range(draw.whole(0, 9))]
    surfaces = [Scripted(distance) for distance in (*others, nearest)]
    surfaces.sort(key=lambda _: draw.fine(0, 1))
    return _search(tuple(surfaces), [Reach(Ray(draw.point(5), draw.direction()), nearest)], own=draw.chance(0.3))


def _without_end(draw: RandomSource) -> Inputs:
    surfaces = _any_scene(draw)
    return _search(surfaces, [Reach(aimed(draw, surfaces, 15), math.inf)], own=draw.chance(0.5))


def _from_inside(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 35, 8)
    ray = from_inside(draw, surfaces)
    return _search(surfaces, [_up_to(ray, surfaces, _times(draw, hits=True))], own=draw.chance(0.5))


def _along_axis(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 35, 6)
    ray = along_axis(draw, surfaces)
    return _search(surfaces, [_up_to(ray, surfaces, _times(draw, hits=True))], own=draw.chance(0.5))


def _over_a_ground(draw: RandomSource) -> Inputs:
    surfaces = large_and_small(draw)
    ray = Ray(draw.point(4), draw.slanted())
    return _search(surfaces, [_up_to(ray, surfaces, 1.2)], own=True)


def _looking_away(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 25, 6)
    direction = draw.direction()
    ray = Ray(rounded(times(draw.real(12, 20), direction)), direction)
    return _search(surfaces, [Reach(ray, draw.real(5, 50))], own=draw.chance(0.5))


def _many_rays(draw: RandomSource, surfaces: tuple[Surface, ...], *, own: bool) -> Inputs:
    return _search(surfaces, [Reach(aimed(draw, surfaces, 16), 40.0) for _ in range(24)], own=own)


OCCLUDED_IN_BVH = Function(
    "occluded_in_bvh",
    ANY_IN_BVH,
    (
        Group("hit or not", lambda d: _one_ray(d, own=False), telling=False),
        Group("in the tree of build_bvh", lambda d: _one_ray(d, own=True), telling=False),
        Group("a hit before the distance", _hit, telling=False),
        Group("all hits beyond the distance", _too_far, telling=False),
        Group("just before the distance", lambda d: _close_to_the_hit(d, 1.002), telling=False),
        Group("just beyond the distance", lambda d: _close_to_the_hit(d, 0.998), telling=False),
        Group("exactly at the distance", _exactly_there, telling=False, exact=True),
        Group("as far as it may be", _without_end, telling=False),
        Group("from inside", _from_inside, telling=False),
        Group("along an axis", _along_axis, telling=False),
        Group("large ones among small ones", _over_a_ground, telling=False),
        Group("everything behind the ray", _looking_away, telling=False),
        Group(
            "few surfaces are asked", lambda d: _many_rays(d, small_scene(d, 200, 0, largest=0.3), own=True), saves=True
        ),
        Group("the first hit ends the search", lambda d: _many_rays(d, dense_scene(d), own=False)),
        Group(
            "no surfaces",
            lambda d: _search((), [Reach(d.ray_towards((0.0, 0.0, 0.0), 5), 9.0)], own=True),
            telling=False,
        ),
    ),
    yes_or_no=True,
)


FUNCTIONS = (SURFACE_AREA, SPLIT_COST, BUILD_BVH, CLOSEST_HIT_IN_BVH, OCCLUDED_IN_BVH)
