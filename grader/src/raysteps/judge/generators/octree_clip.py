"""Cases of step 06: the part of a ray that lies in a box."""

import math
from dataclasses import dataclass

from raysteps.judge.answers import Answer, first
from raysteps.judge.comparing import LENGTHS, real
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.octree_boxes import any_box, within
from raysteps.judge.generators.octree_clip_exact import along_axis, along_face, flat, from_face
from raysteps.judge.numbers import Vector, add, rounded, unit
from raysteps.judge.tokens import Garbled, Tokens
from raysteps.judge.values import Box, Inputs, Ray

_NEAR = 0.03  # how clearly a ray passes a box by


@dataclass(frozen=True)
class _Part:
    """Where a ray enters and leaves a box; nothing where it misses."""

    interval: tuple[float, float] | None


def _read_part(tokens: Tokens) -> _Part:
    word = tokens.word()
    if word not in ("none", "part"):
        raise Garbled("the answer is neither an interval nor nothing")
    return _Part((tokens.real(), tokens.real()) if word == "part" else None)


def _part_words(part: _Part) -> str:
    if part.interval is None:
        return "nothing, the ray misses the box"
    return f"enter {part.interval[0]:.9g}, leave {part.interval[1]:.9g}"


def _part_problem(_inputs: Inputs, expected: _Part, actual: _Part) -> str:
    if expected.interval is None:
        return "" if actual.interval is None else "the ray misses the box, and an interval came"
    if actual.interval is None:
        return "the ray hits the box, and nothing came"
    enter, leave = actual.interval
    return first(
        "enter is below 0" if enter < 0 else "",
        real("enter", expected.interval[0], enter, LENGTHS),
        real("leave", expected.interval[1], leave, LENGTHS),
        "" if enter <= leave else "enter is above leave",
    )


_PART = Answer(_read_part, _part_words, _part_problem)


def _misses(box: Box, ray: Ray, margin: float) -> bool:
    """Whether the ray misses the box even when that is grown."""
    enter, leave = 0.0, math.inf
    for low, high, origin, way in zip(box.low, box.high, ray.origin, ray.direction, strict=True):
        ends = sorted(((low - margin - origin) / way, (high + margin - origin) / way))
        enter, leave = max(enter, ends[0]), min(leave, ends[1])
    return enter > leave


def _clip(box: Box, origin: Vector, direction: Vector) -> Inputs:
    return {"box": box, "ray": Ray(rounded(origin), direction)}


def _through(draw: Draw) -> Inputs:
    box, direction = any_box(draw), draw.slanted()
    return _clip(box, add(within(draw, box), direction, -draw.real(8, 15)), direction)


def _past(draw: Draw) -> Inputs:
    box = any_box(draw)
    ray = draw.until(lambda found: _misses(box, found, _NEAR), lambda: Ray(draw.point(9), draw.slanted()))
    return {"box": box, "ray": ray}


def _through_or_past(draw: Draw) -> Inputs:
    return _through(draw) if draw.chance(0.7) else _past(draw)


def _from_inside(draw: Draw) -> Inputs:
    box = any_box(draw)
    return _clip(box, within(draw, box), draw.slanted())


def _box_behind(draw: Draw) -> Inputs:
    box, direction = any_box(draw), draw.slanted()
    return _clip(box, add(within(draw, box), direction, draw.real(8, 15)), direction)


def _close_to_corner(draw: Draw) -> Inputs:
    """Through the box close to an edge or a corner, or closely past it."""
    box, inside = any_box(draw), draw.chance(0.5)

    def clear(ray: Ray) -> bool:
        return not _misses(box, ray, -0.01) if inside else _misses(box, ray, 0.01)

    def make() -> Ray:
        corner = [(box.low, box.high)[draw.whole(0, 1)][axis] for axis in range(3)]
        place = add((corner[0], corner[1], corner[2]), draw.direction(), draw.real(0.02, 0.15))
        direction = draw.slanted(0.2)
        return Ray(rounded(add(place, direction, -draw.real(3, 8))), direction)

    return {"box": box, "ray": draw.until(clear, make)}


def _almost_along_axis(draw: Draw) -> Inputs:
    """One of the direction's numbers is nearly 1, the others nearly 0."""
    box, axis = any_box(draw), draw.whole(0, 2)
    way = [draw.sign() * (1.0 if i == axis else draw.real(1e-6, 1e-4)) for i in range(3)]
    direction = rounded(unit((way[0], way[1], way[2])))
    return _clip(box, add(within(draw, box), direction, -draw.real(5, 10)), direction)


def _tiny_or_huge(draw: Draw) -> Inputs:
    size, low = (0.02, draw.point(0.5)) if draw.chance(0.5) else (500.0, draw.point(100))
    high = add(low, (size * draw.real(0.5, 2), size * draw.real(0.5, 2), size * draw.real(0.5, 2)))
    box, direction = Box(low, rounded(high)), draw.slanted(0.1)
    return _clip(box, add(within(draw, box), direction, -size * draw.real(4, 8)), direction)


CLIP = Function(
    "Box::clip",
    _PART,
    (
        Group("through or past the box", _through_or_past, telling=False),
        Group("origin inside", _from_inside),
        Group("along an axis", along_axis, telling=False, exact=True),
        Group("along a face or an edge", along_face, exact=True),
        Group("flat boxes", flat, exact=True),
        Group("origin on a face", from_face, exact=True),
        Group("almost along an axis", _almost_along_axis),
        Group("tiny and huge boxes", _tiny_or_huge),
        Group("close to an edge or a corner", _close_to_corner, telling=False),
        Group("behind the origin", _box_behind, telling=False),
        Group("past the box", _past, telling=False),
    ),
)
