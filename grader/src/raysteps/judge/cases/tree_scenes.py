"""Scenes that trees are built of: small and large surfaces, balls in a grid, many close together."""

from typing import TypeAlias

from raysteps.common.vectors import Vector, add
from raysteps.judge.protocol import Inputs
from raysteps.judge.random_source import RandomSource
from raysteps.judge.surfaces import Sphere, Surface, Surfaces, Triangle

Scene: TypeAlias = tuple[Surface, ...]

_REACH = 5.0
_FINE = 64  # coordinates are multiples of 1 / 64


def _neat(v: Vector) -> Vector:
    """Short to write, and exact."""
    return round(v[0] * _FINE) / _FINE, round(v[1] * _FINE) / _FINE, round(v[2] * _FINE) / _FINE


def ball(draw: RandomSource, place: Vector, reach: float, radius: tuple[int, int]) -> Sphere:
    """Near a place; the radius in 64ths."""
    return Sphere(_neat(add(place, draw.point(reach))), draw.whole(*radius) / _FINE)


def small_sphere(draw: RandomSource, low: float, high: float) -> Sphere:
    return ball(draw, (0.0, 0.0, 0.0), _REACH, (round(low * _FINE), round(high * _FINE)))


def _triangle(draw: RandomSource, reach: float) -> Triangle:
    shape, place = draw.triangle(reach), draw.point(_REACH - reach)
    return Triangle(_neat(add(place, shape.a)), _neat(add(place, shape.b)), _neat(add(place, shape.c)))


def small_scene(draw: RandomSource, spheres: int, triangles: int, *, largest: float = 0.6) -> Scene:
    """Small spheres, and triangles of all sizes."""
    surfaces: list[Surface] = [small_sphere(draw, 0.1, largest) for _ in range(spheres)]
    surfaces += [_triangle(draw, draw.real(0.5, 4.0)) for _ in range(triangles)]
    return tuple(surfaces)


def any_scene(draw: RandomSource) -> Scene:
    """Some dozens of surfaces, spheres for the most part."""
    return small_scene(draw, draw.whole(25, 40), draw.whole(4, 10))


def large_and_small(draw: RandomSource) -> Scene:
    """A shell around everything, a ground, and little things."""
    ground = Triangle((-20.0, -4.0, 20.0), (20.0, -4.0, 20.0), (0.0, -4.0, -30.0))
    return (Sphere((0.0, 0.0, 0.0), 12.0), ground, *small_scene(draw, 25, 2))


def dense_scene(draw: RandomSource) -> Scene:
    """Few rays get far in it."""
    return tuple(Sphere(draw.simple_point(5), draw.eighths(0.25, 0.75)) for _ in range(200))


SLOPE = Triangle((-8.0, -8.0, -8.0), (24.0, -8.0, 8.0), (-8.0, 24.0, 8.0))
BALLS = tuple(Sphere((4.0 * (i % 4) - 6, 4.0 * (i // 4 % 4) - 6, 4.0 * (i // 16) - 6), 0.75) for i in range(64))


def built(surfaces: Scene) -> Inputs:
    """What a function that builds a tree is given."""
    return {"surfaces": Surfaces(surfaces)}
