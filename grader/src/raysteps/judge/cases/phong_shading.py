"""Cases of step 03."""

from dataclasses import replace

from raysteps.common.vectors import Vector, add, dot, times, unit
from raysteps.judge.answers import Answer, channels, itself, read_vector, vector, words_of_vector
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Fill, Hit, Inputs, Light, Lights, Vec, mirrored, rounded
from raysteps.judge.random_source import RandomSource, next_axis

# Cases of step 03: mirrored directions.

_DIRECTION = Answer(read_vector, words_of_vector, lambda _, e, a: vector("the direction", e, a), near=itself)


def _mirror(direction: Vector, normal: Vector) -> Inputs:
    return {"direction": Vec(direction), "normal": Vec(normal)}


def _simple_mirror(draw: RandomSource) -> Inputs:
    return _mirror(draw.simple_point(3), draw.axis())


def _along_surface(draw: RandomSource) -> Inputs:
    normal = draw.axis()
    flat = [0.0 if n else draw.eighths(0.5, 3) * draw.sign() for n in normal]
    return _mirror((flat[0], flat[1], flat[2]), normal)


def _scaled(draw: RandomSource) -> Inputs:
    return _mirror(rounded(times(draw.real(2, 9), draw.direction())), draw.direction())


def _straight(draw: RandomSource) -> Inputs:
    """Down onto the surface, or up from it."""
    normal = draw.direction()
    return _mirror(times(draw.sign(), normal), normal)


def _tiny_or_huge(draw: RandomSource) -> Inputs:
    size = draw.real(0.01, 0.05) if draw.chance(0.5) else draw.real(1e3, 1e5)
    return _mirror(rounded(times(size, draw.direction())), draw.direction())


MIRROR = Function(
    "mirror",
    _DIRECTION,
    (
        Group("any direction", lambda d: _mirror(d.direction(), d.direction())),
        Group("simple numbers", _simple_mirror),
        Group("longer than 1", _scaled),
        Group("along the surface", _along_surface),
        Group("straight down and up", _straight),
        Group("very short and very long", _tiny_or_huge),
    ),
)


# What the cases of step 03 share: colours as answers, and simple lights and surfaces.

COLOR = Answer(read_vector, words_of_vector, lambda _, e, a: channels("the colour", e, a), near=itself)
WHITE = Light((0.0, 0.0, 10.0))
PLAIN = Fill((1.0, 1.0, 1.0), 1.0, 1.0, 1.0)


def simple_normals(draw: RandomSource) -> tuple[Vector, Vector]:
    """An axis, and a direction to the light with a cosine of 1 or 0.8."""
    normal = draw.axis()
    if draw.chance(0.4):
        return normal, normal
    side = times(draw.sign(), next_axis(normal))
    return normal, rounded(add(times(0.8, normal), side, 0.6))


# Cases of step 03: diffuse light.


def _diffuse(draw: RandomSource, low: float, high: float) -> Inputs:
    normal = draw.direction()
    return {
        "fill": draw.fill(),
        "light": draw.light(draw.point(5)),
        "normal": Vec(normal),
        "to_light": Vec(draw.above(normal, low, high)),
    }


def _around_right_angle(draw: RandomSource) -> Inputs:
    """A little above the surface or below it, or exactly along it."""
    if draw.chance(0.7):
        side = draw.sign()
        return _diffuse(draw, min(0.01 * side, 0.06 * side), max(0.01 * side, 0.06 * side))
    normal = draw.axis()
    along = times(draw.sign(), next_axis(normal))
    return {"fill": draw.fill(), "light": draw.light(draw.point(5)), "normal": Vec(normal), "to_light": Vec(along)}


def _extreme_colors(draw: RandomSource) -> Inputs:
    """Channels of 0 and of much more than 1, kd from 0 to 1."""

    def channel() -> float:
        return 0.0 if draw.chance(0.3) else draw.real(0.001, 0.01) if draw.chance(0.3) else draw.real(10, 500)

    inputs = _diffuse(draw, 0.2, 0.99)
    fill = replace(draw.fill(), kd=(0.0, 1.0, 0.5)[draw.whole(0, 2)])
    return {**inputs, "fill": fill, "light": Light(draw.point(5), (channel(), channel(), channel()))}


def _dim(draw: RandomSource, lamp: Light) -> Light:
    """Each adds little, and counts all the same."""
    return replace(lamp, color=draw.color(0.005, 0.05))


