"""Makes up scenes: spheres and triangles above a ground, two lights."""

from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector, add

_HEAD = """b 0.35 0.5 0.8
v
from {from_} 4.5 13
at 0 1.5 0
up 0 1 0
angle 40
hither 0.01
resolution 120 90
l 7 11 8 1.1 1.05 1
l -8 9 5 0.5 0.55 0.6
f 0.6 0.6 0.55 0.8 0 1 0 1
p 4
-40 -0.5 40
40 -0.5 40
40 -0.5 -40
-40 -0.5 -40
"""
_WIDE = 4.5  # half the width of the part of the world that is filled


def _fill(draw: Draw) -> str:
    r, g, b = draw.color(0.2, 1.0)
    ks = draw.real(0.1, 0.5) if draw.chance(0.5) else 0.0
    return f"f {r:.4g} {g:.4g} {b:.4g} 0.7 {ks:.4g} {draw.whole(3, 30)} 0 1"


def _place(draw: Draw) -> Vector:
    return draw.real(-_WIDE, _WIDE), draw.real(0.2, _WIDE), draw.real(-_WIDE, _WIDE)


def _triangle(draw: Draw, place: Vector, size: float) -> list[str]:
    shape = draw.triangle(1.0)
    corners = [add(place, corner, size) for corner in (shape.a, shape.b, shape.c)]
    return ["p 3", *(" ".join(f"{x:.6g}" for x in corner) for corner in corners)]


def random_scene(draw: Draw, spheres: int, triangles: int) -> str:
    """The more there is, the smaller it is: about the same part of the picture is filled."""
    size = 2.2 / (spheres + triangles + 1) ** (1 / 3)
    lines = [_HEAD.format(from_=f"{draw.real(-3, 3):.4g}").rstrip("\n")]
    for _ in range(spheres):
        x, y, z = _place(draw)
        lines += [_fill(draw), f"s {x:.6g} {y:.6g} {z:.6g} {size * draw.real(0.4, 1):.6g}"]
    for _ in range(triangles):
        lines += [_fill(draw), *_triangle(draw, _place(draw), 1.6 * size)]
    return "\n".join(lines) + "\n"
