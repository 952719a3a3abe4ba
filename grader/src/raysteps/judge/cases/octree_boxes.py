"""Cases of step 06 about boxes: Box::clip, and which boxes a sphere and a triangle overlap."""

import math
from dataclasses import dataclass

from raysteps.common.vectors import Vector, add, unit
from raysteps.judge.answers import LENGTHS, SMALL, Answer, first, plainly_wrong, real, vector
from raysteps.judge.cases.tree_cases import small_scene
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Box, Inputs, ProtocolError, Ray, TokenReader, rounded
from raysteps.judge.random_source import RandomSource, with_zeros
from raysteps.judge.surfaces import Sphere, Surface, Surfaces, Triangle


def any_box(draw: RandomSource) -> Box:
    low = draw.point(3)
    return Box(low, rounded(add(low, (draw.real(0.5, 4), draw.real(0.5, 4), draw.real(0.5, 4)))))


def simple_box(draw: RandomSource) -> Box:
    low = draw.simple_point(3)
    return Box(low, add(low, (float(draw.whole(1, 4)), float(draw.whole(1, 4)), float(draw.whole(1, 4)))))


def flat_box(box: Box, axis: int) -> Box:
    high = list(box.high)
    high[axis] = box.low[axis]
    return Box(box.low, (high[0], high[1], high[2]))


def far_box(draw: RandomSource) -> Box:
    """On one side of the centre of the world: a search for the least and the largest that starts with 0 ends there."""
    box, sign = simple_box(draw), draw.sign()
    away = (sign * 16.0, sign * 32.0, sign * 64.0)
    return Box(add(box.low, away), add(box.high, away))


def within(draw: RandomSource, box: Box) -> Vector:
    x, y, z = (low + (high - low) * draw.real(0.1, 0.9) for low, high in zip(box.low, box.high, strict=True))
    return x, y, z


# Cases of step 06: the box around surfaces, and the eight parts of a box.


def _read_box(tokens: TokenReader) -> Box:
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
            return plainly_wrong(f"part {i}")
    return ""


_BOUNDS = Answer(_read_box, lambda box: box.words(), _bounds_problem)

_PARTS = Answer(
    lambda tokens: tuple(_read_box(tokens) for _ in range(8)),
    lambda parts: "; ".join(f"{i}: {box.words()}" for i, box in enumerate(parts)),
    _parts_problem,
)


def _bounds(surfaces: tuple[Surface, ...]) -> Inputs:
    return {"surfaces": Surfaces(surfaces)}


def _on_one_side(draw: RandomSource) -> Inputs:
    sign = draw.sign()
    away = (sign * draw.real(20, 90), sign * draw.real(20, 90), sign * draw.real(20, 90))
    spheres = [Sphere(rounded(add(s.center, away)), s.radius) for s in (draw.sphere() for _ in range(draw.whole(1, 3)))]
    shapes = [draw.triangle() for _ in range(draw.whole(1, 2))]
    corners = [[rounded(add(corner, away)) for corner in (t.a, t.b, t.c)] for t in shapes]
    return _bounds((*spheres, *(Triangle(a, b, c) for a, b, c in corners)))


def _flat_triangle(draw: RandomSource) -> Inputs:
    """Parallel to a plane of the axes: its bounds have no thickness."""
    t, axis, height = draw.triangle(), draw.whole(0, 2), draw.eighths(-3, 3)
    corners = [[height if i == axis else x for i, x in enumerate(corner)] for corner in (t.a, t.b, t.c)]
    a, b, c = ((x, y, z) for x, y, z in corners)
    return _bounds((Triangle(a, b, c),))


def _one_triangle(draw: RandomSource) -> Inputs:
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
        Group("no surfaces", lambda d: _bounds(())),
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


# Cases of step 06: rays along the axes of a box, and flat boxes, in exact numbers.


def _on_grid(draw: RandomSource, box: Box, shares: tuple[float, ...]) -> list[float]:
    """A point of the box whose coordinates are exact."""
    return [
        low + (high - low) * shares[draw.whole(0, len(shares) - 1)] for low, high in zip(box.low, box.high, strict=True)
    ]