def _dim_diffuse(draw: RandomSource) -> Inputs:
    inputs = _diffuse(draw, 0.5, 0.99)
    return {**inputs, "light": _dim(draw, draw.light(draw.point(5)))}


def _simple_diffuse(draw: RandomSource) -> Inputs:
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
        Group("extreme colours", _extreme_colors),
        Group("a dim light", _dim_diffuse),
        Group("around a right angle", _around_right_angle, exact=True),
        Group("light behind", lambda d: _diffuse(d, -0.99, -0.1)),
    ),
)


# Cases of step 03: highlights.

_SEEN = 0.02  # cosine between normal and eye


def _specular(draw: RandomSource, fill: Fill, light: Vector, normal: Vector, eye: Vector) -> Inputs:
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


def _eye(draw: RandomSource, normal: Vector, brightest: Vector, low: float, high: float) -> Vector:
    """On the side of the surface that the normal points to, where all eyes are: to ask about others is no mistake."""
    return draw.until(lambda eye: dot(eye, normal) > _SEEN, lambda: draw.above(brightest, low, high))


def _eye_in_highlight(draw: RandomSource, normal: Vector, brightest: Vector, low: float, high: float) -> Vector:
    """Likewise; one below is turned up, which brings it nearer to the brightest place."""
    eye = draw.above(brightest, low, high)
    height = dot(eye, normal)
    return eye if height > _SEEN else unit(add(eye, normal, 2 * (_SEEN - height)))


def _highlight(draw: RandomSource, *, shine: float | None = None) -> Inputs:
    """The eye is near the mirrored light."""
    normal = draw.direction()
    to_light = draw.above(normal, 0.1, 0.95)
    brightest = _brightest(to_light, normal)
    fill = replace(draw.fill(), shine=draw.real(2, 12) if shine is None else shine)
    return _specular(draw, fill, to_light, normal, _eye_in_highlight(draw, normal, brightest, 0.75, 0.995))


def _no_highlight(draw: RandomSource) -> Inputs:
    """The eye is more than a right angle away from the mirrored light."""
    normal = draw.direction()
    to_light = draw.above(normal, 0.1, 0.95)
    brightest = _brightest(to_light, normal)
    return _specular(draw, draw.fill(), to_light, normal, _eye(draw, normal, brightest, -0.95, -0.1))


def _light_behind(draw: RandomSource) -> Inputs:
    """Its mirrored way points into the surface, and the eye above is less than a right angle away from that."""
    normal = draw.direction()
    to_light = draw.above(normal, -0.7, -0.1)
    brightest = _brightest(to_light, normal)
    fill = replace(draw.fill(), shine=draw.real(1, 4))
    return _specular(draw, fill, to_light, normal, _eye(draw, normal, brightest, 0.3, 0.95))


def _simple_specular(draw: RandomSource) -> Inputs:
    """Light above the surface or at a slant, white, ks 1; the eye above, or where the light is brightest."""
    normal, to_light = simple_normals(draw)
    brightest = rounded(_brightest(to_light, normal))
    eye = normal if draw.chance(0.5) else brightest
    inputs = dict(_specular(draw, replace(PLAIN, shine=float(draw.whole(1, 3))), to_light, normal, eye))
    return {**inputs, "light": WHITE}


def _at_highlight(draw: RandomSource) -> Inputs:
    """The eye where the light is brightest: the cosine is 1, or by rounding a little more."""
    normal = draw.direction()
    to_light = draw.above(normal, 0.1, 1.0)
    brightest = rounded(_brightest(to_light, normal))
    return _specular(draw, replace(draw.fill(), shine=draw.real(1, 40)), to_light, normal, brightest)


def _very_high_shine(draw: RandomSource) -> Inputs:
    normal = draw.direction()
    to_light = draw.above(normal, 0.1, 0.95)
    brightest = _brightest(to_light, normal)
    fill = replace(draw.fill(), shine=draw.real(100, 400))
    return _specular(draw, fill, to_light, normal, _eye_in_highlight(draw, normal, brightest, 0.993, 1.0))


def _light_on_horizon(draw: RandomSource) -> Inputs:
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
        Group("high shine", lambda d: _highlight(d, shine=d.real(20, 40))),
        Group("exactly in the highlight", _at_highlight),
        Group("shine 0", lambda d: _highlight(d, shine=0.0)),
        Group("very high shine", _very_high_shine),
        Group("light on the horizon", _light_on_horizon, exact=True),
        Group("far from the highlight", _no_highlight),
        Group("light behind", _light_behind),
    ),
)


# Cases of step 03: the light of several lights together.


