"""What the contracts of the steps make of the values that a record itself holds.

A right program may hit a hair's breadth beside the reference, and mirrors spread that. So a value that differs is no
mistake where it follows from the record's own values."""

import math

from raysteps.commands.inspect.values import Number, Record, Vector, as_float, dot, length

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


def refracted(hit: Record) -> list[float] | None:
    """Snell's law, into or out of the hit's glass; nothing where it mirrors."""
    index = as_float(hit["fill"]["index"]) or 1.0
    eta = 1 / index if hit["from_outside"] else index
    cosine = -dot(hit["ray_direction"], hit["normal"])
    rest = 1 - eta * eta * (1 - cosine * cosine)
    if not rest >= 0:
        return None
    bend = eta * cosine - math.sqrt(rest)
    pairs = zip(_floats(hit["ray_direction"]), _floats(hit["normal"]), strict=True)
    return _unit([eta * d + bend * n for d, n in pairs])


def diffuse(hit: Record, light: Record, source: Record) -> list[float]:
    weight = as_float(hit["fill"]["kd"]) * max(as_float(light["l_n"]), 0.0)
    pairs = zip(_floats(hit["fill"]["color"]), _floats(source["color"]), strict=True)
    return [weight * a * b for a, b in pairs]


def _power(base: float, exponent: float) -> float:
    """As std::pow: a cosine of a normal that is too long may have no end when it is raised to a shine."""
    try:
        return math.pow(base, exponent)
    except (OverflowError, ValueError):
        return math.inf


def specular(hit: Record, light: Record, source: Record) -> list[float]:
    if as_float(light["l_n"]) <= 0:
        return [0.0, 0.0, 0.0]
    weight = as_float(hit["fill"]["ks"]) * _power(max(as_float(light["r_v"]), 0.0), as_float(hit["fill"]["shine"]))
    return [weight * value for value in _floats(source["color"])]


def direct(lights: list[Record]) -> list[float]:
    terms = [_floats(light[name]) for light in lights if light["lit"] for name in ("diffuse", "specular")]
    return [sum(values) for values in zip(*terms, strict=True)] if terms else list(_BLACK)


def is_unseen(ray: Record) -> bool:
    """A step 05 that calls itself tells nobody what its reflected rays bring."""
    return ray["color"] is None and ray["role"] == "reflect"


def _color_of(ray: Record) -> Color:
    """Where nobody saw it, what the contract makes of the ray's parts."""
    if not is_unseen(ray):
        seen: Color = ray["color"]
        return seen
    return _BLACK if ray["hit"] is None else added(ray["local"], brought(ray, "ks", "reflect"))


def brought(ray: Record, weight: str, *roles: str) -> Color:
    """What the ray's own bounces bring, weighed by the fill; nothing where it is not known."""
    if ray["hit"] is None:
        return None
    colors = [_color_of(bounce) for bounce in ray["bounces"] if bounce["role"] in roles]
    if not colors:
        return _BLACK
    if len(colors) > 1 or colors[0] is None:
        return None
    share = as_float(ray["hit"]["fill"][weight])
    return [share * value for value in _floats(colors[0])]


def added(one: Color, other: Color) -> Color:
    if one is None or other is None:
        return None
    return [a + b for a, b in zip(_floats(one), _floats(other), strict=True)]


def tone_mapped(channel: Number) -> float:
    value = as_float(channel)
    return 0.0 if not value > 0 else 1.0 if math.isinf(value) else value / (value + 1)
