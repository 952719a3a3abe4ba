"""Cases of step 03: the light of several lights together."""

from dataclasses import replace

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.phong_simple import COLOR, PLAIN, simple_normals
from raysteps.judge.numbers import add, rounded, times
from raysteps.judge.values import Hit, Inputs, Light, Lights


def _hit(draw: Draw) -> Hit:
    normal = draw.direction()
    return Hit(
        draw.point(4),
        normal,
        rounded(times(-1.0, draw.above(normal, 0.15))),
        draw.real(1, 20),
        draw.fill(),
        draw.chance(0.7),
    )


def _lights(draw: Draw, hit: Hit, count: int, *, low: float = 0.1, near: float = 2.0, far: float = 15.0) -> Inputs:
    lights = [
        draw.light(rounded(add(hit.position, draw.above(hit.normal, low, low + 0.85), draw.real(near, far))))
        for _ in range(count)
    ]
    return {"hit": hit, "lights": Lights(tuple(lights))}


def _near_lights(draw: Draw) -> Inputs:
    hit = replace(_hit(draw), position=draw.point(0.5))
    return _lights(draw, hit, draw.whole(1, 2), low=0.2, near=0.02, far=0.1)


def _lights_around_horizon(draw: Draw) -> Inputs:
    """Some a little above the surface, some a little below it."""
    hit, lights = _hit(draw), []
    for _ in range(3):
        low, high = (0.01, 0.06) if draw.chance(0.5) else (-0.06, -0.01)
        place = add(hit.position, draw.above(hit.normal, low, high), draw.real(3, 10))
        lights.append(draw.light(rounded(place)))
    return {"hit": hit, "lights": Lights(tuple(lights))}


def _front_and_back(draw: Draw) -> Inputs:
    hit = _hit(draw)
    front, back = _lights(draw, hit, 1)["lights"], _lights(draw, hit, 2, low=-0.95)["lights"]
    assert isinstance(front, Lights)
    assert isinstance(back, Lights)
    return {"hit": hit, "lights": Lights(front.lights + back.lights)}


def _simple_shade(draw: Draw) -> Inputs:
    """One white light, seen from straight above."""
    normal, to_light = simple_normals(draw)
    hit = Hit((0.0, 0.0, 0.0), normal, times(-1.0, normal), 1.0, replace(PLAIN, color=draw.color(), shine=2.0))
    return {"hit": hit, "lights": Lights((Light(rounded(times(5.0, to_light))),))}


def _bright(draw: Draw) -> Inputs:
    hit = _hit(draw)
    hit = replace(hit, fill=replace(hit.fill, color=draw.color(0.7, 1.0), kd=1.0))
    return _lights(draw, hit, 5, low=0.1)


SHADE = Function(
    "shade",
    COLOR,
    (
        Group("several lights", lambda d: _lights(d, _hit(d), d.whole(2, 4))),
        Group("simple numbers", _simple_shade),
        Group("one light", lambda d: _lights(d, _hit(d), 1)),
        Group("lights in front and behind", _front_and_back),
        Group("far lights", lambda d: _lights(d, _hit(d), 2, near=50, far=200)),
        Group("brighter than 1", _bright),
        Group("very near lights", _near_lights),
        Group("very far lights", lambda d: _lights(d, _hit(d), 2, near=1e3, far=1e5)),
        Group("lights around the horizon", _lights_around_horizon, telling=False),
        Group("no light", lambda d: _lights(d, _hit(d), 0), telling=False),
    ),
)
