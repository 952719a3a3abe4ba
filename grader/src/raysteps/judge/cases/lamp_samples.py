"""Samples of lamps in step 12: position, normal and pdf of each, as seen from a place."""

import math
from collections.abc import Callable

import numpy as np

from raysteps.common.vectors import Vector, add, cross, length, minus, times, unit
from raysteps.judge.answers import Answer, first, numeric_problem, share_right
from raysteps.judge.draws import (
    CAP,
    DISK,
    FEW,
    MANY,
    TRIANGLE,
    VERY_MANY,
    Draws,
    as_shares,
    broken_draws,
    corners,
    draws_reader,
    evenness,
    heights_of_directions,
    place_problem,
    seed_and_times,
    turns_around,
    words_of_draws,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Inputs, Real, Vec, real_of, rounded, vec_of
from raysteps.judge.random_source import RandomSource
from raysteps.judge.statistics import Numbers, ratio_problem


def _basis(normal: Vector) -> tuple[Numbers, Numbers, Numbers]:
    """Two directions across, and the normal itself, of length 1."""
    upright = unit(normal)
    side = unit(cross(upright, (1.0, 0.0, 0.0) if abs(upright[0]) < 0.5 else (0.0, 1.0, 0.0)))
    x, y, z = (np.array(v) for v in (side, cross(upright, side), upright))
    return x, y, z


_POSITION, _NORMAL, _DENSITY = slice(0, 3), slice(3, 6), 6


def _normal_problem(expected: Numbers, actual: Draws) -> str:
    gaps = np.linalg.norm(actual.rows[:, _NORMAL] - expected, axis=1)
    if float(gaps.max()) <= 5e-3:
        return ""
    opposite = np.linalg.norm(actual.rows[:, _NORMAL] + expected, axis=1)
    if float(opposite.max()) <= 5e-3:
        return "a normal points to the dark side"
    return ratio_problem("a normal is wrong", (actual.rows[:, _NORMAL] * expected).sum(axis=1))


def _density_problem(expected: Numbers, actual: Draws) -> str:
    """Who is wrong by one factor everywhere has forgotten something else than who is not; so has who is wrong by
    another factor."""
    found = actual.rows[:, _DENSITY]
    if float(np.abs(found[expected == 0]).sum()) > 0:
        return "pdf is above 0 where no light is seen"
    bright = expected > 0
    ratios = found[bright] / expected[bright]
    if not len(ratios) or float(np.abs(ratios - 1).max()) <= 4e-3:
        return ""
    if float(np.abs(ratios).max()) == 0:
        return "pdf is 0 where light is seen"
    factor = float(ratios.mean())
    side = "large" if factor > 1 else "small"
    if float(ratios.std()) < 5e-3 * float(np.abs(ratios).mean()):
        kind = f"pdf is too {side}, by the same factor for all points"
        share = f"{factor:.2g}"
        tells = share != "1" and 0.01 <= abs(factor) < 99
        return numeric_problem(kind, f"it is {share} times what it should be") if tells else ratio_problem(kind, ratios)
    return ratio_problem(f"pdf is too {side}, and not by the same factor for all points", ratios)


def _area_density(inputs: Inputs, area: float, normal: Numbers, actual: Draws) -> Numbers:
    back = np.array(vec_of(inputs, "from")) - actual.rows[:, _POSITION]
    distances = np.linalg.norm(back, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        cosines = back @ normal / distances
        return np.where(cosines > 0, distances**2 / (area * cosines), 0.0)


_Problems = Callable[[Inputs, Draws], tuple[str, str, str]]


def _sample_answer(problems: _Problems, is_seen: Callable[[Inputs], bool] = lambda _: True) -> Answer[Draws]:
    """`problems`: of positions, normals and densities. Without right positions nothing is right; where `is_seen` says
    that nothing of the lamp is, any will do, also one that is no number."""

    def told(inputs: Inputs, actual: Draws) -> Draws:
        return actual if is_seen(inputs) else _without_points(actual)

    def problem(inputs: Inputs, _expected: Draws, actual: Draws) -> str:
        draws = told(inputs, actual)
        return broken_draws(inputs, draws, "a sample") or first(*problems(inputs, draws))

    def credit(inputs: Inputs, _expected: Draws, actual: Draws) -> float:
        draws = told(inputs, actual)
        if broken_draws(inputs, draws, "a sample"):
            return 0.0
        position, *others = problems(inputs, draws)
        return 0.0 if position else share_right(position, *others)

    return Answer(draws_reader(7), words_of_draws, problem, credit, is_drawn=True)


def _without_points(draws: Draws) -> Draws:
    """The densities alone, all else as 0."""
    rows, again = draws.rows.copy(), draws.again.copy()
    rows[:, :_DENSITY], again[:_DENSITY] = 0, 0
    return Draws(rows, again)


def _beyond(of_b: Numbers, of_c: Numbers) -> str:
    """In words, of points of which some lie beside the triangle: what came of two numbers of which one was turned round
    lies in one of the two halves beyond the side opposite to the first corner."""
    beyond = of_b + of_c > 1
    halves = (of_c > of_b)[beyond]
    is_folded = len(halves) >= _SOME and len(np.unique(halves)) == 1
    if is_folded and min(float(of_b.min()), float(of_c.min())) > -1e-3:
        return "in the triangle's plane, but beyond one half of the side opposite to its first corner"
    return "in the triangle's plane, but beyond a side"


_SOME = 8  # so few points might lie in one half by chance, one time in a hundred


def _triangle_problems(inputs: Inputs, actual: Draws) -> tuple[str, str, str]:
    a, b, c = (np.array(vec_of(inputs, name)) for name in "abc")
    across = np.cross(b - a, c - a)
    doubled = float(np.linalg.norm(across))
    normal = across / doubled
    spokes = actual.rows[:, _POSITION] - a
    of_b = np.cross(spokes, c - a) @ normal / doubled
    of_c = np.cross(b - a, spokes) @ normal / doubled
    size = math.sqrt(doubled)
    aside = float(np.abs(spokes @ normal).max()) > 1e-3 * size
    beyond = min(float(of_b.min()), float(of_c.min()), float((1 - of_b - of_c).min())) < -1e-3
    away = np.maximum(of_b + of_c, 1e-12)
    place = "above or below the triangle, not in its plane" if aside else _beyond(of_b, of_c)
    position = place_problem(f"a point lies {place}", spokes) if aside or beyond else ""
    position = position or evenness(inputs, TRIANGLE, as_shares(away**2, of_c / away))
    density = _density_problem(_area_density(inputs, doubled / 2, normal, actual), actual)
    return position, _normal_problem(normal, actual), density


def _other_plane(spokes: Numbers, normal: Numbers) -> str:
    """In words, of points that lie in a plane other than the disk's: one in which the disk's normal lies."""
    *_, across = np.linalg.svd(spokes, full_matrices=False)[2]
    upright = float(np.abs(spokes @ across).max()) < 1e-3 and abs(float(across @ normal)) < 1e-3
    return ", in one that stands upright on it" if upright else ""


def _disk_light_problems(inputs: Inputs, actual: Draws) -> tuple[str, str, str]:
    radius = real_of(inputs, "radius")
    x, y, z = _basis(vec_of(inputs, "normal"))
    spokes = (actual.rows[:, _POSITION] - np.array(vec_of(inputs, "center"))) / radius
    of_x, of_y = spokes @ x, spokes @ y
    squares = of_x**2 + of_y**2
    aside = float(np.abs(spokes @ z).max()) > 1e-3
    if aside and float((spokes**2).sum(axis=1).max()) <= 1 + 2e-3:
        position = f"the points lie around the disk's centre, but not in its plane{_other_plane(spokes, z)}"
    elif aside or float(squares.max()) > 1 + 2e-3:
        position = place_problem("a point lies off the disk" if aside else "a point lies beyond the disk's rim", spokes)
    else:
        position = ""
    position = position or evenness(inputs, DISK, as_shares(squares, turns_around(of_x, of_y)))
    density = _density_problem(_area_density(inputs, math.pi * radius * radius, z, actual), actual)
    return position, _normal_problem(z, actual), density


_FLOAT = 3e-7  # of coordinates, with what a few sums lose
_ROOT_OF_FLOAT = 7e-4  # of a distance: what a root of the difference of squares loses
_SEEN = 1.02  # of the cap's height, with what rounding adds


def _beside(heights: Numbers, local: Numbers) -> str:
    """Where points off a sphere lie for who looks at it. `heights`: of directions, in that of the cap that it fills.
    `local`: the directions, with the way to the centre as z."""
    if float(local[:, 2].max()) < 0:
        return "and all of them behind the place that is lit"
    if float(heights.max()) <= _SEEN:
        return "though in a direction in which the sphere is seen"
    return "in a direction in which the sphere is not seen" if float(heights.min()) <= _SEEN else "and so do all others"


def _is_outside(inputs: Inputs) -> bool:
    return length(minus(vec_of(inputs, "center"), vec_of(inputs, "from"))) > real_of(inputs, "radius")


def _sphere_problems(inputs: Inputs, actual: Draws) -> tuple[str, str, str]:
    center, radius, from_ = vec_of(inputs, "center"), real_of(inputs, "radius"), vec_of(inputs, "from")
    distance = length(minus(center, from_))
    if not _is_outside(inputs):
        dark = np.zeros(len(actual.rows))
        return "", "", _density_problem(dark, actual)
    x, y, z = _basis(minus(center, from_))
    positions = actual.rows[:, _POSITION]
    rounding = _FLOAT * (distance + length(center) + length(from_))
    spokes = (positions - np.array(center)) / radius
    sizes = np.linalg.norm(spokes, axis=1)
    ways = positions - np.array(from_)
    directions = ways / np.maximum(np.linalg.norm(ways, axis=1), 1e-30)[:, None]
    local = np.stack([directions @ x, directions @ y, directions @ z], axis=1)
    sine = radius / distance
    height = sine * sine / (1 + math.sqrt(1 - sine * sine))
    heights = heights_of_directions(local) / height
    slack = 2e-3 + _ROOT_OF_FLOAT * distance / radius
    if float(np.abs(sizes - 1).max()) > slack:
        reach = np.linalg.norm(ways, axis=1)
        near = "points are all as near as the nearest one of the sphere, so most of them lie off it"
        is_near = float(np.abs(reach - (distance - radius)).max()) <= slack * radius
        position = near if is_near else place_problem(f"a point lies off the sphere, {_beside(heights, local)}", spokes)
    elif float((spokes @ z).max()) > -sine + 0.05 + slack:
        some = "all points lie" if float((spokes @ z).min()) > -sine else "a point lies"
        position = f"{some} on the side of the sphere that is not seen"
    else:
        position = evenness(inputs, CAP, as_shares(heights, turns_around(local[:, 0], local[:, 1])))
    normals = spokes / np.maximum(sizes, 1e-30)[:, None]
    normal = "" if rounding > 1e-4 * radius else _normal_problem(normals, actual)
    density = np.full(len(positions), 1 / (2 * math.pi * height))
    return position, normal, _density_problem(density, actual)


def _triangle(draw: RandomSource, low: float, high: float, size: int) -> Inputs:
    """Seen from a place with such a cosine at the middle; from before it, if the cosine is above 0."""
    triangle = draw.triangle()
    a, b, c = triangle.a, triangle.b, triangle.c
    normal = unit(cross(minus(b, a), minus(c, a)))
    middle = times(1 / 3, add(add(a, b), c))
    from_ = rounded(add(middle, draw.above(normal, low, high), draw.real(3, 9)))
    return {"a": Vec(a), "b": Vec(b), "c": Vec(c), "from": Vec(from_), **seed_and_times(draw, size)}


def _disk(draw: RandomSource, low: float, high: float, size: int, *, axis: bool = False) -> Inputs:
    center, normal, radius = draw.point(4), draw.axis() if axis else draw.direction(), draw.real(0.2, 2)
    from_ = rounded(add(center, draw.above(normal, low, high), draw.real(1.5, 4) * radius))
    return {
        "center": Vec(center),
        "normal": Vec(normal),
        "radius": Real(radius),
        "from": Vec(from_),
        **seed_and_times(draw, size),
    }


def _sphere(draw: RandomSource, reach: float, size: int) -> Inputs:
    """`reach`: the distance from the centre, in radii."""
    center, radius = draw.point(4), draw.real(0.2, 2)
    from_ = rounded(add(center, draw.direction(), reach * radius))
    return {"center": Vec(center), "radius": Real(radius), "from": Vec(from_), **seed_and_times(draw, size)}


SAMPLE_TRIANGLE = Function(
    "sample_triangle",
    _sample_answer(_triangle_problems),
    (
        Group("a few samples", lambda d: _triangle(d, 0.35, 0.99, FEW)),
        Group("many samples", lambda d: _triangle(d, 0.35, 0.99, MANY)),
        Group("very many samples", lambda d: _triangle(d, 0.35, 0.99, VERY_MANY)),
        Group("corners of the square", lambda d: {**_triangle(d, 0.5, 0.99, FEW), **corners()}, exact=True),
        Group("from behind", lambda d: _triangle(d, -0.99, -0.5, FEW)),
    ),
)
SAMPLE_DISK = Function(
    "sample_disk",
    _sample_answer(_disk_light_problems),
    (
        Group("a few samples", lambda d: _disk(d, 0.3, 0.99, FEW)),
        Group("many samples", lambda d: _disk(d, 0.3, 0.99, MANY)),
        Group("along an axis", lambda d: _disk(d, 0.3, 0.99, FEW, axis=True)),
        Group("corners of the square", lambda d: {**_disk(d, 0.3, 0.99, FEW), **corners()}, exact=True),
        Group("from behind", lambda d: _disk(d, -0.99, -0.2, FEW)),
    ),
)
SAMPLE_SPHERE = Function(
    "sample_sphere",
    _sample_answer(_sphere_problems, _is_outside),
    (
        Group("a few samples", lambda d: _sphere(d, d.real(1.2, 6), FEW)),
        Group("many samples", lambda d: _sphere(d, d.real(1.2, 6), MANY)),
        Group("very near", lambda d: _sphere(d, d.real(1.02, 1.2), MANY)),
        Group("small and far", lambda d: _sphere(d, d.logarithmic(200, 600), FEW)),
        Group("corners of the square", lambda d: {**_sphere(d, d.real(1.2, 6), FEW), **corners()}, exact=True),
        Group("from inside", lambda d: _sphere(d, d.real(0.05, 0.95), FEW)),
    ),
)
