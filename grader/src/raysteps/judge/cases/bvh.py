"""Cases of step 09: the area of a box, what a cut costs, scenes of which a tree is built, and searches through it."""

import math
from dataclasses import replace
from functools import partial

from raysteps.common.vectors import Vector, add, minus, unit
from raysteps.judge.answers import Answer, real, words_of_number
from raysteps.judge.bvhs import BVH
from raysteps.judge.cases.octree_boxes import any_box, far_box, flat_box, simple_box
from raysteps.judge.cases.tree_cases import (
    AROUND_THE_FIRST,
    BALLS,
    BEFORE_THE_FIRST,
    BEYOND_THE_FIRST,
    SLOPE,
    Distance,
    MakeRays,
    RaysInScene,
    aimed,
    aimed_from_inside,
    aimed_ray,
    along_axis,
    among_few,
    among_many,
    any_scene,
    ball,
    between,
    built,
    closest,
    dense_scene,
    fixed,
    from_far,
    from_inside,
    in_a_large_world,
    large_and_small,
    looking_away,
    many_rays,
    no_surfaces,
    occluded_each,
    one_ray,
    over_a_ground,
    search,
    slope_and_balls,
    small_scene,
    small_sphere,
    times_first,
)
from raysteps.judge.functions import Function, Group, InputGenerator
from raysteps.judge.protocol import Box, Inputs, Ray, Whole, rounded
from raysteps.judge.random_source import RandomSource
from raysteps.judge.searches import CLOSEST_IN_BVH, OCCLUSIONS_IN_BVH, BvhSource
from raysteps.judge.surfaces import ScriptedSurface, Sphere, Triangle

_AREA = Answer(lambda tokens: tokens.real(), words_of_number, lambda _inputs, *pair: real("the area", *pair))
_COST = Answer(lambda tokens: tokens.real(), words_of_number, lambda _inputs, *pair: real("the cost", *pair))
_EMPTY = Box((math.inf,) * 3, (-math.inf,) * 3)


def _small_or_large(draw: RandomSource) -> Inputs:
    size = 0.25 if draw.chance(0.5) else 300.0
    low = draw.point(size)
    high = add(low, (size * draw.real(0.5, 2), size * draw.real(0.5, 2), size * draw.real(0.5, 2)))
    return {"box": Box(low, rounded(high))}


def _slab(draw: RandomSource) -> Inputs:
    """Much longer along one axis than along the others: who takes one pair of faces twice is far off."""
    low, axis = draw.simple_point(3), draw.whole(0, 2)
    x, y, z = (draw.eighths(8, 16) if i == axis else draw.eighths(0.5, 1) for i in range(3))
    return {"box": Box(low, add(low, (x, y, z)))}


def _line(draw: RandomSource, box: Box) -> Box:
    """No area: as long as the box along one axis, or a point."""
    axis = draw.whole(0, 3)
    x, y, z = (b if i == axis else a for i, (a, b) in enumerate(zip(box.low, box.high, strict=True)))
    return Box(box.low, (x, y, z))


def _empty(draw: RandomSource) -> Inputs:
    """Empty along all axes, or along one of them only."""
    if draw.chance(0.4):
        return {"box": _EMPTY}
    box, axis = simple_box(draw), draw.whole(0, 2)
    low, high = list(box.low), list(box.high)
    low[axis], high[axis] = high[axis], low[axis]
    return {"box": Box((low[0], low[1], low[2]), (high[0], high[1], high[2]))}


SURFACE_AREA = Function(
    "surface_area",
    _AREA,
    (
        Group("any box", lambda d: {"box": any_box(d)}),
        Group("simple numbers", lambda d: {"box": simple_box(d)}),
        Group("long boxes", _slab),
        Group("flat boxes", lambda d: {"box": flat_box(simple_box(d), d.whole(0, 2))}, exact=True),
        Group("on one side of the centre of the world", lambda d: {"box": far_box(d)}),
        Group("small and large boxes", _small_or_large),
        Group("lines and points", lambda d: {"box": _line(d, simple_box(d))}, exact=True),
        Group("empty boxes", _empty, exact=True),
    ),
)