def _hit(draw: RandomSource) -> Hit:
    normal = draw.direction()
    return Hit(
        draw.point(4),
        normal,
        rounded(times(-1.0, draw.above(normal, 0.15))),
        draw.real(1, 20),
        draw.fill(),
        draw.chance(0.7),
    )


def _lights(
    draw: RandomSource, hit: Hit, count: int, *, low: float = 0.1, near: float = 2.0, far: float = 15.0
) -> Inputs:
    lights = [
        draw.light(rounded(add(hit.position, draw.above(hit.normal, low, low + 0.85), draw.logarithmic(near, far))))
        for _ in range(count)
    ]
    return {"hit": hit, "lights": Lights(tuple(lights))}


def _near_lights(draw: RandomSource) -> Inputs:
    hit = replace(_hit(draw), position=draw.point(0.5))
    return _lights(draw, hit, draw.whole(1, 2), low=0.2, near=0.02, far=0.1)


def _lights_around_horizon(draw: RandomSource) -> Inputs:
    """Some a little above the surface, some a little below it."""
    hit, lights = _hit(draw), []
    for _ in range(3):
        low, high = (0.01, 0.06) if draw.chance(0.5) else (-0.06, -0.01)
        place = add(hit.position, draw.above(hit.normal, low, high), draw.real(3, 10))
        lights.append(draw.light(rounded(place)))
    return {"hit": hit, "lights": Lights(tuple(lights))}


def _front_and_back(draw: RandomSource) -> Inputs:
    hit = _hit(draw)
    front, back = _lights(draw, hit, 1)["lights"], _lights(draw, hit, 2, low=-0.95)["lights"]
    assert isinstance(front, Lights)
    assert isinstance(back, Lights)
    return {"hit": hit, "lights": Lights(front.lights + back.lights)}


def _simple_shade(draw: RandomSource) -> Inputs:
    """One white light, seen from straight above."""
    normal, to_light = simple_normals(draw)
    hit = Hit((0.0, 0.0, 0.0), normal, times(-1.0, normal), 1.0, replace(PLAIN, color=draw.color(), shine=2.0))
    return {"hit": hit, "lights": Lights((Light(rounded(times(5.0, to_light))),))}


def _matt(draw: RandomSource) -> Inputs:
    """Without highlights."""
    hit = _hit(draw)
    return _lights(draw, replace(hit, fill=replace(hit.fill, ks=0.0)), draw.whole(1, 4))


def _polished(draw: RandomSource) -> Inputs:
    """Nothing but wide highlights: without kd, or of a black that only its highlights leave."""
    hit = _hit(draw)
    fill = replace(hit.fill, shine=draw.real(1, 3))
    fill = replace(fill, kd=0.0) if draw.chance(0.5) else replace(fill, color=(0.0, 0.0, 0.0))
    return _lights(draw, replace(hit, fill=fill), draw.whole(2, 4), low=0.3)


def _dim_lights(draw: RandomSource) -> Inputs:
    inputs = _lights(draw, _hit(draw), draw.whole(9, 20), low=0.1)
    lights = inputs["lights"]
    assert isinstance(lights, Lights)
    return {**inputs, "lights": Lights(tuple(_dim(draw, lamp) for lamp in lights.lights))}


def _bright(draw: RandomSource) -> Inputs:
    hit = _hit(draw)
    hit = replace(hit, fill=replace(hit.fill, color=draw.color(0.7, 1.0), kd=1.0))
    return _lights(draw, hit, 5, low=0.1)


SHADE = Function(
    "shade",
    COLOR,
    (
        Group("several lights", lambda d: _lights(d, _hit(d), d.whole(2, 4))),
        Group("simple numbers", _simple_shade),
        Group("matt surfaces", _matt),
        Group("polished surfaces", _polished),
        Group("one light", lambda d: _lights(d, _hit(d), 1)),
        Group("many lights", lambda d: _lights(d, _hit(d), d.whole(9, 40))),
        Group("lights in front and behind", _front_and_back),
        Group("far lights", lambda d: _lights(d, _hit(d), 2, near=50, far=200)),
        Group("brighter than 1", _bright),
        Group("dim lights", _dim_lights),
        Group("very near lights", _near_lights),
        Group("very far lights", lambda d: _lights(d, _hit(d), 2, near=1e3, far=1e5)),
        Group("lights around the horizon", _lights_around_horizon),
        Group("no light", lambda d: _lights(d, _hit(d), 0)),
    ),
)


FUNCTIONS = (MIRROR, DIFFUSE, SPECULAR, SHADE)
