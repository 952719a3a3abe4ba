"""Where samples of area lights part. Which point of a lamp a sample takes is up to each solution: so each is held
against what its contract says of the point that it took."""

from collections.abc import Iterator

from raysteps.inspector.blame import SAME_START, blame_shadow, sampled, start_problem
from raysteps.inspector.model import Hit, LampSample, Ray
from raysteps.inspector.records import (
    CLOSE,
    Difference,
    Pair,
    Vector,
    as_float,
    brief,
    diverged,
    dot,
    is_finite,
    length,
    minus,
    not_unit,
    point,
    same_direction,
    same_number,
    same_point,
    shadow_words,
)

_PDF = 10 * CLOSE  # share; where a lamp is seen along its surface, rounding moves it more
_LEAST_COSINE = 0.02
_FIRST_MATERIALS = 14  # the step from which on a surface may be metal


def _rounding(pair: Pair, *points: Vector) -> float:
    """How far it may move a point that is computed from these and the hit."""
    return 10 * pair.close * max(1.0, *map(length, (pair.hits[1].position, *points)))


def _is_touched(pair: Pair, lamp: LampSample, hit: Hit) -> bool:
    """Whether rounding decides if the hit sees the lamp. From the surface of a ball nothing is seen but the hit."""
    way = minus(hit.position, lamp.position)
    if lamp.shape == "sphere":
        return length(way) <= 10 * _rounding(pair)
    return abs(dot(lamp.normal, way)) <= _rounding(pair)


def _area_pdf(lamp: LampSample, hit: Hit, normal: Vector) -> float | None:
    """The density by area that the one by solid angle stands for; nothing where the lamp is seen along its surface."""
    back = minus(hit.position, lamp.position)
    size = length(back)
    cosine = dot(normal, back) / size if size > 0 else 0.0
    return as_float(lamp.pdf) * cosine / (size * size) if cosine > _LEAST_COSINE else None


def _same_pdf(pair: Pair, own: LampSample, theirs: LampSample) -> bool:
    if own.shape == "sphere":
        return same_number(own.pdf, theirs.pdf, _PDF + pair.close)
    areas = [_area_pdf(lamp, hit, theirs.normal) for lamp, hit in zip((own, theirs), pair.hits, strict=True)]
    return areas[0] is None or areas[1] is None or same_number(areas[0], areas[1], _PDF + pair.close)


def _on_the_same_lamp(pair: Pair, own: LampSample, theirs: LampSample) -> bool:
    """Two points of a plane, or two of a sphere whose normals differ as they do."""
    apart, turned = minus(own.position, theirs.position), minus(own.normal, theirs.normal)
    rounding = _rounding(pair, theirs.position)
    if own.shape != "sphere":
        return abs(dot(apart, theirs.normal)) <= rounding
    radius = length(apart) / max(length(turned), 1e-6)
    return length(minus(apart, [radius * part for part in turned])) <= 0.02 * length(apart) + rounding


def _why_pdf(lamp: LampSample) -> str:
    return "" if lamp.shape == "sphere" else "or solid_angle_pdf"


def _sample(pair: Pair, own: LampSample, theirs: LampSample) -> Iterator[tuple[str, str, str]]:
    """The point, its normal and its density: words, function and why."""
    function = f"sample_{own.shape}"
    pdfs = [as_float(own.pdf), as_float(theirs.pdf)]
    if pdfs == [0, 0]:
        return
    seen, hit = (theirs, pair.hits[1]) if pdfs[1] > 0 else (own, pair.hits[0])
    if is_finite(pdfs) and _is_touched(pair, seen, hit):
        return
    if 0 in pdfs:
        yield f"its pdf is {brief(own.pdf)}, the reference's {brief(theirs.pdf)}", function, _why_pdf(own)
        return
    if not is_finite([*own.position, own.pdf]):
        yield f"yours is at {point(own.position)} with pdf {brief(own.pdf)}", function, ""
    strays = own.shape != "sphere" and not same_direction(own.normal, theirs.normal)
    # where few digits of a small, far ball are left, its point may lie beside it
    long = not_unit(own.normal, 1e-2 + 3e-6 * pdfs[1] if own.shape == "sphere" else 1e-3)
    if strays or long:
        words = f"its normal is {point(own.normal)}, the reference's {point(theirs.normal)}"
        yield words, function, long
    away = dot(own.normal, minus(pair.hits[0].position, own.position))
    if own.shape == "sphere" and not away > -CLOSE * max(1.0, length(own.position)):
        yield f"at {point(own.position)} its normal {point(own.normal)} points away from the hit", function, ""
    if not _on_the_same_lamp(pair, own, theirs):
        yield f"yours at {point(own.position)} with the normal {point(own.normal)} is off the lamp", function, ""
    if not _same_pdf(pair, own, theirs):
        words = f"its pdf is {brief(own.pdf)} at {point(own.position)}, the reference's {brief(theirs.pdf)}"
        yield f"{words} at {point(theirs.position)}", function, _why_pdf(own)