def _cut(left: Box, left_count: int, right: Box, right_count: int, whole: Box) -> Inputs:
    return {
        "left": left,
        "left_count": Whole(left_count),
        "right": right,
        "right_count": Whole(right_count),
        "whole": whole,
    }


def _at(box: Box, axis: int, share: float) -> float:
    return box.low[axis] + share * (box.high[axis] - box.low[axis])


def _halves(box: Box, axis: int, end: float, begin: float) -> tuple[Box, Box]:
    """The parts of the box up to one share of it and from another one on."""

    def moved(corner: Vector, share: float) -> Vector:
        x, y, z = (_at(box, axis, share) if i == axis else c for i, c in enumerate(corner))
        return rounded((x, y, z))

    return Box(box.low, moved(box.high, end)), Box(moved(box.low, begin), box.high)


def _two_counts(draw: RandomSource) -> tuple[int, int]:
    """Clearly different ones, either of them the larger."""
    few, many = draw.whole(1, 9), draw.whole(15, 60)
    return (few, many) if draw.chance(0.5) else (many, few)


def _gap(draw: RandomSource) -> Inputs:
    whole = any_box(draw)
    left, right = _halves(whole, draw.whole(0, 2), draw.real(0.2, 0.4), draw.real(0.5, 0.8))
    counts = _two_counts(draw)
    return _cut(left, counts[0], right, counts[1], whole)


def _overlap(draw: RandomSource) -> Inputs:
    whole = any_box(draw)
    left, right = _halves(whole, draw.whole(0, 2), draw.real(0.6, 0.9), draw.real(0.2, 0.5))
    counts = _two_counts(draw)
    return _cut(left, counts[0], right, counts[1], whole)


def _simple_cut(draw: RandomSource) -> Inputs:
    whole = simple_box(draw)
    left, right = _halves(whole, draw.whole(0, 2), 0.5, 0.5)
    return _cut(left, draw.whole(1, 8), right, draw.whole(1, 8), whole)


def _flat_cut(draw: RandomSource) -> Inputs:
    axis = draw.whole(0, 2)
    whole = flat_box(simple_box(draw), axis)
    left, right = _halves(whole, (axis + draw.whole(1, 2)) % 3, 0.25, 0.75)
    counts = _two_counts(draw)
    return _cut(left, counts[0], right, counts[1], whole)


def _empty_half(draw: RandomSource) -> Inputs:
    """No surfaces and an empty box on one side: that side costs nothing."""
    whole = simple_box(draw)
    full = _halves(whole, draw.whole(0, 2), 0.75, 0.25)[draw.whole(0, 1)]
    count = draw.whole(2, 30)
    return _cut(_EMPTY, 0, full, count, whole) if draw.chance(0.5) else _cut(full, count, _EMPTY, 0, whole)


def _without_area(draw: RandomSource) -> Inputs:
    whole = _line(draw, simple_box(draw))
    left, right = _halves(whole, draw.whole(0, 2), 0.5, 0.5)
    return _cut(left, draw.whole(1, 20), right, draw.whole(1, 20), whole)


SPLIT_COST = Function(
    "split_cost",
    _COST,
    (
        Group("halves with a gap", _gap),
        Group("halves that overlap", _overlap),
        Group("simple numbers", _simple_cut),
        Group("flat boxes", _flat_cut, exact=True),
        Group("nothing on one side", _empty_half, exact=True),
        Group("a whole without area", _without_area, exact=True),
    ),
)


# Scenes.


