"""Cases of step 06 with whole scenes: building a tree, and searching it."""

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.numbers import Vector, add, minus, rounded, times, unit
from raysteps.judge.searches import SEARCHES, Rays, WhoseTree
from raysteps.judge.surfaces import Scripted, Sphere, Surface, Surfaces, Triangle
from raysteps.judge.trees import TREE
from raysteps.judge.values import Inputs, Ray

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


def _large_and_small(draw: Draw) -> Inputs:
    """A shell around everything, a ground, and little things."""
    ground = Triangle((-20.0, -4.0, 20.0), (20.0, -4.0, 20.0), (0.0, -4.0, -30.0))
    return _scene((Sphere((0.0, 0.0, 0.0), 12.0), ground, *small_scene(draw, 25, 2)))


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


def _target(draw: Draw, surface: Surface) -> Vector:
    """A point well within the surface's outline."""
    if isinstance(surface, Sphere):
        return add(surface.center, draw.direction(), 0.7 * surface.radius * draw.real(0, 1))
    assert not isinstance(surface, Scripted)
    return times(1 / 3, add(add(surface.a, surface.b), surface.c))


def _aimed(draw: Draw, surfaces: tuple[Surface, ...], distance: float) -> Ray:
    """At one of the surfaces; something else may stand before it."""
    return draw.ray_towards(_target(draw, surfaces[draw.whole(0, len(surfaces) - 1)]), distance)


def _search(surfaces: tuple[Surface, ...], rays: list[Ray], *, own: bool) -> Inputs:
    return {"tree": WhoseTree(own), "surfaces": Surfaces(surfaces), "rays": Rays(tuple(rays))}


def _one_ray(draw: Draw, *, own: bool) -> Inputs:
    surfaces = small_scene(draw, draw.whole(25, 40), draw.whole(4, 10))
    ray = _aimed(draw, surfaces, 15) if draw.chance(0.8) else draw.ray_towards(draw.point(9), 20)
    return _search(surfaces, [ray], own=own)


def _from_inside(draw: Draw) -> Inputs:
    surfaces = small_scene(draw, 35, 8)
    origin = draw.point(4)
    way = minus(_target(draw, surfaces[draw.whole(0, len(surfaces) - 1)]), origin)
    return _search(surfaces, [Ray(origin, rounded(unit(way)))], own=draw.chance(0.5))


def _along_axis(draw: Draw) -> Inputs:
    surfaces = small_scene(draw, 35, 6)
    direction = draw.axis()
    target = _target(draw, surfaces[draw.whole(0, 34)])
    return _search(surfaces, [Ray(rounded(add(target, direction, -16)), direction)], own=draw.chance(0.5))


def _looking_away(draw: Draw) -> Inputs:
    """Everything is behind the ray."""
    surfaces = small_scene(draw, 25, 6)
    direction = draw.direction()
    return _search(surfaces, [Ray(rounded(times(draw.real(10, 20), direction)), direction)], own=draw.chance(0.5))


def _from_far(draw: Draw) -> Inputs:
    surfaces = small_scene(draw, 25, 6)
    return _search(surfaces, [_aimed(draw, surfaces, 100)], own=draw.chance(0.5))


def _later_box(draw: Draw) -> Inputs:
    """A slanted triangle runs through near boxes and far ones; balls stand before and behind it."""
    slope = Triangle((-8.0, -8.0, -8.0), (24.0, -8.0, 8.0), (-8.0, 24.0, 8.0))
    balls = [Sphere((4.0 * (i % 4) - 6, 4.0 * (i // 4 % 4) - 6, 4.0 * (i // 16) - 6), 0.75) for i in range(64)]
    return _search((slope, *balls), [draw.ray_towards(draw.point(6), 25)], own=draw.chance(0.5))


def _many_rays(draw: Draw) -> Inputs:
    surfaces = small_scene(draw, 200, 0, largest=0.3)
    return _search(surfaces, [_aimed(draw, surfaces, 16) for _ in range(24)], own=True)


BUILD_OCTREE = Function(
    "build_octree",
    TREE,
    (
        Group("spheres and triangles", lambda d: _scene(small_scene(d, 30, 8))),
        Group("many small spheres", lambda d: _scene(small_scene(d, 110, 0, largest=0.3)), saves=True),
        Group("large ones among small ones", _large_and_small),
        Group("all in one place", _in_one_place),
        Group("all in one plane", _in_one_plane),
        Group("far from the centre of the world", _far_away),
        Group("on the walls between the boxes", _on_walls),
        Group("a single surface", lambda d: _scene(small_scene(d, 1, 0) if d.chance(0.5) else small_scene(d, 0, 1))),
        Group("no surfaces", lambda d: _scene(()), telling=False),
    ),
)

CLOSEST_HIT_IN = Function(
    "closest_hit_in",
    SEARCHES,
    (
        Group("in three levels of boxes", lambda d: _one_ray(d, own=False), telling=False),
        Group("in the tree of build_octree", lambda d: _one_ray(d, own=True), telling=False),
        Group("from inside", _from_inside),
        Group("along an axis", _along_axis),
        Group("a nearer hit in a later box", _later_box, telling=False),
        Group("from far away", _from_far),
        Group("everything behind the ray", _looking_away, telling=False),
        Group("few surfaces are asked", _many_rays, saves=True),
        Group("no surfaces", lambda d: _search((), [d.ray_towards((0.0, 0.0, 0.0), 5)], own=True), telling=False),
    ),
)
