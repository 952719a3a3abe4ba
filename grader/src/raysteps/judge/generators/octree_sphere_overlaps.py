"""Cases of step 06: does a sphere touch a box?"""

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.octree_overlaps import TOUCHING, around, beyond, flattened
from raysteps.judge.numbers import add, rounded, unit
from raysteps.judge.surfaces import Sphere
from raysteps.judge.values import Box, Inputs


def _sphere_on(draw: Draw, radius: tuple[float, float], size: tuple[float, float]) -> Inputs:
    """A box around a point of the sphere's skin."""
    sphere = Sphere(draw.point(3), draw.real(*radius))
    point = add(sphere.center, draw.direction(), sphere.radius)
    return {"sphere": sphere, "box": around(draw, point, *size)}


def _sphere_far(draw: Draw) -> Inputs:
    sphere = Sphere(draw.point(3), draw.real(0.2, 2))
    return {"sphere": sphere, "box": beyond(draw, sphere.center, sphere.radius)}


def _sphere_within(draw: Draw) -> Inputs:
    sphere = Sphere(draw.point(3), draw.real(0.1, 0.5))
    low, high = (add(sphere.center, (1.0, 1.0, 1.0), side * draw.real(1, 3)) for side in (-1, 1))
    return {"sphere": sphere, "box": Box(rounded(low), rounded(high))}


def _just_touching(draw: Draw) -> Inputs:
    """A face, an edge or a corner of the box is a little within the sphere, and the rest of it outside."""
    sphere, size = Sphere(draw.point(2), draw.real(0.5, 3)), draw.real(0.3, 1)
    signs = [float(draw.whole(-1, 1)) for _ in range(3)]
    way = (signs[0], signs[1], signs[2]) if any(signs) else draw.axis()
    nearest = add(sphere.center, unit(way), 0.98 * sphere.radius)
    low = [x - (size if sign <= 0 else 0.0) for x, sign in zip(nearest, way, strict=True)]
    high = [x + (size if sign >= 0 else 0.0) for x, sign in zip(nearest, way, strict=True)]
    return {"sphere": sphere, "box": Box(rounded((low[0], low[1], low[2])), rounded((high[0], high[1], high[2])))}


def _sphere_flat(draw: Draw) -> Inputs:
    """The box is flat and runs through the sphere well within its outline."""
    sphere = Sphere(draw.point(2), draw.real(1, 3))
    point = add(sphere.center, draw.direction(), 0.5 * sphere.radius)
    box = around(draw, point, 3 * sphere.radius, 4 * sphere.radius)
    return {"sphere": sphere, "box": flattened(draw, box, point)}


def _sphere_mixed(draw: Draw) -> Inputs:
    return _sphere_on(draw, (0.3, 3), (0.3, 2)) if draw.chance(0.3) else _sphere_far(draw)


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
