"""Cases of step 04: does the surface that a hit lies on hide the light?"""

from dataclasses import replace

from raysteps.judge.drawing import Draw
from raysteps.judge.generators.shadow_blockers import hit_at, light_above, scene
from raysteps.judge.numbers import add, cross, minus, rounded, times, unit
from raysteps.judge.surfaces import Sphere, Triangle
from raysteps.judge.values import Inputs, Light


def own_ball(draw: Draw) -> Inputs:
    """The hit lies on the ball up to float's rounding, a little above or below."""
    center = add((50.0, -40.0, 30.0), draw.point(5))
    ball = Sphere(rounded(center), draw.real(0.5, 4))
    normal = draw.direction()
    hit = hit_at(add(ball.center, normal, ball.radius), normal)
    return scene([ball], hit, light_above(draw, hit, 8, 20))


def own_triangle(draw: Draw) -> Inputs:
    shape, place = draw.triangle(8.0), (60.0, -50.0, 40.0)
    floor = Triangle(rounded(add(place, shape.a)), rounded(add(place, shape.b)), rounded(add(place, shape.c)))
    edges = minus(floor.b, floor.a), minus(floor.c, floor.a)
    u = draw.real(0.1, 0.7)
    point = add(add(floor.a, edges[0], u), edges[1], draw.real(0.1, 0.9 - u))
    hit = hit_at(point, times(draw.sign(), unit(cross(*edges))))
    return scene([floor], hit, light_above(draw, hit, 8, 20))


def hollow_ball(draw: Draw) -> Inputs:
    """The hit is on the wall, seen from inside; the light is inside as well, or outside."""
    room = Sphere(draw.simple_point(3), draw.real(4, 8))
    outward = draw.direction()
    hit = replace(hit_at(add(room.center, outward, room.radius), times(-1.0, outward)), from_outside=False)
    inside = draw.chance(0.5)
    reach = draw.real(0.0, 0.5) if inside else draw.real(1.5, 3)
    way = draw.direction() if inside else draw.above(hit.normal, 0.5)
    return scene([room], hit, Light(rounded(add(room.center, way, reach * room.radius))))


def low_light(draw: Draw) -> Inputs:
    """Near the horizon of the ball that the hit is on; nothing is in the way."""
    ball = Sphere(draw.simple_point(2), draw.real(1, 3))
    normal = draw.direction()
    hit = hit_at(add(ball.center, normal, ball.radius), normal)
    return scene([ball], hit, Light(rounded(add(hit.position, draw.above(normal, 0.1, 0.25), draw.real(4, 20)))))
