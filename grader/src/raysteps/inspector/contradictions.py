"""Hit records that contradict their ray: told without the reference, by what the contract promises."""

from collections.abc import Iterator
from typing import NamedTuple

from raysteps.inspector.model import Hit, Ray, Record
from raysteps.inspector.records import (
    as_float,
    brief,
    dot,
    intersect_of,
    length,
    minus,
    point,
    same_direction,
)

_CLOSE = 1e-3  # of how far the ray went; numbers of a single float come much closer


class Contradiction(NamedTuple):
    """What is wrong with the record, and the function that makes it."""

    words: str
    function: str


def _of_hit(ray: Ray, hit: Hit) -> Iterator[str]:
    """In the order of the record's fields."""
    along = [as_float(o) + as_float(hit.distance) * as_float(d) for o, d in zip(ray.origin, ray.direction, strict=True)]
    reach = max(1.0, as_float(hit.distance) * length(ray.direction), length(ray.origin))
    if not length(minus(hit.position, along)) <= _CLOSE * reach:
        yield (
            f"position is {point(hit.position)}, but distance {brief(hit.distance)} along the ray lies {point(along)}"
        )
    if not abs(length(hit.normal) - 1) <= _CLOSE:
        yield f"normal has length {brief(length(hit.normal))}; it must be 1"
    elif dot(hit.normal, ray.direction) > _CLOSE:
        yield "normal points away from where the ray came from; it must point to that side"
    if not same_direction(hit.ray_direction, ray.direction, _CLOSE):
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
