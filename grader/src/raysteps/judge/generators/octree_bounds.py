"""Cases of step 06: the box around surfaces, and the eight parts of a box."""

from raysteps.judge.answers import Answer, first
from raysteps.judge.comparing import SMALL, vector
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.octree_boxes import any_box, far_box, flat_box, simple_box
from raysteps.judge.generators.octree_scenes import small_scene
from raysteps.judge.numbers import add, rounded
from raysteps.judge.surfaces import Sphere, Surface, Surfaces, Triangle
from raysteps.judge.tokens import Tokens
from raysteps.judge.values import Box, Inputs


def _read_box(tokens: Tokens) -> Box:
    return Box(tokens.vector(), tokens.vector())


def _is_empty(box: Box) -> bool:
    return any(low > high for low, high in zip(box.low, box.high, strict=True))


def _bounds_problem(_inputs: Inputs, expected: Box, actual: Box) -> str:
    if _is_empty(expected):
        return "" if _is_empty(actual) else "without surfaces the box is empty, its min above its max"
    return first(vector("min", expected.low, actual.low, SMALL), vector("max", expected.high, actual.high, SMALL))


def _parts_problem(_inputs: Inputs, expected: tuple[Box, ...], actual: tuple[Box, ...]) -> str:
    for i, (mine, theirs) in enumerate(zip(expected, actual, strict=True)):
        if vector("", mine.low, theirs.low) or vector("", mine.high, theirs.high):
            return f"part {i} is wrong"
    return ""


_BOUNDS = Answer(_read_box, lambda box: box.words(), _bounds_problem)

_PARTS = Answer(
    lambda tokens: tuple(_read_box(tokens) for _ in range(8)),
    lambda parts: "; ".join(f"{i}: {box.words()}" for i, box in enumerate(parts)),
    _parts_problem,
)


def _bounds(surfaces: tuple[Surface, ...]) -> Inputs:
    return {"surfaces": Surfaces(surfaces)}


def _on_one_side(draw: Draw) -> Inputs:
    sign = draw.sign()
    away = (sign * draw.real(20, 90), sign * draw.real(20, 90), sign * draw.real(20, 90))
    spheres = [Sphere(rounded(add(s.center, away)), s.radius) for s in (draw.sphere() for _ in range(draw.whole(1, 3)))]
    shapes = [draw.triangle() for _ in range(draw.whole(1, 2))]
    corners = [[rounded(add(corner, away)) for corner in (t.a, t.b, t.c)] for t in shapes]
    return _bounds((*spheres, *(Triangle(a, b, c) for a, b, c in corners)))


def _flat_triangle(draw: Draw) -> Inputs:
    """Parallel to a plane of the axes: its bounds have no thickness."""
    t, axis, height = draw.triangle(), draw.whole(0, 2), draw.eighths(-3, 3)
    corners = [[height if i == axis else x for i, x in enumerate(corner)] for corner in (t.a, t.b, t.c)]
    a, b, c = ((x, y, z) for x, y, z in corners)
    return _bounds((Triangle(a, b, c),))


def _one_triangle(draw: Draw) -> Inputs:
    t: Triangle = draw.triangle()
    return _bounds((t,))


BOUNDS_OF = Function(
    "bounds_of",
    _BOUNDS,
    (
        Group("several surfaces", lambda d: _bounds(small_scene(d, d.whole(2, 5), d.whole(1, 4)))),
        Group("one sphere", lambda d: _bounds((d.sphere(),))),
        Group("one triangle", _one_triangle),
        Group("one flat triangle", _flat_triangle, exact=True),
        Group("on one side of the centre of the world", _on_one_side),
        Group("no surfaces", lambda d: _bounds(()), telling=False),
    ),
)

SPLIT = Function(
    "split",
    _PARTS,
    (
        Group("any box", lambda d: {"box": any_box(d)}),
        Group("simple numbers", lambda d: {"box": simple_box(d)}),
        Group("flat boxes", lambda d: {"box": flat_box(any_box(d), d.whole(0, 2))}),
        Group("on one side of the centre of the world", lambda d: {"box": far_box(d)}),
    ),
)
