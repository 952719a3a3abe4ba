"""Cases of step 08: refracted directions, transmitted rays, and what comes through glass."""

import math
from dataclasses import dataclass, replace

from raysteps.common.vectors import Vector, dot, length, minus, times
from raysteps.judge.answers import Answer, channels, direction, first, plainly_wrong
from raysteps.judge.functions import Function, Group
from raysteps.judge.hits import TRANSMITTED_RAY, hit_of
from raysteps.judge.protocol import (
    Fill,
    Hit,
    Inputs,
    ProtocolError,
    Ray,
    Real,
    TokenReader,
    Vec,
    Whole,
    f32,
    rounded,
    vector_words,
)
from raysteps.judge.random_source import RandomSource
from raysteps.judge.scripted_tracer import MAX_ASKED

# What the cases of step 08 share: glass, and rays that meet it on this or that side of the critical angle.

_CLEAR = 0.05  # how far the sine of a refracted ray keeps from 1, where rounding decides


def index_of_glass(draw: RandomSource) -> float:
    """Also the eta of a ray that leaves it."""
    return draw.real(1.2, 2.2)


def into(draw: RandomSource) -> float:
    """The eta of a ray that enters glass."""
    return f32(1 / index_of_glass(draw))


def _sine(eta: float, cosine: float) -> float:
    return eta * math.sqrt(1 - min(1.0, cosine * cosine))


def directions(draw: RandomSource, eta: float, *, total: bool) -> tuple[Vector, Vector]:
    """Ray and normal, on this or that side of the critical angle."""

    def make() -> tuple[Vector, Vector]:
        normal = draw.direction()
        return rounded(times(-1.0, draw.above(normal, 0.05))), normal

    def clear(found: tuple[Vector, Vector]) -> bool:
        sine = _sine(eta, dot(*found))
        return sine > 1 + _CLEAR if total else sine < 1 - _CLEAR

    return draw.until(clear, make)


def hit_on_glass(draw: RandomSource, index: float, *, outside: bool, total: bool = False) -> Hit:
    eta = (1 / index if outside else index) if index > 0 else 1.0
    ray, normal = directions(draw, eta, total=total)
    fill = replace(draw.fill(), transmittance=draw.real(0.2, 1.0), index=index)
    return Hit(draw.point(3), normal, ray, draw.real(1, 9), fill, outside)


def random_hit(draw: RandomSource) -> Hit:
    if draw.chance(0.2):
        return hit_on_glass(draw, index_of_glass(draw), outside=False, total=True)
    return hit_on_glass(draw, index_of_glass(draw), outside=draw.chance(0.5))


def simple_hit(draw: RandomSource) -> Hit:
    """Straight down into or out of glass of index 1.5."""
    normal = draw.axis()
    fill = Fill(transmittance=0.5, index=1.5)
    return Hit((0.0, 0.0, 0.0), normal, times(-1.0, normal), 1.0, fill, draw.chance(0.5))


# Cases of step 08: refracted directions.


@dataclass(frozen=True)
class _Refracted:
    """A direction, or nothing."""

    direction: Vector | None


def _read_refracted(tokens: TokenReader) -> _Refracted:
    word = tokens.word()
    if word not in ("none", "direction"):
        raise ProtocolError("the answer is neither a direction nor nothing")
    return _Refracted(tokens.vector() if word == "direction" else None)


def _refracted_words(answer: _Refracted) -> str:
    return "nothing (total internal reflection)" if answer.direction is None else vector_words(answer.direction)


def _refracted_problem(_inputs: Inputs, expected: _Refracted, actual: _Refracted) -> str:
    if expected.direction is None:
        return "" if actual.direction is None else "refraction is impossible, and a direction came"
    if actual.direction is None:
        return "refraction is possible, and nothing came"
    return direction("the direction", expected.direction, actual.direction)


def _refract(draw: RandomSource, eta: float, *, total: bool = False) -> Inputs:
    ray, normal = directions(draw, eta, total=total)
    return {"direction": Vec(ray), "normal": Vec(normal), "eta": Real(eta)}


def _any_refract(draw: RandomSource) -> Inputs:
    if draw.chance(0.2):
        return _refract(draw, index_of_glass(draw), total=True)
    return _refract(draw, into(draw) if draw.chance(0.5) else index_of_glass(draw))


def _straight(draw: RandomSource) -> Inputs:
    normal = draw.axis()
    eta = (f32(1 / 1.5), 1.0, 1.5)[draw.whole(0, 2)]
    return {"direction": Vec(times(-1.0, normal)), "normal": Vec(normal), "eta": Real(eta)}


