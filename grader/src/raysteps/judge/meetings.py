"""Where a ray meets a surface: for cases that have to know it before anybody is asked."""

import math

from raysteps.judge.numbers import cross, dot, minus
from raysteps.judge.surfaces import Scripted, Sphere, Surface, Triangle
from raysteps.judge.values import Ray


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
    assert isinstance(surface, Scripted)
    return math.inf if surface.distance is None else surface.distance


def first_distance(surfaces: tuple[Surface, ...], ray: Ray) -> float:
    return min((distance_to(surface, ray) for surface in surfaces), default=math.inf)
