"""Cases of step 09: the area of a box, and what a cut costs."""

import math

from raysteps.common.vectors import Vector, add
from raysteps.judge.answers import Answer, real, words_of_number
from raysteps.judge.cases.octree_boxes import any_box, far_box, flat_box, simple_box
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Box, Inputs, Whole, rounded
from raysteps.judge.random_source import RandomSource

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
