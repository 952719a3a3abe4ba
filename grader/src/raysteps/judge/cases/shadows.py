"""Cases of step 04: the shadow ray, and is_lit."""

from dataclasses import dataclass, replace

from raysteps.common.vectors import Vector, add, cross, length, minus, times, unit
from raysteps.judge.answers import Answer
from raysteps.judge.functions import Function, Group
from raysteps.judge.hits import SHADOW_RAY
from raysteps.judge.protocol import Hit, Inputs, Light, TokenReader, rounded
from raysteps.judge.random_source import RandomSource, next_axis
from raysteps.judge.surfaces import Sphere, Surface, Surfaces, Triangle

# Cases of step 04: hits, lights, and things in the way of a light or beside it.


def hit_at(position: Vector, normal: Vector) -> Hit:
    return Hit(rounded(position), rounded(normal), rounded(times(-1.0, normal)))


def random_hit(draw: RandomSource, reach: float = 3.0) -> Hit:
    """From either side of its surface, from anywhere on that side, and on anything: nothing of it matters."""
    hit = hit_at(draw.point(reach), draw.direction())
    seen_along = rounded(times(-1.0, draw.above(hit.normal, 0.2)))
    return replace(
        hit, ray_direction=seen_along, distance=draw.real(0.5, 20), fill=draw.fill(), front_face=draw.chance(0.6)
    )


def light_above(draw: RandomSource, hit: Hit, near: float, far: float) -> Light:
    return Light(rounded(add(hit.position, draw.above(hit.normal, 0.25, 1.0), draw.logarithmic(near, far))))


def scene(surfaces: list[Surface], hit: Hit, light: Light) -> Inputs:
    return {"surfaces": Surfaces(tuple(surfaces)), "hit": hit, "light": light}


def _between(draw: RandomSource, hit: Hit, light: Light, low: float, high: float) -> Vector:
    """A point on the way to the light."""
    return add(hit.position, minus(light.position, hit.position), draw.real(low, high))


def sideways(draw: RandomSource, hit: Hit, light: Light) -> Vector:
    way = unit(minus(light.position, hit.position))
    return unit(cross(way, draw.across(way)))


def ball(draw: RandomSource, hit: Hit, light: Light, *, blocks: bool) -> Sphere:
    """In the way of the light, or clearly beside it."""
    gap = length(minus(light.position, hit.position))
    radius = draw.real(0.1, 0.3) * gap
    off = draw.real(0.0, 0.7) if blocks else draw.real(1.2, 2.0)
    place = add(_between(draw, hit, light, 0.4, 0.6), sideways(draw, hit, light), off * radius)
    return Sphere(rounded(place), radius)


def _board(draw: RandomSource, hit: Hit, light: Light, *, blocks: bool) -> Triangle:
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


def several(draw: RandomSource, hit: Hit, light: Light, *, blocked: bool) -> list[Surface]:
    """Several beside the way, and one in it where the light is blocked."""
    things: list[Surface] = []
    for _ in range(draw.whole(1, 3)):
        make = ball if draw.chance(0.5) else _board
        things.append(make(draw, hit, light, blocks=False))
    if blocked:
        make = ball if draw.chance(0.5) else _board
        things.insert(draw.whole(0, len(things)), make(draw, hit, light, blocks=True))
    return things


# Cases of step 04: things close to one of the two ends of a shadow ray.


def pebble(draw: RandomSource) -> Inputs:
    """Little, and close to the surface: a threshold of its height would lose it."""
    hit = random_hit(draw)
    light = Light(rounded(add(hit.position, draw.above(hit.normal, 0.97, 1.0), draw.real(5, 15))))
    way = unit(minus(light.position, hit.position))
    return scene([Sphere(rounded(add(hit.position, way, draw.real(0.05, 0.08))), 0.02)], hit, light)


def other_side(draw: RandomSource) -> Inputs:
    """Behind the surface of the hit, opposite to the light."""
    hit = random_hit(draw)
    light = light_above(draw, hit, 2, 10)
    way = unit(minus(light.position, hit.position))
    radius = draw.real(0.3, 2)
    return scene([Sphere(rounded(add(hit.position, way, -radius - draw.real(0.2, 3))), radius)], hit, light)


def behind_light(draw: RandomSource) -> Inputs:
    """On the way, but beyond the light."""
    hit = random_hit(draw)
    light = light_above(draw, hit, 2, 10)
    way = minus(light.position, hit.position)
    radius = draw.real(0.3, 2)
    distance = 1 + (radius + draw.real(0.1, 1)) / length(way)
    return scene([Sphere(rounded(add(hit.position, way, distance)), radius)], hit, light)


