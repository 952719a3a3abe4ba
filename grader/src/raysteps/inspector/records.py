"""Numbers, points and colours of a record, and when two of them are the same. Its vectors are JSON, where a number that
is not finite is a word: they have an algebra of their own."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from raysteps.inspector.model import Accel, Hit, LampSample, Light, LightShare, Number, Ray, Record

Vector = Sequence[Number]

CLOSE = 1e-4  # share by which rounding alone may move a number of a right solution
_COARSEST = 0.3
_NORMAL = 1e-3  # on small spheres rounding moves a normal more than a position
_DARKEST = 2e-5  # colours below differ by less than anybody could see


def as_float(value: Number) -> float:
    return float(value)


def length(vector: Vector) -> float:
    return math.hypot(*map(as_float, vector))


def minus(one: Vector, other: Vector) -> list[float]:
    return [as_float(a) - as_float(b) for a, b in zip(one, other, strict=True)]


def dot(one: Vector, other: Vector) -> float:
    return sum(as_float(a) * as_float(b) for a, b in zip(one, other, strict=True))


def is_finite(vector: Vector) -> bool:
    return all(math.isfinite(as_float(value)) for value in vector)


def same_number(one: Number, other: Number, close: float, least: float = 1e-6) -> bool:
    a, b = as_float(one), as_float(other)
    if not (math.isfinite(a) and math.isfinite(b)):
        return a == b or (math.isnan(a) and math.isnan(b))
    return abs(a - b) <= max(least, close * max(abs(a), abs(b)))


def same_point(one: Vector, other: Vector, close: float, reach: float) -> bool:
    """`reach`: how far the numbers come that both were computed from."""
    if not (is_finite(one) and is_finite(other)):
        return list(map(str, one)) == list(map(str, other))
    return length(minus(one, other)) <= close * max(reach, length(other), 1e-3)


def same_direction(one: Vector, other: Vector, close: float = 0.0) -> bool:
    """Of length 1, too."""
    if not (is_finite(one) and is_finite(other)):
        return list(map(str, one)) == list(map(str, other))
    return length(minus(one, other)) <= max(_NORMAL, close)


def same_color(one: Vector | None, other: Vector | None, close: float) -> bool:
    if one is None or other is None:
        return one is other
    return all(same_number(a, b, close, _DARKEST) for a, b in zip(one, other, strict=True))


def coarser(one: Ray, other: Ray) -> float:
    """How close two rays can be expected to end that begin like these."""
    apart = length(minus(one.origin, other.origin)) + length(minus(one.direction, other.direction))
    return min(_COARSEST, CLOSE + 30 * apart) if math.isfinite(apart) else CLOSE


def diverged(mine: Vector | None, reference: Vector | None, expected: Vector | None, close: float) -> bool:
    """Whether two colours differ, and mine does not follow from what it was made of."""
    if same_color(mine, reference, close):
        return False
    return mine is None or expected is None or not same_color(mine, expected, 10 * CLOSE)


def brief(value: Number) -> str:
    return value if isinstance(value, str) else f"{value:.5g}"


def point(vector: Vector) -> str:
    return f"({', '.join(map(brief, vector))})"


def told(color: Vector | None) -> str:
    return "unknown" if color is None else point(color)


# The same ray in two records.

EYE = "eye"


SHAPES = {"sphere": "Sphere", "triangle": "Triangle", "smooth-triangle": "Triangle"}  # that the steps meet


def intersect_of(kind: str) -> str:
    """The step's function that meets a surface of this kind; nothing for one that the framework meets."""
    return f"{SHAPES[kind]}::intersect" if kind in SHAPES else ""


class Difference(NamedTuple):
    """`place` is the key of a line of the tree; `function` is empty where no step's function is to blame."""

    place: tuple[str, ...]
    words: str
    function: str
    why: str = ""
    ill_conditioned: bool = False  # the two rays began a little apart already, so that an edge may lie between them


@dataclass(frozen=True)
class Pair:
    """The same ray in both records, `place` being its line in the tree."""

    mine: Ray
    reference: Ray
    place: tuple[str, ...]
    name: str
    close: float
    step: int
    accel: Accel
    lights: list[Light]

    def at(self, item: str, words: str, function: str, why: str = "") -> Difference:
        plain = self.place == (EYE,) and not words.startswith("yours")  # what else happens at the eye ray needs no name
        return Difference(
            (*self.place, item), words if plain else f"{self.name}: {words}", function, why, self.ill_conditioned
        )

    @property
    def hits(self) -> tuple[Hit, Hit]:
        """Of two rays that both meet something."""
        assert self.mine.hit is not None
        assert self.reference.hit is not None
        return self.mine.hit, self.reference.hit

    @property
    def ill_conditioned(self) -> bool:
        return self.close > 2 * CLOSE


