"""Surfaces as the judge gives them to a function, alone or in a list."""

import math
from dataclasses import dataclass

from raysteps.common.vectors import Vector, add, cross, dot, minus
from raysteps.judge.protocol import Fill, Number, Ray, text, vector_words

_MAX_IN_WORDS = 12


@dataclass(frozen=True)
class Sphere:
    center: Vector
    radius: float
    fill: Fill | None = None  # in a list the worker gives out the fills
    glass: bool = False  # in a list: lets light pass

    def numbers(self) -> list[Number]:
        return [*self.center, self.radius, *(self.fill.numbers() if self.fill else [])]

    def words(self) -> str:
        fill = f" {self.fill.words()}" if self.fill else ""
        return f"{'glass ' * self.glass}sphere at {vector_words(self.center)} radius {text(self.radius)}{fill}"


@dataclass(frozen=True)
class Triangle:
    a: Vector
    b: Vector
    c: Vector
    fill: Fill | None = None

    def numbers(self) -> list[Number]:
        return [*self.a, *self.b, *self.c, *(self.fill.numbers() if self.fill else [])]

    def at(self, u: float, v: float) -> Vector:
        """The point a + u (b - a) + v (c - a)."""
        return add(add(self.a, minus(self.b, self.a), u), minus(self.c, self.a), v)

    def words(self) -> str:
        fill = f" {self.fill.words()}" if self.fill else ""
        return f"triangle {vector_words(self.a)} {vector_words(self.b)} {vector_words(self.c)}{fill}"


@dataclass(frozen=True)
class ScriptedSurface:
    """A surface that every ray hits at one distance, or none hits."""

    distance: float | None

    def numbers(self) -> list[Number]:
        return [] if self.distance is None else [self.distance]

    def words(self) -> str:
        return "a surface that is missed" if self.distance is None else f"a surface hit at {text(self.distance)}"


Surface = Sphere | Triangle | ScriptedSurface


def _kind(surface: Surface) -> int:
    if isinstance(surface, Sphere):
        return 4 if surface.glass else 0
    if isinstance(surface, Triangle):
        return 1
    return 3 if surface.distance is None else 2


@dataclass(frozen=True)
class Surfaces:
    """A list; surface number i, from 1, is known in an answer by its red, i / 256."""

    surfaces: tuple[Surface, ...]

    def numbers(self) -> list[Number]:
        numbers: list[Number] = [len(self.surfaces)]
        for surface in self.surfaces:
            numbers += [_kind(surface), *surface.numbers()]
        return numbers

    def words(self) -> str:
        shown = [f"{i}: {surface.words()}" for i, surface in enumerate(self.surfaces[:_MAX_IN_WORDS], 1)]
        left = len(self.surfaces) - len(shown)
        return "; ".join(shown) + (f"; and {left} more" if left else "") or "none"


# Where a ray meets a surface: for cases that have to know it before anybody is asked.


def _sphere_distance(sphere: Sphere, ray: Ray) -> float:
    from_center = minus(ray.origin, sphere.center)
    half = dot(from_center, ray.direction)
    inside = half * half - dot(from_center, from_center) + sphere.radius * sphere.radius
    if inside < 0:
        return math.inf
    nearer, farther = -half - math.sqrt(inside), -half + math.sqrt(inside)
    return nearer if nearer > 0 else farther if farther > 0 else math.inf


def _triangle_distance(t: Triangle, ray: Ray) -> float:
    along, across = minus(t.b, t.a), minus(t.c, t.a)
    p = cross(ray.direction, across)
    size = dot(along, p)
    if size == 0:
        return math.inf
    away = minus(ray.origin, t.a)
    u, q = dot(away, p) / size, cross(away, along)
    v, distance = dot(ray.direction, q) / size, dot(across, q) / size
    return distance if u >= 0 and v >= 0 and u + v <= 1 and distance > 0 else math.inf


def distance_to(surface: Surface, ray: Ray) -> float:
    """Infinite for a miss."""
    if isinstance(surface, Sphere):
        return _sphere_distance(surface, ray)
    if isinstance(surface, Triangle):
        return _triangle_distance(surface, ray)
    assert isinstance(surface, ScriptedSurface)
    return math.inf if surface.distance is None else surface.distance


def first_distance(surfaces: tuple[Surface, ...], ray: Ray) -> float:
    return min((distance_to(surface, ray) for surface in surfaces), default=math.inf)