def _clusters(draw: RandomSource) -> Inputs:
    """Three heaps far from one another, of very different size."""
    sizes = (draw.whole(3, 8), draw.whole(15, 20), draw.whole(35, 45))
    places = ((-20.0, -4.0, 0.0), (2.0, 3.0, 8.0), (9.0, -3.0, -6.0))
    return built(
        tuple(ball(draw, place, 1.5, (4, 12)) for place, n in zip(places, sizes, strict=True) for _ in range(n))
    )


def _long_row(draw: RandomSource) -> Inputs:
    """Along a diagonal, in mixed order."""
    step = (draw.whole(4, 8) / 8, draw.whole(2, 8) / 8, draw.whole(1, 4) / 8)
    places = sorted(range(100), key=lambda _: draw.fine(0, 1))
    return built(tuple(Sphere((i * step[0], i * step[1], i * step[2]), 0.25) for i in places))


def _in_one_place(draw: RandomSource) -> Inputs:
    thing = Sphere(draw.simple_point(4), draw.eighths(0.5, 2)) if draw.chance(0.5) else draw.triangle()
    return built((thing,) * draw.whole(20, 60))


def _one_middle(draw: RandomSource) -> Inputs:
    """Shells around one point: their middles are the same, their boxes are not."""
    center = draw.simple_point(4)
    return built(tuple(Sphere(center, (i + 1) / 4) for i in range(draw.whole(12, 30))))


