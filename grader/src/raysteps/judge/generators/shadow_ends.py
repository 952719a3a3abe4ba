"""Cases of step 04: things close to one of the two ends of a shadow ray."""

from raysteps.judge.drawing import Draw
from raysteps.judge.generators.shadow_blockers import any_hit, light_above, scene
from raysteps.judge.numbers import add, length, minus, rounded, unit
from raysteps.judge.surfaces import Sphere
from raysteps.judge.values import Inputs, Light


def pebble(draw: Draw) -> Inputs:
    """Little, and close to the surface: a threshold of its height would lose it."""
    hit = any_hit(draw)
    light = Light(rounded(add(hit.position, draw.above(hit.normal, 0.97, 1.0), draw.real(5, 15))))
    way = unit(minus(light.position, hit.position))
    return scene([Sphere(rounded(add(hit.position, way, draw.real(0.05, 0.08))), 0.02)], hit, light)


def other_side(draw: Draw) -> Inputs:
    """Behind the surface of the hit, opposite to the light."""
    hit = any_hit(draw)
    light = light_above(draw, hit, 2, 10)
    way = unit(minus(light.position, hit.position))
    radius = draw.real(0.3, 2)
    return scene([Sphere(rounded(add(hit.position, way, -radius - draw.real(0.2, 3))), radius)], hit, light)


def behind_light(draw: Draw) -> Inputs:
    """On the way, but beyond the light."""
    hit = any_hit(draw)
    light = light_above(draw, hit, 2, 10)
    way = minus(light.position, hit.position)
    radius = draw.real(0.3, 2)
    distance = 1 + (radius + draw.real(0.1, 1)) / length(way)
    return scene([Sphere(rounded(add(hit.position, way, distance)), radius)], hit, light)


def before_light(draw: Draw) -> Inputs:
    """Ends close before the light, or begins close behind it."""
    hit = any_hit(draw)
    light = light_above(draw, hit, 4, 12)
    way = unit(minus(light.position, hit.position))
    radius = draw.real(0.3, 1)
    gap = (radius + draw.real(0.03, 0.1)) * draw.sign()
    return scene([Sphere(rounded(add(light.position, way, gap)), radius)], hit, light)


def light_in_shell(draw: Draw) -> Inputs:
    """A ball around the light is in its way."""
    hit = any_hit(draw)
    light = light_above(draw, hit, 4, 12)
    center = add(light.position, draw.direction(), draw.real(0.0, 0.3))
    return scene([Sphere(rounded(center), draw.real(0.5, 2))], hit, light)
