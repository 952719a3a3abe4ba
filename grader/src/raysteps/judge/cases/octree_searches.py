"""Cases of step 06 with whole scenes: building a tree."""

from raysteps.judge.functions import Function, Group
from raysteps.judge.numbers import Vector, add, minus, rounded, times, unit
from raysteps.judge.octrees import TREE
from raysteps.judge.protocol import Inputs, Ray
from raysteps.judge.random_source import RandomSource
from raysteps.judge.searches import SEARCHES, Rays, WhoseTree
from raysteps.judge.surfaces import Scripted, Sphere, Surface, Surfaces, Triangle

_REACH = 5.0
_FINE = 64  # coordinates are multiples of 1 / 64


def _neat(v: Vector) -> Vector:
    """Short to write, and exact."""
    return round(v[0] * _FINE) / _FINE, round(v[1] * _FINE) / _FINE, round(v[2] * _FINE) / _FINE


def _sphere(draw: RandomSource, low: float, high: float) -> Sphere:
    return Sphere(_neat(draw.point(_REACH)), draw.whole(round(low * _FINE), round(high * _FINE)) / _FINE)


def _triangle(draw: RandomSource, reach: float) -> Triangle:
    shape, place = draw.triangle(reach), draw.point(_REACH - reach)
    return Triangle(_neat(add(place, shape.a)), _neat(add(place, shape.b)), _neat(add(place, shape.c)))


def small_scene(draw: RandomSource, spheres: int, triangles: int, *, largest: float = 0.6) -> tuple[Surface, ...]:
    """Small spheres, and triangles of all sizes."""
    surfaces: list[Surface] = [_sphere(draw, 0.1, largest) for _ in range(spheres)]
    surfaces += [_triangle(draw, draw.real(0.5, 4.0)) for _ in range(triangles)]
    return tuple(surfaces)


def _scene(surfaces: tuple[Surface, ...]) -> Inputs:
    return {"surfaces": Surfaces(surfaces)}


def _in_one_place(draw: RandomSource) -> Inputs:
    sphere = _sphere(draw, 0.5, 2)
    return _scene((sphere,) * draw.whole(9, 12))


