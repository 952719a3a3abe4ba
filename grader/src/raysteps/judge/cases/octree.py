"""Cases of step 06: overlaps with a box, scenes of which a tree is built, and all functions of the step."""

from raysteps.common.vectors import Vector, add, cross, times, unit
from raysteps.judge.answers import Answer
from raysteps.judge.cases.octree_boxes import BOUNDS_OF, CLIP, SPLIT
from raysteps.judge.cases.octree_searches import CLOSEST_HIT_IN_OCTREE, OCCLUDED_IN_OCTREE
from raysteps.judge.cases.tree_cases import ball, built, large_and_small, small_scene, small_sphere
from raysteps.judge.functions import Function, Group
from raysteps.judge.octrees import OCTREE
from raysteps.judge.protocol import Box, Inputs, f32, rounded
from raysteps.judge.random_source import RandomSource
from raysteps.judge.surfaces import Sphere, Surface, Triangle


def _touching_problem(_inputs: Inputs, expected: bool, actual: bool) -> str:
    if expected == actual:
        return ""
    return "they touch, and the answer is no" if expected else "they do not touch, and the answer is yes"


TOUCHING = Answer(lambda tokens: tokens.flag(), lambda answer: str(answer).lower(), _touching_problem)


def around(draw: RandomSource, point: Vector, smallest: float, largest: float) -> Box:
    """A box that holds the point, which is well within."""
    sizes = [draw.real(smallest, largest) for _ in range(3)]
    low = [x - draw.real(0.1, 0.9) * size for x, size in zip(point, sizes, strict=True)]
    return Box(rounded((low[0], low[1], low[2])), rounded((low[0] + sizes[0], low[1] + sizes[1], low[2] + sizes[2])))


def beyond(draw: RandomSource, middle: Vector, reach: float) -> Box:
    """Clearly beyond the bounds of something, along one axis at least."""
    way = draw.axis()
    size = (draw.real(0.3, 2), draw.real(0.3, 2), draw.real(0.3, 2))
    away = add(add(middle, way, reach + 1.0 + draw.real(0.5, 3)), draw.point(0.5))
    return _box(away, size)


def _box(middle: Vector, size: Vector) -> Box:
    return Box(rounded(add(middle, size, -0.5)), rounded(add(middle, size, 0.5)))


def flattened(draw: RandomSource, box: Box, point: Vector) -> Box:
    """Without thickness along one axis, where it still holds the point."""
    axis = draw.whole(0, 2)
    low, high = list(box.low), list(box.high)
    low[axis] = high[axis] = point[axis]
    return Box(rounded((low[0], low[1], low[2])), rounded((high[0], high[1], high[2])))


# Cases of step 06: does a sphere touch a box?


def _sphere_on(draw: RandomSource, radius: tuple[float, float], size: tuple[float, float]) -> Inputs:
    """A box around a point of the sphere's skin."""
    sphere = Sphere(draw.point(3), draw.real(*radius))
    point = add(sphere.center, draw.direction(), sphere.radius)
    return {"sphere": sphere, "box": around(draw, point, *size)}


def _sphere_far(draw: RandomSource) -> Inputs:
    sphere = Sphere(draw.point(3), draw.real(0.2, 2))
    make = beyond if draw.chance(0.5) else _just_beyond
    return {"sphere": sphere, "box": make(draw, sphere.center, sphere.radius)}


def _just_beyond(draw: RandomSource, middle: Vector, reach: float) -> Box:
    """A face is a little beyond the bounds of something; a ball around the box would reach them."""
    side = draw.real(1, 2)
    away = add(add(middle, draw.axis(), reach + side / 2 + draw.real(0.05, 0.2)), draw.point(0.02))
    return _box(away, (side, side, side))


def _sphere_within(draw: RandomSource) -> Inputs:
    sphere = Sphere(draw.point(3), draw.real(0.1, 0.5))
    low, high = (add(sphere.center, (1.0, 1.0, 1.0), side * draw.real(1, 3)) for side in (-1, 1))
    return {"sphere": sphere, "box": Box(rounded(low), rounded(high))}


def _just_touching(draw: RandomSource) -> Inputs:
    """A face, an edge or a corner of the box is a little within the sphere, and the rest of it outside."""
    sphere, size = Sphere(draw.point(2), draw.real(0.5, 3)), draw.real(0.3, 1)
    signs = [float(draw.whole(-1, 1)) for _ in range(3)]
    way = (signs[0], signs[1], signs[2]) if any(signs) else draw.axis()
    nearest = add(sphere.center, unit(way), 0.98 * sphere.radius)
    low = [x - (size if sign <= 0 else 0.0) for x, sign in zip(nearest, way, strict=True)]
    high = [x + (size if sign >= 0 else 0.0) for x, sign in zip(nearest, way, strict=True)]
    return {"sphere": sphere, "box": Box(rounded((low[0], low[1], low[2])), rounded((high[0], high[1], high[2])))}