def _close_to_critical(draw: RandomSource) -> Inputs:
    """Out of glass, a little before total reflection or beyond it."""
    eta, normal = index_of_glass(draw), draw.direction()
    sine = (draw.fine(0.97, 0.985) if draw.chance(0.5) else draw.fine(1.015, 1.03)) / eta
    cosine = math.sqrt(1 - sine * sine)
    return {
        "direction": Vec(rounded(times(-1.0, draw.above(normal, cosine, cosine)))),
        "normal": Vec(normal),
        "eta": Real(eta),
    }


def _head_on(draw: RandomSource) -> Inputs:
    """1 - cos^2 is 0, or by rounding a little less."""
    normal = draw.direction()
    eta = into(draw) if draw.chance(0.5) else index_of_glass(draw)
    return {"direction": Vec(times(-1.0, normal)), "normal": Vec(normal), "eta": Real(eta)}


def _almost_head_on(draw: RandomSource) -> Inputs:
    """At 2 to 5 degrees the ray bends by a third of a degree and more: who sends it straight on there is wrong."""
    normal, eta = draw.direction(), into(draw) if draw.chance(0.5) else index_of_glass(draw)
    angle = math.radians(draw.real(2, 5))
    direction = rounded(times(-1.0, draw.above(normal, math.cos(angle), math.cos(angle))))
    return {"direction": Vec(direction), "normal": Vec(normal), "eta": Real(eta)}


def _grazing(draw: RandomSource) -> Inputs:
    """Into glass, almost along its surface."""
    normal = draw.direction()
    direction = rounded(times(-1.0, draw.above(normal, 0.02, 0.08)))
    return {"direction": Vec(direction), "normal": Vec(normal), "eta": Real(into(draw))}


REFRACT = Function(
    "refract",
    Answer(_read_refracted, _refracted_words, _refracted_problem),
    (
        Group("any direction", _any_refract),
        Group("straight on", _straight),
        Group("into glass", lambda d: _refract(d, into(d))),
        Group("out of glass", lambda d: _refract(d, index_of_glass(d))),
        Group("eta 1", lambda d: _refract(d, 1.0)),
        Group("strong glass", lambda d: _refract(d, d.real(0.25, 0.4) if d.chance(0.5) else d.real(2.5, 4))),
        Group("head-on", _head_on),
        Group("almost head-on", _almost_head_on),
        Group("almost along the surface", _grazing),
        Group("close to the critical angle", _close_to_critical),
        Group("total internal reflection", lambda d: _refract(d, index_of_glass(d), total=True)),
    ),
)


# Cases of step 08: what comes through glass.

_AT_THE_HIT = 0.5  # a ray that starts farther away from the hit was not made by transmitted_ray


@dataclass(frozen=True)
class _TransmittedLight:
    """The colour, and the rays that were traced for it."""

    color: Vector
    traced: tuple[tuple[Ray, int], ...]


def _read_brought(tokens: TokenReader) -> _TransmittedLight:
    color = tokens.vector()
    count = tokens.whole(0, MAX_ASKED)
    return _TransmittedLight(
        color, tuple((Ray(tokens.vector(), tokens.vector()), tokens.whole(-MAX_ASKED)) for _ in range(count))
    )


def _brought_words(answer: _TransmittedLight) -> str:
    traced = "; ".join(f"{ray.words()} at depth {depth}" for ray, depth in answer.traced) or "none"
    return f"colour {vector_words(answer.color)}; rays traced: {traced}"


def _same_way(hit: Hit, expected: Ray, actual: Ray) -> str:
    """Where exactly the ray starts is transmitted_ray's matter, and so is its direction where the glass is index 1:
    a mistake there alone must not make all of transmitted_light wrong."""
    if not length(minus(actual.origin, hit.position)) <= _AT_THE_HIT:
        return "the traced ray does not start at the hit"
    return "" if hit.fill.index == 1 else direction("the traced ray's direction", expected.direction, actual.direction)


def _brought_problem(inputs: Inputs, expected: _TransmittedLight, actual: _TransmittedLight) -> str:
    return first(_traced_problem(inputs, expected, actual), channels("the colour", expected.color, actual.color))


def _traced_problem(inputs: Inputs, expected: _TransmittedLight, actual: _TransmittedLight) -> str:
    if _is_past_the_limit(inputs) and not actual.traced:
        return ""
    if len(expected.traced) != len(actual.traced):
        return f"too {'many' if len(actual.traced) > len(expected.traced) else 'few'} rays were traced"
    hit = hit_of(inputs)
    problems = [
        first(
            _same_way(hit, mine[0], theirs[0]),
            "" if mine[1] == theirs[1] else plainly_wrong("the depth of the traced ray"),
        )
        for mine, theirs in zip(expected.traced, actual.traced, strict=True)
    ]
    return first(*problems)


