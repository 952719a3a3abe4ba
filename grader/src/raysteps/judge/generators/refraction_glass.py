"""What the cases of step 08 share: glass, and rays that meet it on this or that side of the critical angle."""

import math
from dataclasses import replace

from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector, dot, f32, rounded, times
from raysteps.judge.values import Fill, Hit

_CLEAR = 0.05  # how far the sine of a refracted ray keeps from 1, where rounding decides


def index_of_glass(draw: Draw) -> float:
    """Also the eta of a ray that leaves it."""
    return draw.real(1.2, 2.2)


def into(draw: Draw) -> float:
    """The eta of a ray that enters glass."""
    return f32(1 / index_of_glass(draw))


def _sine(eta: float, cosine: float) -> float:
    return eta * math.sqrt(1 - min(1.0, cosine * cosine))


def directions(draw: Draw, eta: float, *, total: bool) -> tuple[Vector, Vector]:
    """Ray and normal, on this or that side of the critical angle."""

    def make() -> tuple[Vector, Vector]:
        normal = draw.direction()
        return rounded(times(-1.0, draw.above(normal, 0.05))), normal

    def clear(found: tuple[Vector, Vector]) -> bool:
        sine = _sine(eta, dot(*found))
        return sine > 1 + _CLEAR if total else sine < 1 - _CLEAR

    return draw.until(clear, make)


def hit_on_glass(draw: Draw, index: float, *, outside: bool, total: bool = False) -> Hit:
    eta = (1 / index if outside else index) if index > 0 else 1.0
    ray, normal = directions(draw, eta, total=total)
    fill = replace(draw.fill(), transmittance=draw.real(0.2, 1.0), index=index)
    return Hit(draw.point(3), normal, ray, draw.real(1, 9), fill, outside)


def any_hit(draw: Draw) -> Hit:
    if draw.chance(0.2):
        return hit_on_glass(draw, index_of_glass(draw), outside=False, total=True)
    return hit_on_glass(draw, index_of_glass(draw), outside=draw.chance(0.5))


def simple_hit(draw: Draw) -> Hit:
    """Straight down into or out of glass of index 1.5."""
    normal = draw.axis()
    fill = Fill(transmittance=0.5, index=1.5)
    return Hit((0.0, 0.0, 0.0), normal, times(-1.0, normal), 1.0, fill, draw.chance(0.5))
