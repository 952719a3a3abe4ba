"""Cases of step 06 with whole scenes: building a tree."""

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.numbers import Vector, add
from raysteps.judge.surfaces import Sphere, Surface, Surfaces, Triangle
from raysteps.judge.trees import TREE
from raysteps.judge.values import Inputs

_REACH = 5.0
_FINE = 64  # coordinates are multiples of 1 / 64


def _neat(v: Vector) -> Vector:
    """Short to write, and exact."""
    return round(v[0] * _FINE) / _FINE, round(v[1] * _FINE) / _FINE, round(v[2] * _FINE) / _FINE


def _sphere(draw: Draw, low: float, high: float) -> Sphere:
    return Sphere(_neat(draw.point(_REACH)), draw.whole(round(low * _FINE), round(high * _FINE)) / _FINE)


def _triangle(draw: Draw, reach: float) -> Triangle:
    shape, place = draw.triangle(reach), draw.point(_REACH - reach)
    return Triangle(_neat(add(place, shape.a)), _neat(add(place, shape.b)), _neat(add(place, shape.c)))


def small_scene(draw: Draw, spheres: int, triangles: int, *, largest: float = 0.6) -> tuple[Surface, ...]:
    """Small spheres, and triangles of all sizes."""
    surfaces: list[Surface] = [_sphere(draw, 0.1, largest) for _ in range(spheres)]
    surfaces += [_triangle(draw, draw.real(0.5, 4.0)) for _ in range(triangles)]
    return tuple(surfaces)


def _scene(surfaces: tuple[Surface, ...]) -> Inputs:
    return {"surfaces": Surfaces(surfaces)}


def _in_one_place(draw: Draw) -> Inputs:
    sphere = _sphere(draw, 0.5, 2)
    return _scene((sphere,) * draw.whole(9, 12))


def _in_one_plane(draw: Draw) -> Inputs:
    height = draw.eighths(-2, 2)
    row: list[Surface] = []
    for i in range(30):
        x, y = float(i % 6), float(i // 6)
        row.append(Triangle((x, y, height), (x + 0.75, y, height), (x, y + 0.75, height)))
    return _scene(tuple(row))


def large_and_small(draw: Draw) -> tuple[Surface, ...]:
    """A shell around everything, a ground, and little things."""
    ground = Triangle((-20.0, -4.0, 20.0), (20.0, -4.0, 20.0), (0.0, -4.0, -30.0))
    return (Sphere((0.0, 0.0, 0.0), 12.0), ground, *small_scene(draw, 25, 2))


def _far_away(draw: Draw) -> Inputs:
    """All on one side of the centre of the world."""
    sign = draw.sign()
    away = (sign * 64.0, sign * 80.0, sign * 100.0)
    moved = [Sphere(add(s.center, away), s.radius) for s in (_sphere(draw, 0.1, 0.6) for _ in range(25))]
    return _scene(tuple(moved))


def _on_walls(draw: Draw) -> Inputs:
    """A grid of balls whose middle ones are cut by the walls between the boxes; the box of all is a cube."""
    radius = draw.whole(8, 40) / 64
    row = (-3.0, -1.5, 0.0, 1.5, 3.0)
    column = row[:: draw.whole(1, 2)]
    return _scene(tuple(Sphere((x, y, z), radius) for x in row for y in row for z in column))


BUILD_OCTREE = Function(
    "build_octree",
    TREE,
    (
        Group("spheres and triangles", lambda d: _scene(small_scene(d, 30, 8))),
        Group("many small spheres", lambda d: _scene(small_scene(d, 110, 0, largest=0.3)), saves=True),
        Group("large ones among small ones", lambda d: _scene(large_and_small(d))),
        Group("all in one place", _in_one_place),
        Group("all in one plane", _in_one_plane),
        Group("far from the centre of the world", _far_away),
        Group("on the walls between the boxes", _on_walls),
        Group("a single surface", lambda d: _scene(small_scene(d, 1, 0) if d.chance(0.5) else small_scene(d, 0, 1))),
        Group("no surfaces", lambda d: _scene(()), telling=False),
    ),
)
