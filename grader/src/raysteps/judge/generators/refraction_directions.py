"""Cases of step 08: refracted directions."""

import math
from dataclasses import dataclass

from raysteps.judge.answers import Answer
from raysteps.judge.comparing import direction
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.refraction_glass import directions, index_of_glass, into
from raysteps.judge.numbers import Vector, f32, rounded, times
from raysteps.judge.tokens import Garbled, Tokens
from raysteps.judge.values import Inputs, Real, Vec, vector_words


@dataclass(frozen=True)
class _Refracted:
    """A direction, or nothing."""

    direction: Vector | None


def _read_refracted(tokens: Tokens) -> _Refracted:
    word = tokens.word()
    if word not in ("none", "direction"):
        raise Garbled("the answer is neither a direction nor nothing")
    return _Refracted(tokens.vector() if word == "direction" else None)


def _refracted_words(answer: _Refracted) -> str:
    return "nothing (total internal reflection)" if answer.direction is None else vector_words(answer.direction)


def _refracted_problem(_inputs: Inputs, expected: _Refracted, actual: _Refracted) -> str:
    if expected.direction is None:
        return "" if actual.direction is None else "refraction is impossible, and a direction came"
    if actual.direction is None:
        return "refraction is possible, and nothing came"
    return direction("the direction", expected.direction, actual.direction)


def _refract(draw: Draw, eta: float, *, total: bool = False) -> Inputs:
    ray, normal = directions(draw, eta, total=total)
    return {"direction": Vec(ray), "normal": Vec(normal), "eta": Real(eta)}


def _any_refract(draw: Draw) -> Inputs:
    if draw.chance(0.2):
        return _refract(draw, index_of_glass(draw), total=True)
    return _refract(draw, into(draw) if draw.chance(0.5) else index_of_glass(draw))


def _straight(draw: Draw) -> Inputs:
    normal = draw.axis()
    eta = (f32(1 / 1.5), 1.0, 1.5)[draw.whole(0, 2)]
    return {"direction": Vec(times(-1.0, normal)), "normal": Vec(normal), "eta": Real(eta)}


def _close_to_critical(draw: Draw) -> Inputs:
    """Out of glass, a little before total reflection or beyond it."""
    eta, normal = index_of_glass(draw), draw.direction()
    sine = (draw.fine(0.97, 0.985) if draw.chance(0.5) else draw.fine(1.015, 1.03)) / eta
    cosine = math.sqrt(1 - sine * sine)
    return {
        "direction": Vec(rounded(times(-1.0, draw.above(normal, cosine, cosine)))),
        "normal": Vec(normal),
        "eta": Real(eta),
    }


def _head_on(draw: Draw) -> Inputs:
    """1 - cos^2 is 0, or by rounding a little less."""
    normal = draw.direction()
    eta = into(draw) if draw.chance(0.5) else index_of_glass(draw)
    return {"direction": Vec(times(-1.0, normal)), "normal": Vec(normal), "eta": Real(eta)}


def _grazing(draw: Draw) -> Inputs:
    """Into glass, almost along its surface."""
    normal = draw.direction()
    direction = rounded(times(-1.0, draw.above(normal, 0.02, 0.08)))
    return {"direction": Vec(direction), "normal": Vec(normal), "eta": Real(into(draw))}


REFRACT = Function(
    "refract",
    Answer(_read_refracted, _refracted_words, _refracted_problem),
    (
        Group("any direction", _any_refract, telling=False),
        Group("straight on", _straight),
        Group("into glass", lambda d: _refract(d, into(d))),
        Group("out of glass", lambda d: _refract(d, index_of_glass(d))),
        Group("eta 1", lambda d: _refract(d, 1.0)),
        Group("strong glass", lambda d: _refract(d, d.real(0.25, 0.4) if d.chance(0.5) else d.real(2.5, 4))),
        Group("head-on", _head_on),
        Group("almost along the surface", _grazing),
        Group("close to the critical angle", _close_to_critical, telling=False),
        Group("total internal reflection", lambda d: _refract(d, index_of_glass(d), total=True), telling=False),
    ),
)