def _meets(ray: Ray, size: float) -> bool:
    """Something before the lamp."""
    return ray.hit is not None and as_float(ray.hit.distance) < size - 0.02


def _is_at_an_edge(pair: Pair, ray: Ray, other: Ray, size: float) -> bool:
    """Whether two rays that begin where they may, but apart, pass an edge on both sides; one of the lamp is none."""
    is_apart = length(minus(ray.origin, other.origin)) > SAME_START and ray.missed is None
    problem = start_problem(ray, pair.hits[0], 1)
    if "itself" in problem and not _meets(ray, 0.04):  # it got off the surface
        problem = ""
    return is_apart and _meets(ray, size) != _meets(other, size) and not problem


def _shadow(pair: Pair, own: LampSample, theirs: LampSample) -> Iterator[tuple[str, str, str]]:
    if own.is_dark:  # its point may lie below the horizon
        return
    if not own.rays:
        if theirs.rays and own.lit != theirs.lit:
            yield "yours casts no shadow ray", "is_lit", ""
        return
    ray = own.rays[-1]
    way = minus(own.position, ray.origin)
    size = length(way)
    if size > 0.1 and not same_direction(ray.direction, [part / size for part in way], 10 * pair.close + 0.01 / size):
        yield f"its shadow ray goes towards {point(ray.direction)}, not to the sample", "shadow_ray", ""
    elif theirs.rays and own.lit != theirs.lit and same_point(own.position, theirs.position, CLOSE, 1.0):
        if own.lit != _meets(ray, size) and _is_at_an_edge(pair, ray, theirs.rays[-1], size):
            return
        function, why = blame_shadow(ray, theirs.rays[-1], pair.hits[0], pair.accel, lit=own.lit)
        verdicts = ["free" if lamp.lit else shadow_words(lamp) for lamp in (own, theirs)]
        yield f"its shadow ray is {verdicts[0]}, the reference's is {verdicts[1]}", function, why


def lamp_differences(pair: Pair) -> Iterator[Difference]:
    """Each sample: where it lies, what it could bring, and what stands between."""
    for number, (own, theirs) in enumerate(zip(pair.mine.lamps, pair.reference.lamps, strict=False), start=1):
        if own.lamp != theirs.lamp:
            return
        name = f"sample of lamp {own.lamp + 1}"
        for words, function, why in _sample(pair, own, theirs):
            yield pair.at(f"lamp{number}", f"{name}: {words}", function, why)
        hit = pair.hits[0]
        height = dot(hit.normal, minus(own.position, hit.position))  # near the horizon rounding decides what it brings
        if pair.step < _FIRST_MATERIALS and not abs(height) <= _rounding(pair):
            right = sampled(hit, own)
            if diverged(own.unshadowed, theirs.unshadowed, right, 10 * CLOSE):
                words = f"without shadows it brings {point(own.unshadowed)}, and {point(right)} by its own numbers"
                yield pair.at(f"lamp{number}", f"{name}: {words}", "sampled_light")
        for words, function, why in _shadow(pair, own, theirs):
            yield pair.at(f"lamp{number}", f"{name}: {words}", function, why)
