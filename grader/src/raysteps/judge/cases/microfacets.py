"""Where a rough surface's visible normals lie, and what becomes of them: what samples of step 14 are held against.

Directions are unit vectors in the frame of the surface, z along its normal, a row each; alpha is GGX's, eta the index
on the side of the view divided by the other's. After Heitz, "Sampling the GGX Distribution of Visible Normals", 2018.
"""

import math
from functools import lru_cache

import numpy as np

from raysteps.common.vectors import Vector
from raysteps.judge.draws import unit_problem
from raysteps.judge.statistics import (
    Numbers,
    has_mean,
    has_same_distribution,
    is_plausible_count,
    is_uniform,
    means_agree,
    ratio_problem,
    uneven_problem,
)


def units(v: Numbers) -> Numbers:
    """Rows of length 1."""
    return np.asarray(v / np.linalg.norm(v, axis=1, keepdims=True))


def smith_lambda(directions: Numbers, alpha: float) -> Numbers:
    """Of both sides alike: 1 / (1 + lambda) of the microfacets that face a direction are seen from there."""
    z2 = directions[:, 2] ** 2
    return np.asarray((np.sqrt(1 + alpha * alpha * (1 - np.minimum(z2, 1.0)) / z2) - 1) / 2)


def dielectric(cosines: Numbers, eta: float) -> Numbers:
    """The share that is mirrored, by Fresnel; 1 where refraction is impossible."""
    sine2 = eta * eta * (1 - cosines**2)
    other = np.sqrt(np.where(sine2 < 1, 1 - sine2, 1.0))
    across = (eta * cosines - other) / (eta * cosines + other)
    along = (cosines - eta * other) / (cosines + eta * other)
    return np.where(sine2 < 1, 0.5 * (across**2 + along**2), 1.0)


# Visible normals. Stretched until the surface is a half sphere, and seen from its view, their tips fill evenly what is
# seen of the half sphere: half a disk, and half a disk that is squeezed by the slant. So two even numbers tell them.

_FEW, _MANY = 8, 16
_MANY_NORMALS = 16_384
_TELLING = 512  # of fewer it is not said what they may be instead
_ASKEW = "microfacets do not lean evenly to both sides of the view"
_NOT_AS_SEEN = "microfacets do not come as often as they are seen"
_ACROSS = "microfacets from one side of the view to the other, in strips that are seen equally large"
_UP = "microfacets from those that lean towards the view to those that lean away, in strips that are seen equally large"


def _leans_too_much(*, towards: bool) -> str:
    return f"microfacets lean too much {'towards' if towards else 'away from'} the view"


def _stretched(view: Numbers, alpha: float) -> tuple[Numbers, Numbers, Numbers, Numbers]:
    """By how much each axis is stretched, the view then, and two directions across it, the first one level."""
    stretch = np.array([alpha, alpha, 1.0])
    seen = view * stretch
    seen /= np.linalg.norm(seen)
    across = np.array([-seen[1], seen[0], 0.0])
    size = np.linalg.norm(across)
    across = across / size if size > 1e-9 else np.array([1.0, 0.0, 0.0])
    return stretch, seen, across, np.cross(seen, across)


def _seen_shares(normals: Numbers, view: Numbers, alpha: float) -> Numbers:
    """Of normals row by row, all for one view."""
    stretch, seen, across, up = _stretched(view, alpha)
    return _shares_of_tips(units(normals / stretch), seen, across, up)


def _shares_of_tips(tips: Numbers, seen: Numbers, across: Numbers, up: Numbers) -> Numbers:
    x, y = np.clip(tips @ across, -1, 1), tips @ up
    half = np.sqrt(np.maximum(1 - x * x, 1e-12))
    one = 0.5 + (x * half + np.arcsin(x)) / math.pi
    other = (y / half + seen[2]) / (1 + seen[2])
    return np.asarray(np.clip(np.stack([one, other], axis=1), 0.0, 1.0))


def _are_of_half_sphere(normals: Numbers, view: Numbers, alpha: float, bins: int) -> bool:
    """Whether they would be right if the surface stayed stretched."""
    if len(normals) < _TELLING:
        return False
    shares = _shares_of_tips(normals, *_stretched(view, alpha)[1:])
    return is_uniform(shares[:, 0], 4 * bins) and is_uniform(shares[:, 1], 4 * bins)


