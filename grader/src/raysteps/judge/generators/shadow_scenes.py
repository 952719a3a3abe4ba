"""Cases of step 04: is a light seen?"""

from dataclasses import dataclass, replace

from raysteps.judge.answers import Answer
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.axes import next_axis
from raysteps.judge.generators.shadow_blockers import any_hit, ball, hit_at, light_above, scene, several, sideways
from raysteps.judge.generators.shadow_ends import before_light, behind_light, light_in_shell, other_side, pebble
from raysteps.judge.generators.shadow_own_surface import hollow_ball, low_light, own_ball, own_triangle
from raysteps.judge.numbers import add, minus, rounded, times, unit
from raysteps.judge.surfaces import Sphere
from raysteps.judge.tokens import Tokens
from raysteps.judge.values import Inputs, Light


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


def _read_lit(tokens: Tokens) -> _Lit:
    return _Lit(tokens.flag(), tokens.whole())


_LIT = Answer(_read_lit, _lit_words, _lit_problem)


def _lit_or_not(draw: Draw) -> Inputs:
    hit = any_hit(draw)
    light = light_above(draw, hit, 4, 30)
    return scene(several(draw, hit, light, blocked=draw.chance(0.3)), hit, light)


def _simple_scene(draw: Draw) -> Inputs:
    """A ball above the hit; the light over it or to the side of it."""
    normal = draw.axis()
    hit = hit_at((0.0, 0.0, 0.0), normal)
    side = next_axis(normal)
    light = times(10.0, normal) if draw.chance(0.5) else add(times(5.0, normal), side, 10.0)
    return scene([Sphere(times(5.0, normal), 1.0)], hit, Light(light))


def _blocked(draw: Draw) -> Inputs:
    hit = any_hit(draw)
    light = light_above(draw, hit, 4, 30)
    return scene(several(draw, hit, light, blocked=True), hit, light)


def _glass(draw: Draw) -> Inputs:
    """A ball of glass in the way: it blocks as any other."""
    hit = any_hit(draw)
    light = light_above(draw, hit, 4, 30)
    return scene([replace(ball(draw, hit, light, blocks=True), glass=True)], hit, light)


def _nothing_between(draw: Draw) -> Inputs:
    hit = any_hit(draw)
    light = light_above(draw, hit, 4, 30)
    things = several(draw, hit, light, blocked=False) if draw.chance(0.7) else []
    return scene(things, hit, light)


def _far_light(draw: Draw) -> Inputs:
    hit = any_hit(draw)
    light = light_above(draw, hit, 1e3, 1e4)
    way = unit(minus(light.position, hit.position))
    radius, blocked = draw.real(0.5, 2), draw.chance(0.5)
    off = draw.real(0.0, 0.7) if blocked else draw.real(1.3, 2.0)
    place = add(add(hit.position, way, draw.real(5, 20)), sideways(draw, hit, light), off * radius)
    return scene([Sphere(rounded(place), radius)], hit, light)


IS_LIT = Function(
    "is_lit",
    _LIT,
    (
        Group("lit or in shadow", _lit_or_not),
        Group("simple numbers", _simple_scene, exact=True),
        Group("in a hollow ball", hollow_ball),
        Group("in shadow", _blocked, telling=False),
        Group("glass in the way", _glass, telling=False),
        Group("nothing between", _nothing_between, telling=False),
        Group("behind the light", behind_light, telling=False),
        Group("on the other side of the surface", other_side, telling=False),
        Group("a ball does not shade itself", own_ball, telling=False, exact=True),
        Group("a floor does not shade itself", own_triangle, telling=False, exact=True),
        Group("small and close to the surface", pebble, telling=False),
        Group("close before or behind the light", before_light, telling=False),
        Group("a ball around the light", light_in_shell, telling=False),
        Group("a light near the horizon", low_light, telling=False, exact=True),
        Group("a light very far away", _far_light, telling=False),
    ),
    yes_or_no=True,
)
