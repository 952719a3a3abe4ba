"""Cases of step 04: the shadow ray; is_lit has a module of its own."""

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.axes import next_axis
from raysteps.judge.generators.shadow_blockers import any_hit, hit_at, light_above
from raysteps.judge.generators.shadow_scenes import IS_LIT
from raysteps.judge.numbers import add, rounded
from raysteps.judge.rays import SHADOW_RAY
from raysteps.judge.values import Hit, Inputs, Light


def _ray_case(draw: Draw, hit: Hit, near: float = 2.0, far: float = 30.0) -> Inputs:
    return {"hit": hit, "light": light_above(draw, hit, near, far)}


def _simple_ray(draw: Draw) -> Inputs:
    hit = hit_at(draw.simple_point(3), draw.axis())
    side = next_axis(hit.normal)
    across, up = (0.0, 5.0) if draw.chance(0.5) else (3.0, 4.0)
    return {"hit": hit, "light": Light(add(add(hit.position, hit.normal, up), side, across))}


def _light_behind(draw: Draw) -> Inputs:
    """The ray runs through the surface, and starts on the normal's side of it all the same."""
    hit = any_hit(draw)
    way = draw.above(hit.normal, -1.0, -0.25)
    return {"hit": hit, "light": Light(rounded(add(hit.position, way, draw.real(2, 30))))}


def _far_from_origin(draw: Draw) -> Inputs:
    return _ray_case(draw, hit_at(add((100.0, 100.0, 100.0), draw.point(3)), draw.direction()))


def _near_or_far(draw: Draw) -> Inputs:
    hit = any_hit(draw, 1.0)
    return _ray_case(draw, hit, 0.1, 0.3) if draw.chance(0.5) else _ray_case(draw, hit, 1e3, 1e4)


def _low_light(draw: Draw) -> Inputs:
    hit = any_hit(draw)
    return {"hit": hit, "light": Light(rounded(add(hit.position, draw.above(hit.normal, 0.03, 0.1), draw.real(2, 30))))}


_SHADOW_RAY = Function(
    "shadow_ray",
    SHADOW_RAY,
    (
        Group("any hit and light", lambda d: _ray_case(d, any_hit(d))),
        Group("simple numbers", _simple_ray),
        Group("a light close by", lambda d: _ray_case(d, any_hit(d), 0.5, 1.0)),
        Group("far from the centre of the world", _far_from_origin),
        Group("a light very near or very far", _near_or_far),
        Group("a light near the horizon", _low_light),
        Group("a light behind the surface", _light_behind),
    ),
)

FUNCTIONS = (_SHADOW_RAY, IS_LIT)
