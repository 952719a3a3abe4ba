"""Cases of step 03: highlights."""

from dataclasses import replace

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.axes import next_axis
from raysteps.judge.generators.phong_simple import COLOR, PLAIN, WHITE, simple_normals
from raysteps.judge.numbers import Vector, mirrored, rounded, times, unit
from raysteps.judge.values import Fill, Inputs, Vec


def _specular(draw: Draw, fill: Fill, light: Vector, normal: Vector, eye: Vector) -> Inputs:
    return {
        "fill": fill,
        "light": draw.light(draw.point(5)),
        "normal": Vec(normal),
        "to_light": Vec(light),
        "to_eye": Vec(eye),
    }


def _brightest(to_light: Vector, normal: Vector) -> Vector:
    """Where the eye sees most of the light."""
    return unit(mirrored(times(-1.0, to_light), normal))


def _highlight(draw: Draw, *, shine: float | None = None) -> Inputs:
    """The eye is near the mirrored light."""
    normal = draw.direction()
    to_light = draw.above(normal, 0.1, 0.95)
    brightest = _brightest(to_light, normal)
    fill = replace(draw.fill(), shine=draw.real(2, 12) if shine is None else shine)
    return _specular(draw, fill, to_light, normal, draw.above(brightest, 0.75, 0.995))


def _no_highlight(draw: Draw) -> Inputs:
    """The eye is more than a right angle away from the mirrored light."""
    normal = draw.direction()
    to_light = draw.above(normal, 0.1, 0.95)
    brightest = _brightest(to_light, normal)
    return _specular(draw, draw.fill(), to_light, normal, draw.above(brightest, -0.95, -0.1))


def _light_behind(draw: Draw) -> Inputs:
    """And the eye where the highlight would be, if the surface let the light through."""
    normal = draw.direction()
    to_light = draw.above(normal, -0.95, -0.1)
    brightest = _brightest(to_light, normal)
    return _specular(draw, draw.fill(), to_light, normal, draw.above(brightest, 0.8, 0.99))


def _simple_specular(draw: Draw) -> Inputs:
    """Light above the surface or at a slant, white, ks 1; the eye above, or where the light is brightest."""
    normal, to_light = simple_normals(draw)
    brightest = rounded(_brightest(to_light, normal))
    eye = normal if draw.chance(0.5) else brightest
    inputs = dict(_specular(draw, replace(PLAIN, shine=float(draw.whole(1, 3))), to_light, normal, eye))
    return {**inputs, "light": WHITE}


def _at_highlight(draw: Draw) -> Inputs:
    """The eye where the light is brightest: the cosine is 1, or by rounding a little more."""
    normal = draw.direction()
    to_light = draw.above(normal, 0.1, 1.0)
    brightest = rounded(_brightest(to_light, normal))
    return _specular(draw, replace(draw.fill(), shine=draw.real(1, 40)), to_light, normal, brightest)


def _very_high_shine(draw: Draw) -> Inputs:
    normal = draw.direction()
    to_light = draw.above(normal, 0.1, 0.95)
    brightest = _brightest(to_light, normal)
    fill = replace(draw.fill(), shine=draw.real(100, 400))
    return _specular(draw, fill, to_light, normal, draw.above(brightest, 0.993, 1.0))


def _light_on_horizon(draw: Draw) -> Inputs:
    """The light exactly along the surface, and the eye in its way: black."""
    normal = draw.axis()
    along = times(draw.sign(), next_axis(normal))
    return _specular(draw, draw.fill(), along, normal, times(-1.0, along))


SPECULAR = Function(
    "specular",
    COLOR,
    (
        Group("near the highlight", _highlight),
        Group("simple numbers", _simple_specular),
        Group("shine 1", lambda d: _highlight(d, shine=1.0)),
        Group("high shine", lambda d: _highlight(d, shine=d.real(20, 40)), telling=False),
        Group("exactly in the highlight", _at_highlight),
        Group("shine 0", lambda d: _highlight(d, shine=0.0)),
        Group("very high shine", _very_high_shine, telling=False),
        Group("light on the horizon", _light_on_horizon, telling=False, exact=True),
        Group("far from the highlight", _no_highlight, telling=False),
        Group("light behind", _light_behind, telling=False),
    ),
)