def _axis_ray(draw: RandomSource, point: list[float], axis: int, distance: float) -> Ray:
    """Along the axis through the point; the zeros of the direction have either sign."""
    sign = draw.sign()
    way = with_zeros(draw, axis, sign)
    start = list(point)
    start[axis] -= sign * distance
    return Ray((start[0], start[1], start[2]), way)


def along_axis(draw: RandomSource) -> Inputs:
    box = simple_box(draw)
    point = _on_grid(draw, box, (0.25, 0.5, 0.75))
    if draw.chance(0.3):
        box = Box(add(box.low, (20.0, 20.0, 20.0)), add(box.high, (20.0, 20.0, 20.0)))  # the ray passes it by
    return {"box": box, "ray": _axis_ray(draw, point, draw.whole(0, 2), 8.0)}


def along_face(draw: RandomSource) -> Inputs:
    """In the plane of a face, or along an edge."""
    box, axis = simple_box(draw), draw.whole(0, 2)
    point = _on_grid(draw, box, (0.5,))
    flush = [(axis + 1) % 3] if draw.chance(0.6) else [(axis + 1) % 3, (axis + 2) % 3]
    for other in flush:
        point[other] = (box.low, box.high)[draw.whole(0, 1)][other]
    return {"box": box, "ray": _axis_ray(draw, point, axis, 8.0)}


def flat(draw: RandomSource) -> Inputs:
    """Across it, slanted or straight, or in its plane."""
    axis = draw.whole(0, 2)
    box = flat_box(simple_box(draw), axis)
    if draw.chance(0.4):
        direction = draw.slanted(0.2)
        return {"box": box, "ray": Ray(rounded(add(within(draw, box), direction, -6.0)), direction)}
    along = axis if draw.chance(0.5) else (axis + 1) % 3
    return {"box": box, "ray": _axis_ray(draw, _on_grid(draw, box, (0.25, 0.5)), along, 8.0)}


def from_face(draw: RandomSource) -> Inputs:
    """The origin is on a face and the ray goes in, or runs along the face."""
    box, axis, sign = simple_box(draw), draw.whole(0, 2), draw.sign()
    point = _on_grid(draw, box, (0.25, 0.5, 0.75))
    point[axis] = (box.low if sign > 0 else box.high)[axis]
    along = axis if draw.chance(0.5) else (axis + 1) % 3
    if along != axis:
        sign = draw.sign()
    way = with_zeros(draw, along, sign)
    return {"box": box, "ray": Ray((point[0], point[1], point[2]), way)}


# Cases of step 06: the part of a ray that lies in a box.

NO_PART = "the ray hits the box, and nothing came"
_NEAR = 0.03  # how clearly a ray passes a box by


@dataclass(frozen=True)
class _Part:
    """Where a ray enters and leaves a box; nothing where it misses."""

    interval: tuple[float, float] | None


def _read_part(tokens: TokenReader) -> _Part:
    word = tokens.word()
    if word not in ("none", "part"):
        raise ProtocolError("the answer is neither an interval nor nothing")
    return _Part((tokens.real(), tokens.real()) if word == "part" else None)


def _part_words(part: _Part) -> str:
    if part.interval is None:
        return "nothing, the ray misses the box"
    return f"enter {part.interval[0]:.9g}, leave {part.interval[1]:.9g}"


def _part_problem(_inputs: Inputs, expected: _Part, actual: _Part) -> str:
    if expected.interval is None:
        return "" if actual.interval is None else "the ray misses the box, and an interval came"
    if actual.interval is None:
        return NO_PART
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


def _through(draw: RandomSource) -> Inputs:
    box, direction = any_box(draw), draw.slanted()
    return _clip(box, add(within(draw, box), direction, -draw.real(8, 15)), direction)


def _past(draw: RandomSource) -> Inputs:
    box = any_box(draw)
    ray = draw.until(lambda found: _misses(box, found, _NEAR), lambda: Ray(draw.point(9), draw.slanted()))
    return {"box": box, "ray": ray}


