"""Cases of step 03: diffuse light."""

from dataclasses import replace

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.axes import next_axis
from raysteps.judge.generators.phong_simple import COLOR, PLAIN, WHITE, simple_normals
from raysteps.judge.numbers import times
from raysteps.judge.values import Inputs, Light, Vec


def _diffuse(draw: Draw, low: float, high: float) -> Inputs:
    normal = draw.direction()
    return {
        "fill": draw.fill(),
        "light": draw.light(draw.point(5)),
        "normal": Vec(normal),
        "to_light": Vec(draw.above(normal, low, high)),
    }


def _around_right_angle(draw: Draw) -> Inputs:
    """A little above the surface or below it, or exactly along it."""
    if draw.chance(0.7):
        side = draw.sign()
        return _diffuse(draw, min(0.01 * side, 0.06 * side), max(0.01 * side, 0.06 * side))
    normal = draw.axis()
    along = times(draw.sign(), next_axis(normal))
    return {"fill": draw.fill(), "light": draw.light(draw.point(5)), "normal": Vec(normal), "to_light": Vec(along)}


def _extreme_colors(draw: Draw) -> Inputs:
    """Channels of 0 and of much more than 1, kd from 0 to 1."""

    def channel() -> float:
        return 0.0 if draw.chance(0.3) else draw.real(0.001, 0.01) if draw.chance(0.3) else draw.real(10, 500)

    inputs = _diffuse(draw, 0.2, 0.99)
    fill = replace(draw.fill(), kd=(0.0, 1.0, 0.5)[draw.whole(0, 2)])
    return {**inputs, "fill": fill, "light": Light(draw.point(5), (channel(), channel(), channel()))}


def _simple_diffuse(draw: Draw) -> Inputs:
    normal, to_light = simple_normals(draw)
    return {
        "fill": replace(PLAIN, color=draw.color()),
        "light": WHITE,
        "normal": Vec(normal),
        "to_light": Vec(to_light),
    }


DIFFUSE = Function(
    "diffuse",
    COLOR,
    (
        Group("light in front", lambda d: _diffuse(d, 0.1, 0.99)),
        Group("simple numbers", _simple_diffuse),
        Group("extreme colours", _extreme_colors, telling=False),
        Group("around a right angle", _around_right_angle, telling=False, exact=True),
        Group("light behind", lambda d: _diffuse(d, -0.99, -0.1), telling=False),
    ),
)