def before_light(draw: RandomSource) -> Inputs:
    """Ends close before the light, or begins close behind it. Half of them are small, so that they begin close before
    the light, too; some are flat."""
    hit = random_hit(draw)
    light = light_above(draw, hit, 4, 12)
    way = unit(minus(light.position, hit.position))
    if draw.chance(0.3):
        side, size = sideways(draw, hit, light), draw.real(0.2, 0.6)
        middle = add(light.position, way, draw.real(0.03, 0.08) * draw.sign())
        low, other = add(middle, side, -0.6 * size), cross(way, side)
        corners = add(middle, side, size), add(low, other, size), add(low, other, -size)
        a, b, c = (rounded(corner) for corner in corners)
        return scene([Triangle(a, b, c)], hit, light)
    radius = draw.real(0.3, 1) if draw.chance(0.5) else draw.real(0.03, 0.12)
    gap = (radius + draw.real(0.03, 0.1)) * draw.sign()
    return scene([Sphere(rounded(add(light.position, way, gap)), radius)], hit, light)


def light_in_shell(draw: RandomSource) -> Inputs:
    """A ball around the light is in its way."""
    hit = random_hit(draw)
    light = light_above(draw, hit, 4, 12)
    center = add(light.position, draw.direction(), draw.real(0.0, 0.3))
    return scene([Sphere(rounded(center), draw.real(0.5, 2))], hit, light)


# Cases of step 04: does the surface that a hit lies on hide the light?


def own_ball(draw: RandomSource) -> Inputs:
    """The hit lies on the ball up to float's rounding, a little above or below."""
    center = add((50.0, -40.0, 30.0), draw.point(5))
    ball = Sphere(rounded(center), draw.real(0.5, 4))
    normal = draw.direction()
    hit = hit_at(add(ball.center, normal, ball.radius), normal)
    return scene([ball], hit, light_above(draw, hit, 8, 20))


def own_triangle(draw: RandomSource) -> Inputs:
    shape, place = draw.triangle(8.0), (60.0, -50.0, 40.0)
    floor = Triangle(rounded(add(place, shape.a)), rounded(add(place, shape.b)), rounded(add(place, shape.c)))
    edges = minus(floor.b, floor.a), minus(floor.c, floor.a)
    u = draw.real(0.1, 0.7)
    point = add(add(floor.a, edges[0], u), edges[1], draw.real(0.1, 0.9 - u))
    hit = hit_at(point, times(draw.sign(), unit(cross(*edges))))
    return scene([floor], hit, light_above(draw, hit, 8, 20))


def hollow_ball(draw: RandomSource) -> Inputs:
    """The hit is on the wall, seen from inside; the light is inside as well, or outside."""
    room = Sphere(draw.simple_point(3), draw.real(4, 8))
    outward = draw.direction()
    hit = replace(hit_at(add(room.center, outward, room.radius), times(-1.0, outward)), front_face=False)
    inside = draw.chance(0.5)
    reach = draw.real(0.0, 0.5) if inside else draw.real(1.5, 3)
    way = draw.direction() if inside else draw.above(hit.normal, 0.5)
    return scene([room], hit, Light(rounded(add(room.center, way, reach * room.radius))))


def low_light(draw: RandomSource) -> Inputs:
    """Near the horizon of the ball that the hit is on; nothing is in the way."""
    ball = Sphere(draw.simple_point(2), draw.real(1, 3))
    normal = draw.direction()
    hit = hit_at(add(ball.center, normal, ball.radius), normal)
    return scene([ball], hit, Light(rounded(add(hit.position, draw.above(normal, 0.1, 0.25), draw.real(4, 20)))))


# Cases of step 04: is a light seen?


@dataclass(frozen=True)
class _Lit:
    """Whether the light is seen, and how many rays were cast for it."""

    lit: bool
    rays: int


def _lit_words(answer: _Lit) -> str:
    rays = "" if answer.rays else ", without casting a ray"
    return ("true, the light is seen" if answer.lit else "false, the light is hidden") + rays


def _lit_problem(_inputs: Inputs, expected: _Lit, actual: _Lit) -> str:
    if expected.lit == actual.lit:
        return ""
    return "a light that is seen counts as hidden" if expected.lit else "a light that is hidden counts as seen"


def _read_lit(tokens: TokenReader) -> _Lit:
    return _Lit(tokens.flag(), tokens.whole())


_LIT = Answer(_read_lit, _lit_words, _lit_problem, constant=lambda answer: str(answer.lit))


def _lit_or_not(draw: RandomSource) -> Inputs:
    hit = random_hit(draw)
    light = light_above(draw, hit, 4, 30)
    return scene(several(draw, hit, light, blocked=draw.chance(0.5)), hit, light)