def _brought_credit(inputs: Inputs, expected: _TransmittedLight, actual: _TransmittedLight) -> float:
    """Another ray with the right colour, or the right ray with another colour."""
    if not channels("", expected.color, actual.color):
        return 0.5
    return 0.5 if expected.traced and not _traced_problem(inputs, expected, actual) else 0.0


def _brings(hit: Hit, depth: int, most: int, traced: Vector) -> Inputs:
    return {"hit": hit, "depth": Whole(depth), "max_ray_depth": Whole(most), "traced": Vec(traced)}


def _light(draw: RandomSource, hit: Hit) -> Inputs:
    """The ray that goes on is one deeper, and one that is still followed."""
    most = draw.whole(2, 12)
    return _brings(hit, draw.whole(1, most - 1), most, draw.color())


def _deepest(draw: RandomSource) -> Inputs:
    most = draw.whole(2, 12)
    return _brings(random_hit(draw), most - 1, most, draw.color())


def _past_the_limit(draw: RandomSource) -> Inputs:
    """The ray that goes on is one too deep. It brings nothing, and who knows that need not send it."""
    most = draw.whole(1, 12)
    return _brings(random_hit(draw), most, most, (0.0, 0.0, 0.0))


def _is_past_the_limit(inputs: Inputs) -> bool:
    depth, most = inputs["depth"], inputs["max_ray_depth"]
    assert isinstance(depth, Whole)
    assert isinstance(most, Whole)
    return depth.value >= most.value


def _bright(draw: RandomSource) -> Inputs:
    hit = random_hit(draw)
    hit = replace(hit, fill=replace(hit.fill, transmittance=draw.real(0.6, 1.0)))
    most = draw.whole(2, 12)
    return _brings(hit, draw.whole(1, most - 1), most, draw.color(2.0, 9.0))


def _faint(draw: RandomSource) -> Inputs:
    """Any transmittance above 0 lets light through, and 1 all of it."""
    hit = random_hit(draw)
    share = draw.real(0.001, 0.01) if draw.chance(0.5) else 1.0
    return _light(draw, replace(hit, fill=replace(hit.fill, transmittance=share)))


def _not_glass(draw: RandomSource) -> Inputs:
    hit = random_hit(draw)
    return _light(draw, replace(hit, fill=replace(hit.fill, transmittance=0.0)))


TRANSMITTED_LIGHT = Function(
    "transmitted_light",
    Answer(_read_brought, _brought_words, _brought_problem, _brought_credit),
    (
        Group("glass of index 1", lambda d: _light(d, hit_on_glass(d, 1.0, outside=d.chance(0.5)))),
        Group("any hit on glass", lambda d: _light(d, random_hit(d))),
        Group("simple numbers", lambda d: _light(d, simple_hit(d))),
        Group(
            "total internal reflection",
            lambda d: _light(d, hit_on_glass(d, index_of_glass(d), outside=False, total=True)),
        ),
        Group("hardly and wholly clear", _faint),
        Group("brighter than 1", _bright),
        Group("the deepest ray", _deepest),
        Group("past the depth limit", _past_the_limit),
        Group("not of glass", _not_glass),
    ),
)


def _unbent(draw: RandomSource, index: float) -> Inputs:
    return {"hit": hit_on_glass(draw, index, outside=draw.chance(0.5))}


def _bubble(draw: RandomSource) -> Inputs:
    """Of air in glass: it is from outside that light may be unable to enter it."""
    index = f32(1 / index_of_glass(draw))
    total = draw.chance(0.3)
    return {"hit": hit_on_glass(draw, index, outside=total or draw.chance(0.5), total=total)}


_TRANSMITTED_RAY = Function(
    "transmitted_ray",
    TRANSMITTED_RAY,
    (
        Group("any hit on glass", lambda d: {"hit": random_hit(d)}),
        Group("simple numbers", lambda d: {"hit": simple_hit(d)}),
        Group("into glass", lambda d: {"hit": hit_on_glass(d, index_of_glass(d), outside=True)}),
        Group("out of glass", lambda d: {"hit": hit_on_glass(d, index_of_glass(d), outside=False)}),
        Group(
            "total internal reflection",
            lambda d: {"hit": hit_on_glass(d, index_of_glass(d), outside=False, total=True)},
        ),
        Group("index 1", lambda d: _unbent(d, 1.0)),
        Group("index 0 counts as 1", lambda d: _unbent(d, 0.0)),
        Group("index below 1", _bubble),
    ),
)

FUNCTIONS = (REFRACT, _TRANSMITTED_RAY, TRANSMITTED_LIGHT)