def _sphere_flat(draw: RandomSource) -> Inputs:
    """The box is flat and runs through the sphere well within its outline."""
    sphere = Sphere(draw.point(2), draw.real(1, 3))
    point = add(sphere.center, draw.direction(), 0.5 * sphere.radius)
    box = around(draw, point, 3 * sphere.radius, 4 * sphere.radius)
    return {"sphere": sphere, "box": flattened(draw, box, point)}


def _sphere_mixed(draw: RandomSource) -> Inputs:
    return _sphere_on(draw, (0.3, 3), (0.3, 2)) if draw.chance(0.5) else _sphere_far(draw)


SPHERE_OVERLAPS = Function(
    "Sphere::overlaps",
    TOUCHING,
    (
        Group("touching or far apart", _sphere_mixed),
        Group("through the box", lambda d: _sphere_on(d, (0.3, 3), (0.3, 2))),
        Group("much larger than the box", lambda d: _sphere_on(d, (10, 30), (0.3, 2))),
        Group("within the box", _sphere_within),
        Group("just touching", _just_touching),
        Group("flat boxes", _sphere_flat, exact=True),
        Group("far apart", _sphere_far),
    ),
    yes_or_no=True,
)


# Cases of step 06: does a triangle touch a box?


def _triangle_at(draw: RandomSource, u: float, v: float, size: tuple[float, float]) -> Inputs:
    """A box around the point a + u (b - a) + v (c - a)."""
    t = draw.triangle(4.0)
    return {"triangle": t, "box": around(draw, t.at(u, v), *size)}


def _triangle_inner(draw: RandomSource, size: tuple[float, float]) -> Inputs:
    u = draw.real(0.1, 0.7)
    return _triangle_at(draw, u, draw.real(0.1, 0.9 - u), size)


def _triangle_far(draw: RandomSource) -> Inputs:
    t = draw.triangle(2.0)
    middle = times(1 / 3, add(add(t.a, t.b), t.c))
    return {"triangle": t, "box": beyond(draw, middle, 4.0)}


def _triangle_mixed(draw: RandomSource) -> Inputs:
    return _triangle_inner(draw, (0.3, 2)) if draw.chance(0.5) else _triangle_far(draw)


def _triangle_flat(draw: RandomSource) -> Inputs:
    """A flat box that the triangle runs through."""
    t, u = draw.triangle(4.0), draw.real(0.3, 0.4)
    point = add(add(times(u, t.b), times(0.3, t.c)), times(0.7 - u, t.a))
    return {"triangle": t, "box": flattened(draw, around(draw, point, 0.5, 2), point)}


def _thin(draw: RandomSource) -> Inputs:
    """A long thin triangle through a box; all of its corners are outside."""
    middle, along = draw.point(2), draw.direction()
    side = unit(cross(along, draw.across(along)))
    a, b = add(middle, along, -draw.real(4, 9)), add(middle, along, draw.real(4, 9))
    t = Triangle(rounded(a), rounded(b), rounded(add(a, side, draw.real(0.02, 0.1))))
    return {"triangle": t, "box": around(draw, times(1 / 3, add(add(t.a, t.b), t.c)), 0.3, 1.5)}


def _corner_touches(draw: RandomSource) -> Inputs:
    """One corner of the triangle is a little inside the box, the rest of it leads away."""
    box = around(draw, draw.point(2), 0.5, 2)
    way = draw.axis()
    inner = [low + (high - low) * draw.real(0.2, 0.8) for low, high in zip(box.low, box.high, strict=True)]
    tip = [
        (low + 0.02 if sign < 0 else high - 0.02) if sign else x
        for low, high, x, sign in zip(box.low, box.high, inner, way, strict=True)
    ]
    ends = [add(add((tip[0], tip[1], tip[2]), way, draw.real(1, 3)), draw.above(way, 0.3), 2.0) for _ in range(2)]
    t = Triangle(rounded((tip[0], tip[1], tip[2])), rounded(ends[0]), rounded(ends[1]))
    return {"triangle": t, "box": box}


