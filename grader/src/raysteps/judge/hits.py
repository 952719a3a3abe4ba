"""Answers that are hit records."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from raysteps.common.vectors import Vector, add, dot, length, minus, times
from raysteps.judge.answers import (
    FARTHEST,
    LENGTHS,
    SMALL,
    Answer,
    channels,
    direction,
    first,
    plainly_wrong,
    ray_start_problem,
    read_ray,
    real,
    share_right,
    unit_length,
    vector,
    words_of_ray,
)
from raysteps.judge.protocol import Fill, Hit, Inputs, Light, ProtocolError, Ray, TokenReader

_ALONG = 1e-6  # cosine of a ray that runs along the surface where it meets it
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


NOTHING_FOUND = "there is a hit, and none is reported"


def hit_or_miss(expected: MaybeHit, actual: MaybeHit) -> str:
    if expected.hit is None:
        return "there is no hit, and one is reported" if actual.hit else ""
    return "" if actual.hit else NOTHING_FOUND


def _fill(expected: Fill, actual: Fill) -> str:
    pairs = zip(expected.numbers()[3:], actual.numbers()[3:], strict=True)
    numbers = [real("fill", a, b) for a, b in pairs]
    return first(channels("the fill's colour", expected.color, actual.color, SMALL), *numbers)


def _record_problems(expected: Hit, actual: Hit) -> tuple[str, ...]:
    """Of all that a record holds, the distance first."""
    sides = "" if expected.front_face == actual.front_face else plainly_wrong("front_face")
    normal = direction("the normal", expected.normal, actual.normal)
    if abs(dot(expected.normal, expected.ray_direction)) < _ALONG:  # the ray comes from neither side
        sides, normal = "", normal and direction("the normal", times(-1.0, expected.normal), actual.normal)
    return (
        real("the distance", expected.distance, actual.distance, LENGTHS),
        vector("the position", expected.position, actual.position, LENGTHS),
        normal,
        sides,
        vector("ray_direction", expected.ray_direction, actual.ray_direction),
        plainly_wrong("the fill") if _fill(expected.fill, actual.fill) else "",
    )


def record_problem(expected: Hit, actual: Hit) -> str:
    """The first thing in a record that is wrong."""
    return first(*_record_problems(expected, actual))


def _record_credit(_inputs: Inputs, expected: MaybeHit, actual: MaybeHit) -> float:
    """At another distance another point was found."""
    if expected.hit is None or actual.hit is None:
        return 0.0
    distance, *others = _record_problems(expected.hit, actual.hit)
    return 0.0 if distance else share_right(*others)


def _problem(_inputs: Inputs, expected: MaybeHit, actual: MaybeHit) -> str:
    if expected.hit is None or actual.hit is None:
        return hit_or_miss(expected, actual)
    return record_problem(expected.hit, actual.hit)


HIT = Answer(read_hit, hit_words, _problem, _record_credit)


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


FOUND = Answer(read_hit, found_words, lambda _inputs, expected, actual: found_problem(expected, actual), _record_credit)


# Answers that are rays which leave a surface.


def hit_of(inputs: Inputs) -> Hit:
    hit = inputs["hit"]
    assert isinstance(hit, Hit)
    return hit


def leaves_surface(hit: Hit, ray: Ray, *, side: float = 1.0) -> str:
    """The origin is a little off the surface; side -1 is the one behind it."""
    return ray_start_problem(hit.position, times(side, hit.normal), ray.origin)


def _shadow_problems(inputs: Inputs, actual: Ray) -> tuple[str, str]:
    light = inputs["light"]
    assert isinstance(light, Light)
    to_light = minus(light.position, actual.origin)
    reached = add(actual.origin, actual.direction, length(to_light))
    passes = length(minus(reached, light.position)) <= 1.5 * FARTHEST + 1e-5 * length(light.position)
    return (
        unit_length("the direction", actual.direction) or ("" if passes else "the ray does not go to the light"),
        leaves_surface(hit_of(inputs), actual),
    )


def ray_credit(direction_problem: str, origin_problem: str) -> float:
    """Half for the right direction from the wrong place; a place without a direction is nothing."""
    return 0.0 if direction_problem else 0.5 if origin_problem else 1.0


def bounce_problems(hit: Hit, expected: Ray, actual: Ray, *, side: float = 1.0) -> tuple[str, str]:
    """The same direction, from a little off the surface."""
    return (
        direction("the direction", expected.direction, actual.direction),
        leaves_surface(hit, actual, side=side),
    )


def _reflected_problems(inputs: Inputs, expected: Ray, actual: Ray) -> tuple[str, str]:
    return bounce_problems(hit_of(inputs), expected, actual)


def side_of(hit: Hit, origin: Vector) -> float:
    """On which side of the surface a ray of the reference starts."""
    offset = minus(origin, hit.position)
    inner = offset[0] * hit.normal[0] + offset[1] * hit.normal[1] + offset[2] * hit.normal[2]
    return 1.0 if inner > 0 else -1.0


def _transmitted_problems(inputs: Inputs, expected: Ray, actual: Ray) -> tuple[str, str]:
    hit = hit_of(inputs)
    return bounce_problems(hit, expected, actual, side=side_of(hit, expected.origin))


_NEARLY = 3.0  # degrees: a ray from another place on the hit's surface has a little another way to the light


def _shadow_credit(inputs: Inputs, expected: Ray, actual: Ray) -> float:
    """A ray that starts at the light reaches it whatever its direction."""
    return ray_credit(direction("", expected.direction, actual.direction, _NEARLY), _shadow_problems(inputs, actual)[1])


def ray_answer(problems: Callable[[Inputs, Ray, Ray], tuple[str, str]]) -> Answer[Ray]:
    """A ray; `problems` are those of its direction and of its origin."""
    return Answer(
        read_ray,
        words_of_ray,
        lambda inputs, expected, actual: first(*problems(inputs, expected, actual)),
        lambda inputs, expected, actual: ray_credit(*problems(inputs, expected, actual)),
    )


SHADOW_RAY = replace(
    ray_answer(lambda inputs, _expected, actual: _shadow_problems(inputs, actual)), credit=_shadow_credit
)
REFLECTED_RAY = ray_answer(_reflected_problems)
TRANSMITTED_RAY = ray_answer(_transmitted_problems)
