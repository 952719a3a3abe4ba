"""Answers that are hit records."""

from dataclasses import dataclass

from raysteps.judge.answers import Answer, first
from raysteps.judge.comparing import LENGTHS, SMALL, channels, direction, real, vector
from raysteps.judge.tokens import Garbled, Tokens
from raysteps.judge.values import Fill, Hit, Inputs

_LISTED = 256  # surface i of a list has red i / 256


@dataclass(frozen=True)
class MaybeHit:
    """A hit record, or a miss."""

    hit: Hit | None


def read_hit(tokens: Tokens) -> MaybeHit:
    kind = tokens.word()
    if kind == "miss":
        return MaybeHit(None)
    if kind != "hit":
        raise Garbled("the answer is neither a hit nor a miss")
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
    sides = "" if expected.from_outside == actual.from_outside else "from_outside is wrong"
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
