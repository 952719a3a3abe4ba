"""Cases of step 09: the area of a box, what a cut costs, and scenes of which a tree is built."""

import math

from raysteps.common.vectors import Vector, add
from raysteps.judge.answers import Answer, real, words_of_number
from raysteps.judge.bvhs import BVH
from raysteps.judge.cases.bvh_searches import CLOSEST_HIT_IN_BVH, OCCLUDED_IN_BVH
from raysteps.judge.cases.octree_boxes import any_box, far_box, flat_box, simple_box
from raysteps.judge.cases.tree_scenes import ball, built, large_and_small, small_scene
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Box, Inputs, Whole, rounded
from raysteps.judge.random_source import RandomSource
from raysteps.judge.surfaces import Sphere, Triangle

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


FUNCTIONS = (SURFACE_AREA, SPLIT_COST, BUILD_BVH, CLOSEST_HIT_IN_BVH, OCCLUDED_IN_BVH)