def _in_face(draw: RandomSource) -> Inputs:
    """In the plane of a face, and wider than it: exact numbers."""
    low = draw.simple_point(3)
    size = (float(draw.whole(1, 3)), float(draw.whole(1, 3)), float(draw.whole(1, 3)))
    box, axis = Box(low, add(low, size)), draw.whole(0, 2)
    height = (box.low, box.high)[draw.whole(0, 1)][axis]

    def corner(u: float, v: float) -> Vector:
        place = [height, height, height]
        place[(axis + 1) % 3], place[(axis + 2) % 3] = low[(axis + 1) % 3] + u, low[(axis + 2) % 3] + v
        return place[0], place[1], place[2]

    return {"triangle": Triangle(corner(-8.0, -8.0), corner(24.0, -8.0), corner(-8.0, 24.0)), "box": box}


def _all_within(draw: RandomSource) -> Inputs:
    t = draw.triangle(1.0)
    return {"triangle": t, "box": Box((f32(-1.2), -2.0, f32(-1.1)), (2.0, 1.5, f32(1.3)))}


TRIANGLE_OVERLAPS = Function(
    "Triangle::overlaps",
    TOUCHING,
    (
        Group("touching or far apart", _triangle_mixed),
        Group("all corners outside the box", lambda d: _triangle_inner(d, (0.1, 0.3))),
        Group("around a corner", lambda d: _triangle_at(d, 0.0, 0.0, (0.2, 1))),
        Group("around a point of an edge", lambda d: _triangle_at(d, d.real(0.1, 0.9), 0.0, (0.1, 0.5))),
        Group("within the box", _all_within),
        Group("long and thin", _thin),
        Group("just touching with a corner", _corner_touches),
        Group("flat boxes", _triangle_flat, exact=True),
        Group("in the plane of a face", _in_face, exact=True),
        Group("far apart", _triangle_far),
    ),
    yes_or_no=True,
)


# Cases of step 06: scenes of which a tree is built.


def _in_one_place(draw: RandomSource) -> Inputs:
    sphere = small_sphere(draw, 0.5, 2)
    return built((sphere,) * draw.whole(9, 12))


def _in_one_plane(draw: RandomSource) -> Inputs:
    height = draw.eighths(-2, 2)
    row: list[Surface] = []
    for i in range(30):
        x, y = float(i % 6), float(i // 6)
        row.append(Triangle((x, y, height), (x + 0.75, y, height), (x, y + 0.75, height)))
    return built(tuple(row))


def _far_away(draw: RandomSource) -> Inputs:
    """All on one side of the centre of the world."""
    sign = draw.sign()
    away = (sign * 64.0, sign * 80.0, sign * 100.0)
    moved = [Sphere(add(s.center, away), s.radius) for s in (small_sphere(draw, 0.1, 0.6) for _ in range(25))]
    return built(tuple(moved))


def _on_walls(draw: RandomSource) -> Inputs:
    """A grid of balls whose middle ones are cut by the walls between the boxes; the box of all is a cube."""
    radius = draw.whole(8, 40) / 64
    row = (-3.0, -1.5, 0.0, 1.5, 3.0)
    column = row[:: draw.whole(1, 2)]
    return built(tuple(Sphere((x, y, z), radius) for x in row for y in row for z in column))


def _heap(draw: RandomSource) -> Inputs:
    """Tiny things close together in a large scene: a tree that splits until lists are short goes down eight levels and
    more to tell them apart."""
    place = (draw.sign() * draw.real(20, 60), draw.sign() * draw.real(20, 60), draw.sign() * draw.real(20, 60))
    others = (ball(draw, (0.0, 0.0, 0.0), 64, (64, 256)) for _ in range(draw.whole(6, 12)))
    heap = (ball(draw, place, 0.5, (1, 4)) for _ in range(draw.whole(25, 40)))
    return built((*others, *heap))


BUILD_OCTREE = Function(
    "build_octree",
    OCTREE,
    (
        Group("spheres and triangles", lambda d: built(small_scene(d, 30, 8))),
        Group("many small spheres", lambda d: built(small_scene(d, 110, 0, largest=0.3)), saves=True),
        Group("large ones among small ones", lambda d: built(large_and_small(d))),
        Group("all in one place", _in_one_place),
        Group("all in one plane", _in_one_plane),
        Group("far from the centre of the world", _far_away),
        Group("on the walls between the boxes", _on_walls),
        Group("a heap of tiny ones in a large scene", _heap),
        Group("a single surface", lambda d: built(small_scene(d, 1, 0) if d.chance(0.5) else small_scene(d, 0, 1))),
        Group("no surfaces", lambda d: built(())),
    ),
)


FUNCTIONS = (
    CLIP,
    SPHERE_OVERLAPS,
    TRIANGLE_OVERLAPS,
    BOUNDS_OF,
    SPLIT,
    BUILD_OCTREE,
    CLOSEST_HIT_IN_OCTREE,
    OCCLUDED_IN_OCTREE,
)