def _simple_scene(draw: RandomSource) -> Inputs:
    """A ball above the hit; the light over it or to the side of it."""
    normal = draw.axis()
    hit = hit_at((0.0, 0.0, 0.0), normal)
    side = next_axis(normal)
    light = times(10.0, normal) if draw.chance(0.5) else add(times(5.0, normal), side, 10.0)
    return scene([Sphere(times(5.0, normal), 1.0)], hit, Light(light))


def _blocked(draw: RandomSource) -> Inputs:
    hit = random_hit(draw)
    light = light_above(draw, hit, 4, 30)
    return scene(several(draw, hit, light, blocked=True), hit, light)


def _glass(draw: RandomSource) -> Inputs:
    """A ball of glass in the way: it blocks as any other."""
    hit = random_hit(draw)
    light = light_above(draw, hit, 4, 30)
    return scene([replace(ball(draw, hit, light, blocks=True), glass=True)], hit, light)


def _nothing_between(draw: RandomSource) -> Inputs:
    hit = random_hit(draw)
    light = light_above(draw, hit, 4, 30)
    things = several(draw, hit, light, blocked=False) if draw.chance(0.7) else []
    return scene(things, hit, light)


def _far_light(draw: RandomSource) -> Inputs:
    hit = random_hit(draw)
    light = light_above(draw, hit, 1e3, 1e4)
    way = unit(minus(light.position, hit.position))
    reach = draw.real(5, 20) if draw.chance(0.5) else draw.real(0.2, 0.8) * length(minus(light.position, hit.position))
    radius, blocked = draw.real(0.05, 0.15) * reach, draw.chance(0.5)
    off = draw.real(0.0, 0.7) if blocked else draw.real(1.3, 2.0)
    place = add(add(hit.position, way, reach), sideways(draw, hit, light), off * radius)
    return scene([Sphere(rounded(place), radius)], hit, light)


IS_LIT = Function(
    "is_lit",
    _LIT,
    (
        Group("lit or in shadow", _lit_or_not),
        Group("simple numbers", _simple_scene, exact=True),
        Group("in a hollow ball", hollow_ball),
        Group("in shadow", _blocked),
        Group("glass in the way", _glass),
        Group("nothing between", _nothing_between),
        Group("behind the light", behind_light),
        Group("on the other side of the surface", other_side),
        Group("a ball does not shade itself", own_ball, exact=True),
        Group("a floor does not shade itself", own_triangle, exact=True),
        Group("small and close to the surface", pebble),
        Group("close before or behind the light", before_light),
        Group("a ball around the light", light_in_shell),
        Group("a light near the horizon", low_light, exact=True),
        Group("a light very far away", _far_light),
    ),
    yes_or_no=True,
)


def _ray_case(draw: RandomSource, hit: Hit, near: float = 2.0, far: float = 30.0) -> Inputs:
    return {"hit": hit, "light": light_above(draw, hit, near, far)}


def _simple_ray(draw: RandomSource) -> Inputs:
    hit = hit_at(draw.simple_point(3), draw.axis())
    side = next_axis(hit.normal)
    across, up = (0.0, 5.0) if draw.chance(0.5) else (3.0, 4.0)
    return {"hit": hit, "light": Light(add(add(hit.position, hit.normal, up), side, across))}


def _light_behind(draw: RandomSource) -> Inputs:
    """The ray runs through the surface, and starts on the normal's side of it all the same."""
    hit = random_hit(draw)
    way = draw.above(hit.normal, -1.0, -0.25)
    return {"hit": hit, "light": Light(rounded(add(hit.position, way, draw.real(2, 30))))}


def _far_from_origin(draw: RandomSource) -> Inputs:
    return _ray_case(draw, hit_at(add((100.0, 100.0, 100.0), draw.point(3)), draw.direction()))


def _near_or_far(draw: RandomSource) -> Inputs:
    hit = random_hit(draw, 1.0)
    return _ray_case(draw, hit, 0.1, 0.3) if draw.chance(0.5) else _ray_case(draw, hit, 1e3, 1e4)


def _low_light(draw: RandomSource) -> Inputs:
    hit = random_hit(draw)
    return {"hit": hit, "light": Light(rounded(add(hit.position, draw.above(hit.normal, 0.03, 0.1), draw.real(2, 30))))}


_SHADOW_RAY = Function(
    "shadow_ray",
    SHADOW_RAY,
    (
        Group("any hit and light", lambda d: _ray_case(d, random_hit(d))),
        Group("simple numbers", _simple_ray),
        Group("a light close by", lambda d: _ray_case(d, random_hit(d), 0.5, 1.0)),
        Group("far from the centre of the world", _far_from_origin),
        Group("a light very near or very far", _near_or_far),
        Group("a light near the horizon", _low_light),
        Group("a light behind the surface", _light_behind),
    ),
)

FUNCTIONS = (_SHADOW_RAY, IS_LIT)