def _in_one_plane(draw: RandomSource) -> Inputs:
    height, axis = draw.eighths(-2, 2), draw.whole(0, 2)

    def at(x: float, y: float) -> tuple[float, float, float]:
        corner = [x, y]
        corner.insert(axis, height)
        return corner[0], corner[1], corner[2]

    grid = [(float(i % 6), float(i // 6)) for i in range(30)]
    return built(tuple(Triangle(at(x, y), at(x + 0.75, y), at(x, y + 0.75)) for x, y in grid))


def _growing(draw: RandomSource) -> Inputs:
    """Each twice as far and as large as the one before: all middles but a few are in the first bin."""
    sign, count = draw.sign(), draw.whole(14, 20)
    axis = draw.whole(0, 2)
    places = [tuple(sign * 2.0**i if a == axis else 0.0 for a in range(3)) for i in range(-4, count - 4)]
    return built(tuple(Sphere((p[0], p[1], p[2]), max(map(abs, p)) / 4) for p in places))


def _far_away(draw: RandomSource) -> Inputs:
    sign = draw.sign()
    away = (sign * 64.0, sign * 80.0, sign * 100.0)
    return built(tuple(ball(draw, away, 5, (6, 40)) for _ in range(25)))


BUILD_BVH = Function(
    "build_bvh",
    BVH,
    (
        Group("spheres and triangles", lambda d: built(small_scene(d, 30, 8))),
        Group("many small spheres", lambda d: built(small_scene(d, 110, 0, largest=0.3)), saves=True),
        Group("heaps of different size", _clusters),
        Group("a long row", _long_row),
        Group("large ones among small ones", lambda d: built(large_and_small(d))),
        Group("all in one place", _in_one_place),
        Group("one within the other", _one_middle),
        Group("all in one plane", _in_one_plane),
        Group("each twice as large", _growing),
        Group("far from the centre of the world", _far_away),
        Group("two surfaces", lambda d: built(small_scene(d, 1, 1))),
        Group("a single surface", lambda d: built(small_scene(d, 1, 0) if d.chance(0.5) else small_scene(d, 0, 1))),
        Group("no surfaces", lambda d: built(())),
    ),
)


# Searching a tree: the closest hit.


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
    surfaces = [ScriptedSurface(distance) for distance in (*others, nearest, nearest, *((nearest,) * draw.whole(0, 4)))]
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


_closest = partial(search, BvhSource, closest)

CLOSEST_HIT_IN_BVH = Function(
    "closest_hit_in_bvh",
    CLOSEST_IN_BVH,
    (
        Group("in a tree that is given", _closest(one_ray, own=0)),
        Group("in the tree of build_bvh", _closest(one_ray, own=1)),
        Group("a single leaf", _closest(among_few, own=0)),
        Group("from inside", _closest(from_inside)),
        Group("along an axis", _closest(along_axis)),
        Group("boxes that overlap", _closest(_long_triangles)),
        Group("a slope among balls", _closest(slope_and_balls)),
        Group("one ball behind another", _closest(_balls_in_a_row)),
        Group("several at one distance", _closest(_at_one_distance, own=0.3), exact=True),
        Group("several in one place", _closest(_same_spheres)),
        Group("from far away", _closest(from_far)),
        Group("in a large world", _closest(in_a_large_world)),
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
    surfaces = [ScriptedSurface(distance) for distance in (*others, nearest)]
    surfaces.sort(key=lambda _: draw.fine(0, 1))
    return tuple(surfaces), (Ray(draw.point(5), draw.direction()),)


# One surface each: what is asked does not hang on the tree.


def _very_near(draw: RandomSource) -> RaysInScene:
    """No hit is too near to count."""
    return (ScriptedSurface(2.0 ** -draw.whole(7, 12)),), (Ray(draw.point(5), draw.direction()),)


def _towards_glass(draw: RandomSource) -> RaysInScene:
    """What is clear hides what is behind it like anything else."""
    ball = replace(small_sphere(draw, 0.4, 1.5), glass=True)
    return (ball,), (aimed(draw, (ball,), 15),)


def _out_of_the_shell(draw: RandomSource) -> RaysInScene:
    """From among the little things, past the ground or onto it."""
    return large_and_small(draw), (Ray(draw.point(4), draw.slanted()),)


def _of_the_first(factor: float) -> Distance:
    """So many times the distance of the first hit; with 1 exactly that."""
    return times_first(lambda _: factor)


def _occluded(rays: MakeRays, distance: Distance, own: float = 0.5) -> InputGenerator:
    return search(BvhSource, occluded_each(distance), rays, own)


OCCLUDED_IN_BVH = Function(
    "occluded_in_bvh",
    OCCLUSIONS_IN_BVH,
    (
        Group("hit or not", _occluded(one_ray, AROUND_THE_FIRST, own=0)),
        Group("in the tree of build_bvh", _occluded(one_ray, AROUND_THE_FIRST, own=1)),
        Group("a hit before the distance", _occluded(aimed_ray, BEYOND_THE_FIRST)),
        Group("all hits beyond the distance", _occluded(aimed_ray, BEFORE_THE_FIRST)),
        Group("just before the distance", _occluded(_aimed_from_anywhere, _of_the_first(1.002))),
        Group("just beyond the distance", _occluded(_aimed_from_anywhere, _of_the_first(0.998))),
        Group(
            "exactly at the distance",
            _occluded(_several_distances, _of_the_first(1), own=0.3),
            exact=True,
        ),
        Group("a hit very near", _occluded(_very_near, between(0.1, 3), own=0.3)),
        Group("glass", _occluded(_towards_glass, BEYOND_THE_FIRST)),
        Group("as far as it may be", _occluded(aimed_ray, fixed(math.inf))),
        Group("from inside", _occluded(from_inside, BEYOND_THE_FIRST)),
        Group("along an axis", _occluded(along_axis, BEYOND_THE_FIRST)),
        Group("large ones among small ones", _occluded(_out_of_the_shell, _of_the_first(1.2), own=1)),
        Group("everything behind the ray", _occluded(lambda d: looking_away(d, 12), between(5, 50))),
        Group("few surfaces are asked", _occluded(among_many, fixed(40.0), own=1), saves=True),
        Group("the first hit ends the search", _occluded(_through_slopes, fixed(60.0), own=0)),
        Group("no surfaces", _occluded(no_surfaces, fixed(9.0), own=1)),
    ),
    yes_or_no=True,
)


FUNCTIONS = (SURFACE_AREA, SPLIT_COST, BUILD_BVH, CLOSEST_HIT_IN_BVH, OCCLUDED_IN_BVH)