def visible_problem(normals: Numbers, view: Vector, alpha: float) -> str:
    """What is wrong with normals that should be visible ones; nothing of a single one, which tells nothing."""
    problem = unit_problem(normals)
    if problem:
        return problem
    if not (normals[:, 2] >= -1e-5).all():
        return "a microfacet's normal points below the surface"
    if len(normals) < 2:
        return ""
    shares = _seen_shares(normals, np.array(view), alpha)
    bins = _MANY if len(normals) >= _MANY_NORMALS else _FEW
    across, up = shares[:, 0], shares[:, 1]
    is_right_across = is_uniform(across, 4 * bins) and has_mean(across, 0.5, math.sqrt(1 / 12))
    if not is_right_across and _are_of_half_sphere(normals, np.array(view), alpha, bins):
        return "the normals are those of the half sphere: they are not brought back from it"
    if not is_right_across:
        return uneven_problem(_ASKEW, _ACROSS, across)
    if not has_mean(up, 0.5, math.sqrt(1 / 12)):
        return uneven_problem(_leans_too_much(towards=bool(up.mean() < 0.5)), _UP, up)
    if not is_uniform(up, 4 * bins):
        return uneven_problem(_NOT_AS_SEEN, _UP, up)
    return "" if is_uniform(shares, bins) else _NOT_AS_SEEN


_TRIES = 20_000  # of the judge's own: what is lost, and what is left


def _visible_normals(view: Numbers, alpha: float) -> Numbers:
    """Drawn as Heitz (2018) does, always with the same numbers."""
    rng = np.random.default_rng(14)
    stretch, seen, across, up = _stretched(view, alpha)
    radius, turn = np.sqrt(rng.random(_TRIES)), 2 * math.pi * rng.random(_TRIES)
    x = radius * np.cos(turn)
    share = 0.5 * (1 + seen[2])
    y = (1 - share) * np.sqrt(1 - x * x) + share * radius * np.sin(turn)
    height = np.sqrt(np.maximum(0.0, 1 - x * x - y * y))
    tips = x[:, None] * across + y[:, None] * up + height[:, None] * seen
    return units(tips * stretch)


@lru_cache(maxsize=64)  # the cases of one submission after the other
def _kept_shares(viewed: Vector, alpha: float, eta: float | None) -> Numbers:
    """Of those of them whose direction does not lead through the surface; `eta`: of glass."""
    view = np.array(viewed)
    normals = _visible_normals(view, alpha)
    cosines = np.clip(normals @ view, 0.0, 1.0)
    above = 2 * cosines * normals[:, 2] - view[2] > 0
    if eta is None:
        return _seen_shares(normals[above], view, alpha)
    other = np.sqrt(np.maximum(0.0, 1 - eta * eta * (1 - cosines**2)))
    below = (eta * cosines - other) * normals[:, 2] - eta * view[2] < 0
    is_mirrored = np.random.default_rng(15).random(_TRIES) < dielectric(cosines, eta)
    return _seen_shares(normals[np.where(is_mirrored, above, below)], view, alpha)


def rough_problem(normals: Numbers, nothing: int, view: Numbers, alpha: float, eta: float | None = None) -> str:
    """Whether nothing comes as often as it should, and the other normals are those of the judge's own draws of which a
    direction was kept."""
    x, y, z = (float(value) for value in view[0])
    own = _kept_shares((x, y, z), alpha, eta)
    count = len(normals) + nothing
    lost = _TRIES - len(own)
    if not is_plausible_count(nothing, count, lost, _TRIES):
        words = f"nothing comes too {'often' if nothing * _TRIES > lost * count else 'seldom'}"
        return ratio_problem(words, np.array([nothing * _TRIES / (count * max(lost, 1))]))
    mine = _seen_shares(normals, view[0], alpha)
    if not means_agree(mine[:, 0], own[:, 0]):
        return uneven_problem(_ASKEW, _ACROSS, mine[:, 0], own[:, 0])
    if not means_agree(mine[:, 1], own[:, 1]):
        problem = _leans_too_much(towards=bool(mine[:, 1].mean() < own[:, 1].mean()))
        return uneven_problem(problem, _UP, mine[:, 1], own[:, 1])
    bins = _MANY if count >= _MANY_NORMALS else _FEW
    for i, over in enumerate((_ACROSS, _UP)):
        if not has_same_distribution(mine[:, [i]], own[:, [i]], 4 * bins):
            return uneven_problem(_NOT_AS_SEEN, over, mine[:, i], own[:, i])
    return "" if has_same_distribution(mine, own, bins) else _NOT_AS_SEEN
