"""Answers that are rays which leave a surface."""

from collections.abc import Callable

from raysteps.judge.answers import Answer, first, read_ray, words_of_ray
from raysteps.judge.comparing import direction, off_surface, unit_length
from raysteps.judge.numbers import Vector, add, length, minus, times
from raysteps.judge.values import Hit, Inputs, Light, Ray

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
