"""Which function a difference points to."""

import math

from raysteps.inspector.model import Accel, Hit, LampSample, Light, LightShare, Missed, Number, Ray, Way
from raysteps.inspector.records import (
    CLOSE,
    SHAPES,
    Vector,
    as_float,
    brief,
    dot,
    intersect_of,
    length,
    minus,
    same_direction,
)

_FARTHEST_START = 0.011  # what the contracts allow is 0.01
_LEAST_START = 2e-4  # the contracts name 0.001
SAME_START = 1e-4
_SEARCH = {
    "none": ("closest_hit", "closest_hit"),
    "boxes": ("closest_hit", "closest_hit"),
    "octree": ("closest_hit_in_octree", "occluded_in_octree"),
    "bvh": ("closest_hit_in_bvh", "occluded_in_bvh"),
}
_SPACE = {"no-bounds": "bounds_of", "no-part": "split"}
_BUILD = {"none": "closest_hit", "boxes": "split", "octree": "build_octree", "bvh": "build_bvh"}


def blamed_function(missed: Missed, accel: Accel, *, shadow: bool) -> str:
    """Why a surface was not found, although its own intersect finds it."""
    reason = missed.reason
    if reason == "box-missed":
        return "Box::clip"
    if reason == "no-overlap":
        return f"{SHAPES[missed.kind]}::overlaps" if missed.kind in SHAPES else _BUILD[accel]
    if reason in _SPACE:
        return _SPACE[reason]
    if reason in ("not-listed", "no-box"):
        return _BUILD[accel]
    return _SEARCH[accel][shadow]


def _answer(ray: Ray, surface: int) -> tuple[bool, float | None]:
    """Whether the ray asked the surface, and at which distance it was hit."""
    for test in ray.tests:
        if test.surface == surface:
            return True, None if test.distance is None else as_float(test.distance)
    return False, None


def _changed_on_the_way(ray: Ray) -> bool:
    """Whether the search gave a hit that no surface had answered."""
    hit = ray.hit
    if hit is None:
        return False
    if hit.surface is None:
        return True
    asked, distance = _answer(ray, hit.surface)
    return asked and (distance is None or abs(distance - as_float(hit.distance)) > CLOSE * max(1.0, distance))


def blame_hit(mine: Ray, reference: Ray, accel: Accel) -> str:
    """The same ray meets another surface, or none, or at another distance."""
    shadow = mine.role == "shadow"
    if mine.missed is not None:
        return blamed_function(mine.missed, accel, shadow=shadow)
    if _changed_on_the_way(mine):
        return _SEARCH[accel][shadow]
    nearest = reference.hit
    own = mine.hit
    too_far = own is None or (nearest is not None and as_float(own.distance) >= as_float(nearest.distance))
    culprit = nearest if too_far and nearest is not None else own
    return intersect_of(culprit.kind) if culprit is not None else ""


def start_problem(ray: Ray, hit: Hit, side: int) -> str:
    """What is wrong with where a ray begins; `side`: 1 where the normal points to, -1 behind the surface."""
    away = minus(ray.origin, hit.position)
    height = dot(away, hit.normal)
    if not length(away) <= _FARTHEST_START:
        return f"it begins {length(away):.3g} away from the hit, and 0.01 is the most that the contract allows"
    if height * side < -1e-6:
        return "it begins on the wrong side of the surface"
    if height * side < _LEAST_START:
        return "it begins on the surface itself, or hardly off it, so that rounding decides what it meets"
    return ""


def _nearer(hit: Hit | None, limit: Number | None) -> bool:
    """Whether the hit lies before the light."""
    return hit is not None and (not isinstance(limit, int | float) or as_float(hit.distance) < limit)


def blame_shadow(mine: Ray, reference: Ray, hit: Hit, accel: Accel, *, lit: bool) -> tuple[str, str]:
    """A shadow ray that points to the light, but has another answer: the function, and why."""
    problem = start_problem(mine, hit, 1)
    if problem:
        return "shadow_ray", problem
    apart = length(minus(mine.origin, reference.origin))
    if apart > SAME_START and mine.missed is None:
        return "shadow_ray", f"it begins {apart:.2g} away from the reference's, and that decides whether it gets past"
    if lit:  # the reference's is blocked
        if mine.hit is not None:
            return "is_lit", "your ray met something, too"
        if mine.missed is not None or _nearer(reference.hit, mine.limit):
            return blame_hit(mine, reference, accel) or "is_lit", ""
        return "is_lit", "your ray asked for nearer hits only"
    if mine.hit is None and mine.any:
        return _SEARCH[accel][1], "the search says that something is near, though no surface that it tested is"
    if mine.hit is None:
        return "is_lit", "your ray met nothing, either"
    if reference.limit is not None and not _nearer(mine.hit, reference.limit):
        return "is_lit", f"that is behind the light, which is {brief(reference.limit)} away"
    return blame_hit(mine, reference, accel) or "is_lit", ""