def surface_name(hit: Hit) -> str:
    return "something that is no surface" if hit.surface is None else f"surface {hit.surface} ({hit.kind})"


def shadow_words(light: LightShare | LampSample) -> str:
    """Of one that does not arrive: what stands in its way."""
    hit = light.rays[-1].hit if light.rays else None
    return "blocked" if hit is None else f"blocked by {surface_name(hit)} at distance {brief(hit.distance)}"


def not_unit(direction: Vector, close: float = 1e-3) -> str:
    """Says so of a direction whose length is not 1."""
    size = length(direction)
    return "" if abs(size - 1) < close else f"its length is {size:.4g} and not 1"


def meets(hit: Hit | None) -> str:
    return "meets nothing" if hit is None else f"meets {surface_name(hit)} at distance {brief(hit.distance)}"


def same_meeting(one: Hit | None, other: Hit | None, close: float) -> bool:
    """Two surfaces at the same distance are the same where they look the same."""
    if one is None or other is None:
        return one is other
    alike = one.surface == other.surface or (one.fill == other.fill and same_direction(one.normal, other.normal, close))
    return alike and same_number(one.distance, other.distance, close, 1e-5)


def same_way(mine: Ray, reference: Ray) -> bool:
    """Whether a path goes on as the other does; so do rays that are no path's."""
    if mine.path is None or reference.path is None:
        return True
    pairs = zip(mine.bounces, reference.bounces, strict=False)
    ways = all(same_direction(own.direction, theirs.direction) for own, theirs in pairs)
    return ways and len(mine.bounces) == len(reference.bounces)


def same_samples(mine: Ray, reference: Ray) -> bool:
    """Whether the samples of lamps at these hits, and at those of the rays that follow, took the same points and came
    from there, and a path goes the same way. Where no density is above 0 the point means nothing."""
    reach = length(reference.hit.position) if reference.hit is not None else 0.0
    pairs = zip(mine.lamps, reference.lamps, strict=False)
    return (
        same_way(mine, reference)
        and all(
            own.lit == theirs.lit and same_point(own.position, theirs.position, 10 * CLOSE, reach)
            for own, theirs in pairs
            if as_float(own.pdf) > 0 and as_float(theirs.pdf) > 0
        )
        and all(same_samples(*bounces) for bounces in zip(mine.bounces, reference.bounces, strict=False))
    )


def agreement(mine: Record, reference: Record) -> str:
    """What is said of two that do not part."""
    if same_samples(mine.ray, reference.ray):
        return "both come to the same colour in the same way"
    others = "the samples of lamps took other points, or shadow rays began elsewhere"
    others += ", or the path went another way" if mine.ray.path is not None else ""
    return (
        f"{others}, as they may; nothing is wrong with any of that by itself. "
        "How points and ways are spread one pixel does not show"
    )


# Hit records that contradict their ray: told without the reference, by what the contract promises.

_RECORD_TOLERANCE = 1e-3  # of how far the ray went; numbers of a single float come much closer


class Contradiction(NamedTuple):
    """What is wrong with the record, and the function that makes it."""

    words: str
    function: str


def _of_hit(ray: Ray, hit: Hit) -> Iterator[str]:
    """In the order of the record's fields."""
    along = [as_float(o) + as_float(hit.distance) * as_float(d) for o, d in zip(ray.origin, ray.direction, strict=True)]
    reach = max(1.0, as_float(hit.distance) * length(ray.direction), length(ray.origin))
    if not length(minus(hit.position, along)) <= _RECORD_TOLERANCE * reach:
        yield (
            f"position is {point(hit.position)}, but distance {brief(hit.distance)} along the ray lies {point(along)}"
        )
    if not abs(length(hit.normal) - 1) <= _RECORD_TOLERANCE:
        yield f"normal has length {brief(length(hit.normal))}; it must be 1"
    elif dot(hit.normal, ray.direction) > _RECORD_TOLERANCE:
        yield "normal points away from where the ray came from; it must point to that side"
    if not same_direction(hit.ray_direction, ray.direction, _RECORD_TOLERANCE):
        yield f"ray_direction is {point(hit.ray_direction)}, but the ray goes towards {point(ray.direction)}"


def _all_rays(ray: Ray) -> Iterator[Ray]:
    """Without shadow rays, of which nobody reads the record."""
    yield ray
    for bounce in ray.bounces:
        yield from _all_rays(bounce)


def contradiction(record: Record) -> Contradiction | None:
    """The first, in the order in which the rays were cast. A smooth triangle's own normal may lean away."""
    for ray in _all_rays(record.ray):
        hit = ray.hit
        if hit is None or not intersect_of(hit.kind) or hit.kind == "smooth-triangle":
            continue
        for words in _of_hit(ray, hit):
            return Contradiction(words, intersect_of(hit.kind))
    return None
