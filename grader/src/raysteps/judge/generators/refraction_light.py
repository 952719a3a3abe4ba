"""Cases of step 08: what comes through glass."""

from dataclasses import dataclass, replace

from raysteps.judge.answers import Answer, first
from raysteps.judge.comparing import channels, direction
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.refraction_glass import any_hit, hit_on_glass, index_of_glass, simple_hit
from raysteps.judge.numbers import Vector, length, minus
from raysteps.judge.rays import hit_of
from raysteps.judge.scripts import MOST_ASKED
from raysteps.judge.tokens import Tokens
from raysteps.judge.values import Hit, Inputs, Ray, Vec, Whole, vector_words

_AT_THE_HIT = 0.5  # a ray that starts farther away from the hit was not made by transmitted_ray


@dataclass(frozen=True)
class _Brought:
    """The colour, and the rays that were traced for it."""

    color: Vector
    traced: tuple[tuple[Ray, int], ...]


def _read_brought(tokens: Tokens) -> _Brought:
    color = tokens.vector()
    count = tokens.whole(0, MOST_ASKED)
    return _Brought(
        color, tuple((Ray(tokens.vector(), tokens.vector()), tokens.whole(-MOST_ASKED)) for _ in range(count))
    )


def _brought_words(answer: _Brought) -> str:
    traced = "; ".join(f"{ray.words()} at depth {depth}" for ray, depth in answer.traced) or "none"
    return f"colour {vector_words(answer.color)}; rays traced: {traced}"


def _same_way(hit: Hit, expected: Ray, actual: Ray) -> str:
    """Where exactly the ray starts is transmitted_ray's matter, and so is its direction where the glass is index 1:
    a mistake there alone must not make all of transmitted_light wrong."""
    if not length(minus(actual.origin, hit.position)) <= _AT_THE_HIT:
        return "the traced ray does not start at the hit"
    return "" if hit.fill.index == 1 else direction("the traced ray's direction", expected.direction, actual.direction)


def _brought_problem(inputs: Inputs, expected: _Brought, actual: _Brought) -> str:
    if len(expected.traced) != len(actual.traced):
        return f"too {'many' if len(actual.traced) > len(expected.traced) else 'few'} rays were traced"
    hit = hit_of(inputs)
    problems = [
        first(
            _same_way(hit, mine[0], theirs[0]),
            "" if mine[1] == theirs[1] else "the depth of the traced ray is wrong",
        )
        for mine, theirs in zip(expected.traced, actual.traced, strict=True)
    ]
    return first(*problems, channels("the colour", expected.color, actual.color))


def _light(draw: Draw, hit: Hit) -> Inputs:
    return {"hit": hit, "depth": Whole(draw.whole(1, 6)), "traced": Vec(draw.color())}


def _faint(draw: Draw) -> Inputs:
    """Any transmittance above 0 lets light through, and 1 all of it."""
    hit = any_hit(draw)
    share = draw.real(0.001, 0.01) if draw.chance(0.5) else 1.0
    return _light(draw, replace(hit, fill=replace(hit.fill, transmittance=share)))


def _not_glass(draw: Draw) -> Inputs:
    hit = any_hit(draw)
    return _light(draw, replace(hit, fill=replace(hit.fill, transmittance=0.0)))


TRANSMITTED_LIGHT = Function(
    "transmitted_light",
    Answer(_read_brought, _brought_words, _brought_problem),
    (
        Group("glass of index 1", lambda d: _light(d, hit_on_glass(d, 1.0, outside=d.chance(0.5)))),
        Group("any hit on glass", lambda d: _light(d, any_hit(d))),
        Group("simple numbers", lambda d: _light(d, simple_hit(d))),
        Group(
            "total internal reflection",
            lambda d: _light(d, hit_on_glass(d, index_of_glass(d), outside=False, total=True)),
        ),
        Group("hardly and wholly clear", _faint),
        Group("not of glass", _not_glass, telling=False),
    ),
)
