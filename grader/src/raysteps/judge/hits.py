"""Answers that are hit records."""

from collections.abc import Callable
from dataclasses import dataclass

from raysteps.common.vectors import Vector, add, length, minus, times
from raysteps.judge.answers import (
    LENGTHS,
    SMALL,
    Answer,
    channels,
    direction,
    first,
    off_surface,
    read_ray,
    real,
    unit_length,
    vector,
    words_of_ray,
)
from raysteps.judge.protocol import Fill, Hit, Inputs, Light, ProtocolError, Ray, TokenReader

_LISTED = 256  # surface i of a list has red i / 256


@dataclass(frozen=True)
class MaybeHit:
    """A hit record, or a miss."""

    hit: Hit | None


def read_hit(tokens: TokenReader) -> MaybeHit:
    kind = tokens.word()
    if kind == "miss":
        return MaybeHit(None)
    if kind != "hit":
        raise ProtocolError("the answer is neither a hit nor a miss")
    position = tokens.vector()
    fill = Fill(tokens.vector(), *(tokens.real() for _ in range(5)))
    normal, ray_direction = tokens.vector(), tokens.vector()
    return MaybeHit(Hit(position, normal, ray_direction, tokens.real(), fill, tokens.flag()))


def hit_words(answer: MaybeHit) -> str:
    return "a miss" if answer.hit is None else f"a hit: {answer.hit.words()}"


def hit_or_miss(expected: MaybeHit, actual: MaybeHit) -> str:
    if expected.hit is None:
        return "there is no hit, and one is reported" if actual.hit else ""
    return "" if actual.hit else "there is a hit, and none is reported"


def _fill(expected: Fill, actual: Fill) -> str:
    pairs = zip(expected.numbers()[3:], actual.numbers()[3:], strict=True)
    wrong = [real("fill", a, b) for a, b in pairs]
    return first(channels("the fill's colour", expected.color, actual.color, SMALL), *wrong)


def record_problem(expected: Hit, actual: Hit) -> str:
    """All that a record holds."""
    sides = "" if expected.front_face == actual.front_face else "front_face is wrong"
    return first(
        real("the distance", expected.distance, actual.distance, LENGTHS),
        vector("the position", expected.position, actual.position, LENGTHS),
        direction("the normal", expected.normal, actual.normal),
        sides,
        vector("ray_direction", expected.ray_direction, actual.ray_direction),
        "the fill is wrong" if _fill(expected.fill, actual.fill) else "",
    )


def _problem(_inputs: Inputs, expected: MaybeHit, actual: MaybeHit) -> str:
    if expected.hit is None or actual.hit is None:
        return hit_or_miss(expected, actual)
    return record_problem(expected.hit, actual.hit)


HIT = Answer(read_hit, hit_words, _problem)


def surface_number(hit: Hit) -> int:
    """From 1; which surface of a list the record is from."""
    return round(hit.fill.color[0] * _LISTED) if abs(hit.fill.color[0]) < _LISTED else 0


def found_words(answer: MaybeHit) -> str:
    if answer.hit is None:
        return "a miss"
    return f"surface {surface_number(answer.hit)} at distance {answer.hit.distance:.6g}"


def found_problem(expected: MaybeHit, actual: MaybeHit) -> str:
    """Which surface of a list was found, and where."""
    if expected.hit is None or actual.hit is None:
        return hit_or_miss(expected, actual)
    if surface_number(expected.hit) != surface_number(actual.hit):
        return "another surface was found"
    return record_problem(expected.hit, actual.hit)


FOUND = Answer(read_hit, found_words, lambda _inputs, expected, actual: found_problem(expected, actual))


# Answers that are rays which leave a surface.

FARTHEST = 0.0101  # from the hit; the kit's threshold is 0.001


def hit_of(inputs: Inputs) -> Hit:
    hit = inputs["hit"]
    assert isinstance(hit, Hit)
    return hit


def leaves_surface(hit: Hit, ray: Ray, *, side: float = 1.0) -> str:
    """The origin is a little off the surface; side -1 is the one behind it."""
    return off_surface(hit.position, times(side, hit.normal), ray.origin, FARTHEST)


def _shadow_problem(inputs: Inputs, _expected: Ray, actual: Ray) -> str:
    light = inputs["light"]
    assert isinstance(light, Light)
    to_light = minus(light.position, actual.origin)
    reached = add(actual.origin, actual.direction, length(to_light))
    passes = length(minus(reached, light.position)) <= 1.5 * FARTHEST + 1e-5 * length(light.position)
    return first(
        leaves_surface(hit_of(inputs), actual),
        unit_length("the direction", actual.direction),
        "" if passes else "the ray does not go to the light",
    )


def bounce_problem(hit: Hit, expected: Ray, actual: Ray, *, side: float = 1.0) -> str:
    """The same direction, from a little off the surface."""
    return first(
        direction("the direction", expected.direction, actual.direction),
        leaves_surface(hit, actual, side=side),
    )


def _reflected_problem(inputs: Inputs, expected: Ray, actual: Ray) -> str:
    return bounce_problem(hit_of(inputs), expected, actual)


def side_of(hit: Hit, origin: Vector) -> float:
    """On which side of the surface a ray of the reference starts."""
    offset = minus(origin, hit.position)
    inner = offset[0] * hit.normal[0] + offset[1] * hit.normal[1] + offset[2] * hit.normal[2]
    return 1.0 if inner > 0 else -1.0


def _transmitted_problem(inputs: Inputs, expected: Ray, actual: Ray) -> str:
    hit = hit_of(inputs)
    return bounce_problem(hit, expected, actual, side=side_of(hit, expected.origin))


def _ray(problem: Callable[[Inputs, Ray, Ray], str]) -> Answer[Ray]:
    return Answer(read_ray, words_of_ray, problem)


SHADOW_RAY = _ray(_shadow_problem)
REFLECTED_RAY = _ray(_reflected_problem)
TRANSMITTED_RAY = _ray(_transmitted_problem)
