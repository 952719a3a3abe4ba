"""Cases of step 04: hits, lights, and things in the way of a light or beside it."""

from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector, add, cross, length, minus, rounded, times, unit
from raysteps.judge.surfaces import Sphere, Surface, Surfaces, Triangle
from raysteps.judge.values import Hit, Inputs, Light


def hit_at(position: Vector, normal: Vector) -> Hit:
    return Hit(rounded(position), rounded(normal), rounded(times(-1.0, normal)))


def any_hit(draw: Draw, reach: float = 3.0) -> Hit:
    return hit_at(draw.point(reach), draw.direction())


def light_above(draw: Draw, hit: Hit, near: float, far: float) -> Light:
    return Light(rounded(add(hit.position, draw.above(hit.normal, 0.25, 1.0), draw.real(near, far))))


def scene(surfaces: list[Surface], hit: Hit, light: Light) -> Inputs:
    return {"surfaces": Surfaces(tuple(surfaces)), "hit": hit, "light": light}


def _between(draw: Draw, hit: Hit, light: Light, low: float, high: float) -> Vector:
    """A point on the way to the light."""
    return add(hit.position, minus(light.position, hit.position), draw.real(low, high))


def sideways(draw: Draw, hit: Hit, light: Light) -> Vector:
    way = unit(minus(light.position, hit.position))
    return unit(cross(way, draw.across(way)))


def ball(draw: Draw, hit: Hit, light: Light, *, blocks: bool) -> Sphere:
    """In the way of the light, or clearly beside it."""
    gap = length(minus(light.position, hit.position))
    radius = draw.real(0.1, 0.3) * gap
    off = draw.real(0.0, 0.7) if blocks else draw.real(1.2, 2.0)
    place = add(_between(draw, hit, light, 0.4, 0.6), sideways(draw, hit, light), off * radius)
    return Sphere(rounded(place), radius)


def _board(draw: Draw, hit: Hit, light: Light, *, blocks: bool) -> Triangle:
    """Around a point on the way, or clearly beside it."""
    gap = length(minus(light.position, hit.position))
    way = unit(minus(light.position, hit.position))
    side, size = sideways(draw, hit, light), draw.real(0.2, 0.6) * gap
    other = cross(way, side)
    middle = _between(draw, hit, light, 0.3, 0.7)
    if not blocks:
        middle = add(middle, side, 1.4 * size)
    corners = [
        add(middle, side, size),
        add(add(middle, side, -0.6 * size), other, size),
        add(add(middle, side, -0.6 * size), other, -size),
    ]
    tilted = [add(corner, way, draw.real(-0.1, 0.1) * gap) for corner in corners]
    return Triangle(rounded(tilted[0]), rounded(tilted[1]), rounded(tilted[2]))


def several(draw: Draw, hit: Hit, light: Light, *, blocked: bool) -> list[Surface]:
    """Several beside the way, and one in it where the light is blocked."""
    things: list[Surface] = []
    for _ in range(draw.whole(1, 3)):
        make = ball if draw.chance(0.5) else _board
        things.append(make(draw, hit, light, blocks=False))
    if blocked:
        make = ball if draw.chance(0.5) else _board
        things.insert(draw.whole(0, len(things)), make(draw, hit, light, blocks=True))
    return things