def blame_bounce(own: Vector | None, theirs: Vector | None, whole: str, part: str) -> str:
    """A bounced ray has another direction: `part` computes it, `whole` makes the ray."""
    if own is None or theirs is None:
        return whole if own is theirs else part
    return whole if same_direction(own, theirs) else part


# What the contracts of the steps make of the values that a record itself holds. A right program may hit slightly
# beside the reference, and mirrors amplify that. So a value that differs is no mistake where it follows from the
# record's own values.

Color = Vector | None
_BLACK = (0.0, 0.0, 0.0)


def _floats(vector: Vector) -> list[float]:
    return [as_float(value) for value in vector]


def _unit(vector: list[float]) -> list[float]:
    size = length(vector)
    return [value / size for value in vector] if size > 0 else vector


def mirrored(direction: Vector, normal: Vector) -> list[float]:
    along = 2 * dot(direction, normal)
    return [d - along * n for d, n in zip(_floats(direction), _floats(normal), strict=True)]


def refracted(hit: Hit) -> list[float] | None:
    """Snell's law, into or out of the hit's glass; nothing where it mirrors."""
    index = as_float(hit.fill.index) or 1.0
    eta = 1 / index if hit.from_outside else index
    cosine = -dot(hit.ray_direction, hit.normal)
    rest = 1 - eta * eta * (1 - cosine * cosine)
    if not rest >= 0:
        return None
    bend = eta * cosine - math.sqrt(rest)
    pairs = zip(_floats(hit.ray_direction), _floats(hit.normal), strict=True)
    return _unit([eta * d + bend * n for d, n in pairs])


def diffuse(hit: Hit, light: LightShare, source: Light) -> list[float]:
    weight = as_float(hit.fill.kd) * max(as_float(light.l_n), 0.0)
    pairs = zip(_floats(hit.fill.color), _floats(source.color), strict=True)
    return [weight * a * b for a, b in pairs]


def _power(base: float, exponent: float) -> float:
    """As std::pow: a cosine of a normal that is too long may have no end when it is raised to a shine."""
    try:
        return math.pow(base, exponent)
    except (OverflowError, ValueError):
        return math.inf


def specular(hit: Hit, light: LightShare, source: Light) -> list[float]:
    if as_float(light.l_n) <= 0:
        return [0.0, 0.0, 0.0]
    weight = as_float(hit.fill.ks) * _power(max(as_float(light.r_v), 0.0), as_float(hit.fill.shine))
    return [weight * value for value in _floats(source.color)]


def sampled(hit: Hit, lamp: LampSample) -> list[float]:
    """Radiance f cos / pdf of a matt surface, by the sample's own numbers."""
    way, pdf = minus(lamp.position, hit.position), as_float(lamp.pdf)
    size = length(way)
    cosine = dot(hit.normal, way) / size if size > 0 else 0.0
    weight = as_float(hit.fill.kd) / math.pi * cosine / pdf if cosine > 0 and pdf > 0 else 0.0
    return [weight * a * b for a, b in zip(_floats(lamp.radiance), _floats(hit.fill.color), strict=True)]


def direct(lights: list[LightShare]) -> list[float]:
    terms = [_floats(term) for light in lights if light.lit for term in (light.diffuse, light.specular)]
    return [sum(values) for values in zip(*terms, strict=True)] if terms else list(_BLACK)


def is_unseen(ray: Ray) -> bool:
    """A step 05 that calls itself tells nobody what its reflected rays bring."""
    return ray.color is None and ray.role == "reflect"


def _color_of(ray: Ray) -> Color:
    """Where nobody saw it, what the contract makes of the ray's parts."""
    if not is_unseen(ray):
        return ray.color
    return _BLACK if ray.hit is None else added(ray.local, brought(ray, "reflect"))


def brought(ray: Ray, way: Way) -> Color:
    """What the ray's own bounces that way bring, weighed by the fill; nothing where it is not known."""
    if ray.hit is None:
        return None
    colors = [_color_of(bounce) for bounce in ray.bounces_of(way)]
    if not colors:
        return _BLACK
    if len(colors) > 1 or colors[0] is None:
        return None
    share = as_float(ray.hit.fill.ks if way == "reflect" else ray.hit.fill.transmittance)
    return [share * value for value in _floats(colors[0])]


def added(one: Color, other: Color) -> Color:
    if one is None or other is None:
        return None
    return [a + b for a, b in zip(_floats(one), _floats(other), strict=True)]


def shown(channel: Number, *, for_screen: bool) -> float:
    """Tone mapped, or as sRGB."""
    value = as_float(channel)
    if for_screen:
        light = min(value, 1.0) if value > 0 else 0.0
        return 12.92 * light if light <= 0.0031308 else 1.055 * math.pow(light, 1 / 2.4) - 0.055
    return 0.0 if not value > 0 else 1.0 if math.isinf(value) else value / (value + 1)
