"""Cases of step 06: rays along the axes of a box, and flat boxes, in exact numbers."""

from raysteps.judge.drawing import Draw
from raysteps.judge.generators.axes import with_zeros
from raysteps.judge.generators.octree_boxes import flat_box, simple_box, within
from raysteps.judge.numbers import add, rounded
from raysteps.judge.values import Box, Inputs, Ray


def _on_grid(draw: Draw, box: Box, shares: tuple[float, ...]) -> list[float]:
    """A point of the box whose coordinates are exact."""
    return [
        low + (high - low) * shares[draw.whole(0, len(shares) - 1)] for low, high in zip(box.low, box.high, strict=True)
    ]


def _axis_ray(draw: Draw, point: list[float], axis: int, distance: float) -> Ray:
    """Along the axis through the point; the zeros of the direction have either sign."""
    sign = draw.sign()
    way = with_zeros(draw, axis, sign)
    start = list(point)
    start[axis] -= sign * distance
    return Ray((start[0], start[1], start[2]), way)


def along_axis(draw: Draw) -> Inputs:
    box = simple_box(draw)
    point = _on_grid(draw, box, (0.25, 0.5, 0.75))
    if draw.chance(0.3):
        box = Box(add(box.low, (20.0, 20.0, 20.0)), add(box.high, (20.0, 20.0, 20.0)))  # the ray passes it by
    return {"box": box, "ray": _axis_ray(draw, point, draw.whole(0, 2), 8.0)}


def along_face(draw: Draw) -> Inputs:
    """In the plane of a face, or along an edge."""
    box, axis = simple_box(draw), draw.whole(0, 2)
    point = _on_grid(draw, box, (0.5,))
    flush = [(axis + 1) % 3] if draw.chance(0.6) else [(axis + 1) % 3, (axis + 2) % 3]
    for other in flush:
        point[other] = (box.low, box.high)[draw.whole(0, 1)][other]
    return {"box": box, "ray": _axis_ray(draw, point, axis, 8.0)}


def flat(draw: Draw) -> Inputs:
    """Across it, slanted or straight, or in its plane."""
    axis = draw.whole(0, 2)
    box = flat_box(simple_box(draw), axis)
    if draw.chance(0.4):
        direction = draw.slanted(0.2)
        return {"box": box, "ray": Ray(rounded(add(within(draw, box), direction, -6.0)), direction)}
    along = axis if draw.chance(0.5) else (axis + 1) % 3
    return {"box": box, "ray": _axis_ray(draw, _on_grid(draw, box, (0.25, 0.5)), along, 8.0)}


def from_face(draw: Draw) -> Inputs:
    """The origin is on a face and the ray goes in, or runs along the face."""
    box, axis, sign = simple_box(draw), draw.whole(0, 2), draw.sign()
    point = _on_grid(draw, box, (0.25, 0.5, 0.75))
    point[axis] = (box.low if sign > 0 else box.high)[axis]
    along = axis if draw.chance(0.5) else (axis + 1) % 3
    if along != axis:
        sign = draw.sign()
    way = with_zeros(draw, along, sign)
    return {"box": box, "ray": Ray((point[0], point[1], point[2]), way)}