def _in_one_plane(draw: RandomSource) -> Inputs:
    height = draw.eighths(-2, 2)
    row: list[Surface] = []
    for i in range(30):
        x, y = float(i % 6), float(i // 6)
        row.append(Triangle((x, y, height), (x + 0.75, y, height), (x, y + 0.75, height)))
    return _scene(tuple(row))


def large_and_small(draw: RandomSource) -> tuple[Surface, ...]:
    """A shell around everything, a ground, and little things."""
    ground = Triangle((-20.0, -4.0, 20.0), (20.0, -4.0, 20.0), (0.0, -4.0, -30.0))
    return (Sphere((0.0, 0.0, 0.0), 12.0), ground, *small_scene(draw, 25, 2))


def _far_away(draw: RandomSource) -> Inputs:
    """All on one side of the centre of the world."""
    sign = draw.sign()
    away = (sign * 64.0, sign * 80.0, sign * 100.0)
    moved = [Sphere(add(s.center, away), s.radius) for s in (_sphere(draw, 0.1, 0.6) for _ in range(25))]
    return _scene(tuple(moved))


def _on_walls(draw: RandomSource) -> Inputs:
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


# Cases of step 06 with whole scenes: searching a tree.


def point_within(draw: RandomSource, surface: Surface) -> Vector:
    """A point well within the surface's outline."""
    if isinstance(surface, Sphere):
        return add(surface.center, draw.direction(), 0.7 * surface.radius * draw.real(0, 1))
    assert not isinstance(surface, Scripted)
    return times(1 / 3, add(add(surface.a, surface.b), surface.c))


def aimed(draw: RandomSource, surfaces: tuple[Surface, ...], distance: float) -> Ray:
    """At one of the surfaces; something else may stand before it."""
    return draw.ray_towards(point_within(draw, surfaces[draw.whole(0, len(surfaces) - 1)]), distance)


def search(surfaces: tuple[Surface, ...], rays: list[Ray], *, own: bool) -> Inputs:
    return {"tree": WhoseTree(own), "surfaces": Surfaces(surfaces), "rays": Rays(tuple(rays))}


def _one_ray(draw: RandomSource, *, own: bool) -> Inputs:
    surfaces = small_scene(draw, draw.whole(25, 40), draw.whole(4, 10))
    ray = aimed(draw, surfaces, 15) if draw.chance(0.8) else draw.ray_towards(draw.point(9), 20)
    return search(surfaces, [ray], own=own)


def _from_inside(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 35, 8)
    origin = draw.point(4)
    way = minus(point_within(draw, surfaces[draw.whole(0, len(surfaces) - 1)]), origin)
    return search(surfaces, [Ray(origin, rounded(unit(way)))], own=draw.chance(0.5))


def _along_axis(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 35, 6)
    direction = draw.axis()
    target = point_within(draw, surfaces[draw.whole(0, 34)])
    return search(surfaces, [Ray(rounded(add(target, direction, -16)), direction)], own=draw.chance(0.5))


SLOPE = Triangle((-8.0, -8.0, -8.0), (24.0, -8.0, 8.0), (-8.0, 24.0, 8.0))
BALLS = tuple(Sphere((4.0 * (i % 4) - 6, 4.0 * (i // 4 % 4) - 6, 4.0 * (i // 16) - 6), 0.75) for i in range(64))

_EDGE = 6.75  # of the box around the balls


def _later_box(draw: RandomSource) -> Inputs:
    """A slanted triangle runs through near boxes and far ones; balls stand before and behind it."""
    return search((SLOPE, *BALLS), [draw.ray_towards(draw.point(6), 25)], own=draw.chance(0.5))


def _ball_before_the_slope(draw: RandomSource) -> Inputs:
    """A ray that comes down from above meets one of the balls there, and the slope behind it."""

    def make() -> tuple[Vector, Vector]:
        ball = BALLS[draw.whole(0, 63)]
        return ball.center, rounded(unit((draw.real(-0.6, 0.6), draw.real(-0.6, 0.6), -1.0)))

    def is_above(found: tuple[Vector, Vector]) -> bool:
        x, y, z = add(*found, 3.0)
        return z > (x + y) / 2

    center, direction = draw.until(is_above, make)
    return search((SLOPE, *BALLS), [Ray(rounded(add(center, direction, -25)), direction)], own=False)


def _eighth(point: Vector) -> int:
    """Of the space around 0, numbered as split does it."""
    return sum(1 << axis for axis, x in enumerate(point) if x > 0)


def _balls_in_a_row(draw: RandomSource) -> Inputs:
    """Through two of the balls, in any direction. The boxes along the ray come in another order than their numbers: who
    searches by number and stops at the first box behind a hit never comes to the near ball."""

    def make() -> tuple[Vector, Vector, Vector, Vector]:
        far, near = (BALLS[draw.whole(0, 63)].center for _ in range(2))
        direction = draw.slanted() if far == near else rounded(unit(add(minus(far, near), draw.point(0.3))))
        return far, near, direction, add(far, direction, draw.real(1, 5))

    def costs_a_hasty_search(found: tuple[Vector, Vector, Vector, Vector]) -> bool:
        far, near, _, beyond = found
        inside = max(abs(x) for x in beyond) < _EDGE
        return inside and _eighth(far) < _eighth(beyond) < _eighth(near)

    _, near, direction, _ = draw.until(costs_a_hasty_search, make)
    return search(BALLS, [Ray(rounded(add(near, direction, -25)), direction)], own=draw.chance(0.5))


def _looking_away(draw: RandomSource) -> Inputs:
    """Everything is behind the ray."""
    surfaces = small_scene(draw, 25, 6)
    direction = draw.direction()
    return search(surfaces, [Ray(rounded(times(draw.real(10, 20), direction)), direction)], own=draw.chance(0.5))


def _from_far(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 25, 6)
    return search(surfaces, [aimed(draw, surfaces, 100)], own=draw.chance(0.5))


def _over_a_ground(draw: RandomSource) -> Inputs:
    """Something large and many little things: rays that meet the one or the others."""
    surfaces = large_and_small(draw)
    ray = Ray(draw.point(4), draw.slanted()) if draw.chance(0.5) else aimed(draw, surfaces[2:], 7)
    return search(surfaces, [ray], own=True)


def _many_rays(draw: RandomSource) -> Inputs:
    surfaces = small_scene(draw, 200, 0, largest=0.3)
    return search(surfaces, [aimed(draw, surfaces, 16) for _ in range(24)], own=True)


CLOSEST_HIT_IN_OCTREE = Function(
    "closest_hit_in_octree",
    SEARCHES,
    (
        Group("in three levels of boxes", lambda d: _one_ray(d, own=False), telling=False),
        Group("in the tree of build_octree", lambda d: _one_ray(d, own=True), telling=False),
        Group("from inside", _from_inside),
        Group("along an axis", _along_axis),
        Group("a nearer hit in a later box", _later_box, telling=False),
        Group("from far away", _from_far),
        Group("everything behind the ray", _looking_away, telling=False),
        Group("a ball before a slope", _ball_before_the_slope),
        Group("one ball behind another", _balls_in_a_row),
        Group("large ones among small ones", _over_a_ground),
        Group("few surfaces are asked", _many_rays, saves=True),
        Group("no surfaces", lambda d: search((), [d.ray_towards((0.0, 0.0, 0.0), 5)], own=True), telling=False),
    ),
)
