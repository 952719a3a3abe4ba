"""What the overlaps of step 06 share: the answer, and boxes around a point or far from it."""

from raysteps.judge.answers import Answer
from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector, add, rounded
from raysteps.judge.values import Box, Inputs


def _touching_problem(_inputs: Inputs, expected: bool, actual: bool) -> str:
    if expected == actual:
        return ""
    return "they touch, and the answer is no" if expected else "they are far apart, and the answer is yes"


TOUCHING = Answer(lambda tokens: tokens.flag(), lambda answer: str(answer).lower(), _touching_problem)


def around(draw: Draw, point: Vector, smallest: float, largest: float) -> Box:
    """A box that holds the point, which is well within."""
    sizes = [draw.real(smallest, largest) for _ in range(3)]
    low = [x - draw.real(0.1, 0.9) * size for x, size in zip(point, sizes, strict=True)]
    return Box(rounded((low[0], low[1], low[2])), rounded((low[0] + sizes[0], low[1] + sizes[1], low[2] + sizes[2])))


def beyond(draw: Draw, middle: Vector, reach: float) -> Box:
    """Clearly beyond the bounds of something, along one axis at least."""
    way = draw.axis()
    size = (draw.real(0.3, 2), draw.real(0.3, 2), draw.real(0.3, 2))
    away = add(add(middle, way, reach + 1.0 + draw.real(0.5, 3)), draw.point(0.5))
    return Box(rounded(add(away, size, -0.5)), rounded(add(away, size, 0.5)))


def flattened(draw: Draw, box: Box, point: Vector) -> Box:
    """Without thickness along one axis, where it still holds the point."""
    axis = draw.whole(0, 2)
    low, high = list(box.low), list(box.high)
    low[axis] = high[axis] = point[axis]
    return Box(rounded((low[0], low[1], low[2])), rounded((high[0], high[1], high[2])))