def _through_or_past(draw: RandomSource) -> Inputs:
    return _through(draw) if draw.chance(0.7) else _past(draw)


def _from_inside(draw: RandomSource) -> Inputs:
    box = any_box(draw)
    return _clip(box, within(draw, box), draw.slanted())


def _box_behind(draw: RandomSource) -> Inputs:
    box, direction = any_box(draw), draw.slanted()
    return _clip(box, add(within(draw, box), direction, draw.real(8, 15)), direction)


def _close_to_corner(draw: RandomSource) -> Inputs:
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


def _almost_along_axis(draw: RandomSource) -> Inputs:
    """One of the direction's numbers is nearly 1, the others nearly 0. Half of the rays come from so far away that they
    begin beside the box: who takes a small number for 0 loses them."""
    box, axis = any_box(draw), draw.whole(0, 2)
    from_beside = draw.chance(0.5)
    small = (0.003, 0.02) if from_beside else (1e-6, 1e-4)
    way = [draw.sign() * (1.0 if i == axis else draw.logarithmic(*small)) for i in range(3)]
    direction = rounded(unit((way[0], way[1], way[2])))
    widths = [high - low for low, high in zip(box.low, box.high, strict=True)]
    beside = max(width / abs(x) for i, (width, x) in enumerate(zip(widths, direction, strict=True)) if i != axis)
    return _clip(box, add(within(draw, box), direction, -(beside if from_beside else draw.real(5, 10))), direction)


def _along_face_from_far(draw: RandomSource) -> Inputs:
    """As far along the other two axes as the box is wide, on a way that is thousands of times as long: who takes a
    thousandth for 0 loses the box."""
    box, axis = any_box(draw), draw.whole(0, 2)
    way = [draw.sign() * (1.0 if i == axis else draw.logarithmic(3e-5, 8e-4)) for i in range(3)]
    direction = rounded(unit((way[0], way[1], way[2])))
    widths = [high - low for low, high in zip(box.low, box.high, strict=True)]
    beside = max(width / abs(x) for i, (width, x) in enumerate(zip(widths, direction, strict=True)) if i != axis)
    return _clip(box, add(within(draw, box), direction, -beside), direction)


def _very_far(draw: RandomSource) -> Inputs:
    """Large boxes far away, or around the origin: a ray has no end."""
    distance, low = draw.logarithmic(1e5, 1e7), draw.point(1)
    size = (draw.real(0.2, 1), draw.real(0.2, 1), draw.real(0.2, 1))
    box, direction = Box(low, rounded(add(low, size, distance))), draw.slanted(0.1)
    inside = within(draw, box)
    return _clip(box, inside if draw.chance(0.3) else add(inside, direction, -2 * distance), direction)


def _tiny_or_huge(draw: RandomSource) -> Inputs:
    size, low = (0.02, draw.point(0.5)) if draw.chance(0.5) else (500.0, draw.point(100))
    high = add(low, (size * draw.real(0.5, 2), size * draw.real(0.5, 2), size * draw.real(0.5, 2)))
    box, direction = Box(low, rounded(high)), draw.slanted(0.1)
    return _clip(box, add(within(draw, box), direction, -size * draw.real(4, 8)), direction)


CLIP = Function(
    "Box::clip",
    _PART,
    (
        Group("through or past the box", _through_or_past),
        Group("origin inside", _from_inside),
        Group("along an axis", along_axis, exact=True),
        Group("along a face or an edge", along_face, exact=True),
        Group("flat boxes", flat, exact=True),
        Group("origin on a face", from_face, exact=True),
        Group("almost along an axis", _almost_along_axis),
        Group("nearly along a face, from far away", _along_face_from_far),
        Group("tiny and huge boxes", _tiny_or_huge),
        Group("very far away", _very_far),
        Group("close to an edge or a corner", _close_to_corner),
        Group("behind the origin", _box_behind),
        Group("past the box", _past),
    ),
)
