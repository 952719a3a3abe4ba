"""Boxes that the cases of step 06 are made of."""

from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector, add, rounded
from raysteps.judge.values import Box


def any_box(draw: Draw) -> Box:
    low = draw.point(3)
    return Box(low, rounded(add(low, (draw.real(0.5, 4), draw.real(0.5, 4), draw.real(0.5, 4)))))


def simple_box(draw: Draw) -> Box:
    low = draw.simple_point(3)
    return Box(low, add(low, (float(draw.whole(1, 4)), float(draw.whole(1, 4)), float(draw.whole(1, 4)))))


def flat_box(box: Box, axis: int) -> Box:
    high = list(box.high)
    high[axis] = box.low[axis]
    return Box(box.low, (high[0], high[1], high[2]))


def far_box(draw: Draw) -> Box:
    """On one side of the centre of the world: a search for the least and the largest that starts with 0 ends there."""
    box, sign = simple_box(draw), draw.sign()
    away = (sign * 16.0, sign * 32.0, sign * 64.0)
    return Box(add(box.low, away), add(box.high, away))


def within(draw: Draw, box: Box) -> Vector:
    x, y, z = (low + (high - low) * draw.real(0.1, 0.9) for low, high in zip(box.low, box.high, strict=True))
    return x, y, z
