"""Cases of step 13: directions with a density, what they count, roulette, and whole paths."""

import math

import numpy as np

from raysteps.common.vectors import Vector, add, cross, times, unit
from raysteps.judge.answers import Answer, Tolerance, first, number_answer, share_beyond
from raysteps.judge.cases.whole_paths import BLACK, PATH_LIGHT
from raysteps.judge.draws import (
    Samples,
    read_directions,
    read_samples,
    seed_and_times,
    unit_problem,
    words_of_directions,
    words_of_samples,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Fill, Hit, Inputs, Vec, rounded, vec_of, whole_of
from raysteps.judge.random_source import RandomSource, next_axis
from raysteps.judge.statistics import Numbers, has_mean, is_uniform, ratio_problem, uneven_problem

# Directions with the density cos / pi. Every map from the unit square is right that gives it: so no direction is
# compared with the reference's. Seen from above the tip of such a direction lies anywhere in the unit disk, all places
# equally likely: the square of its distance from the middle, and its angle, are even.

_LEVEL = 1e-4
_FEW, _MANY = 8, 16  # bins for each of the two
_MANY_DIRECTIONS = 16_384  # from here on the finer bins


def _shares(directions: Numbers, normal: Vector) -> Numbers:
    """Two even numbers from 0 to 1 of each direction, where its density is right."""
    axis = (1.0, 0.0, 0.0) if abs(normal[0]) < 0.7 else (0.0, 1.0, 0.0)
    side = unit(cross(normal, axis))
    x, y = directions @ np.array(side), directions @ np.array(cross(normal, side))
    return np.stack([np.minimum(x * x + y * y, 1.0), np.arctan2(y, x) / (2 * math.pi) % 1.0], axis=1)


# Densities that are known: what of a direction's cosine is even then. They and other axes only name what is wrong: near
# to them lie right directions too, the nearer the fewer there are.
_OTHER_DENSITIES = {
    "all directions of the half sphere come equally often": 1,
    "directions have the density of the cosine's square": 3,
}
_SURELY = 4.0  # standard deviations: what is told of a mistake is held to more than what is called wrong
_TELLING = 256  # directions: fewer do not tell how they are wrong


def _is_even(shares: Numbers, bins: int) -> bool:
    """Near enough to say so."""
    return has_mean(shares, 0.5, math.sqrt(1 / 12), _SURELY) and is_uniform(shares, 4 * bins)


_MEAN_LENGTH, _NEAR = 2 / 3, 0.04  # of the mean of all directions
_APART = 0.98  # cosine: nearer to the normal it may be the normal itself


def _axis_problem(directions: Numbers, normal: Vector) -> str:
    """Of directions that are wrong: whether they are spread as they should be, but for where they point to."""
    mean = directions.mean(axis=0)
    size = float(np.linalg.norm(mean))
    if len(directions) < _TELLING or abs(size - _MEAN_LENGTH) > _NEAR or float(mean @ np.array(normal)) > _APART * size:
        return ""
    cosines = directions @ mean / size
    is_right = (cosines > -_NEAR).all() and abs(float((cosines**2).mean()) - 0.5) <= _NEAR
    return "directions lie around another axis than the normal" if is_right else ""


def _heights_problem(cosines: Numbers, heights: Numbers, bins: int) -> str:
    over = "directions from steep to level, in rings that should get the same number of them"
    if has_mean(heights, 0.5, math.sqrt(1 / 12)):
        if is_uniform(heights, 4 * bins):
            return ""
        words = "some heights come more often than others"
    else:
        words = f"{'level' if heights.mean() > 0.5 else 'steep'} directions come too often"
    known = (name for name, power in _OTHER_DENSITIES.items() if _is_even(np.clip(cosines, 0.0, 1.0) ** power, bins))
    return uneven_problem(next(known, words) if len(cosines) >= _TELLING else words, over, heights)


def _density_problem(directions: Numbers, normal: Vector) -> str:
    """Of one direction nothing can be told: a smallest counterexample has too few."""
    problem = unit_problem(directions)
    if problem:
        return problem
    cosines = directions @ np.array(normal)
    is_below = cosines < -_LEVEL
    if is_below.any():
        below = ratio_problem("a direction leads below the surface", is_below.mean(keepdims=True))
        return _axis_problem(directions, normal) or below
    if len(directions) < 2:
        return ""
    shares = _shares(directions, normal)
    bins = _MANY if len(directions) >= _MANY_DIRECTIONS else _FEW
    heights, turns = shares[:, 0], shares[:, 1]
    if not (is_uniform(turns, 4 * bins) and has_mean(turns, 0.5, math.sqrt(1 / 12))):
        problem = "directions do not come evenly from all sides around the normal"
        askew = uneven_problem(problem, "directions around the normal, side by side", turns, goes_round=True)
        return _axis_problem(directions, normal) or askew
    if problem := _heights_problem(cosines, heights, bins):
        return problem
    return "" if is_uniform(shares, bins) else "height and side of a direction have to do with each other"


def _directions_problem(inputs: Inputs, _expected: Numbers, actual: Numbers) -> str:
    if len(actual) != whole_of(inputs, "times"):
        return "no proper answer came"
    return _density_problem(actual, vec_of(inputs, "normal"))


def _directions(draw: RandomSource, normal: Vector, amount: int = 2048) -> Inputs:
    return {"normal": Vec(normal), **seed_and_times(draw, amount)}


def _near_an_axis(draw: RandomSource) -> Vector:
    """Where frames around the normal are made in one way or in another."""
    axis, other = draw.axis(), draw.direction()
    return rounded(unit(add(axis, other, draw.logarithmic(1e-7, 0.03))))


_COSINE_DIRECTION = Function(
    "cosine_direction",
    Answer(read_directions, words_of_directions, _directions_problem, is_drawn=True),
    (
        Group("any normal", lambda d: _directions(d, d.direction())),
        Group("along an axis", lambda d: _directions(d, d.axis()), exact=True),
        Group("nearly along an axis", lambda d: _directions(d, _near_an_axis(d))),
        Group("between the axes", lambda d: _directions(d, d.diagonal())),
        Group("very many directions", lambda d: _directions(d, d.direction(), 32_768)),
    ),
)


# The density.

_DENSITY = Tolerance(2e-6, 1e-4)


def _pdf(normal: Vector, direction: Vector) -> Inputs:
    return {"normal": Vec(normal), "direction": Vec(direction)}


def _pdf_above(draw: RandomSource, low: float, high: float) -> Inputs:
    normal = draw.direction()
    return _pdf(normal, draw.above(normal, low, high))


def _pdf_below(draw: RandomSource) -> Inputs:
    inputs = _pdf_above(draw, 0.01, 0.99)
    return _pdf(vec_of(inputs, "normal"), times(-1, vec_of(inputs, "direction")))


def _simple_pdf(draw: RandomSource) -> Inputs:
    """Straight up, 0.6 or 0.8 up, level."""
    normal, up = draw.axis(), (1.0, 0.8, 0.6, 0.0)[draw.whole(0, 3)]
    sine = math.sqrt(1 - up * up)
    return _pdf(normal, rounded(add(times(up, normal), next_axis(normal), sine)))


_COSINE_PDF = Function(
    "cosine_pdf",
    number_answer("the density", _DENSITY),
    (
        Group("above the surface", lambda d: _pdf_above(d, 0.05, 0.99)),
        Group("below it", _pdf_below),
        Group("nearly level", lambda d: _pdf_above(d, 0.001, 0.05)),
        Group("simple numbers", _simple_pdf, exact=True),
    ),
)


# What a diffuse surface makes of it.

_WEIGHT = Tolerance(1e-5, 5e-4)
_STEEP = 0.02  # cosine: below it a float's rounding is too much of it to compare with

# Wrong weights beside the right one: a factor, and a power of the cosine. No answer by chance is compared with
# another's numbers, so known mistakes are told apart by these words alone.
_WRONG_WEIGHTS = {
    "the weight is pi times f cos / pdf": (math.pi, 0),
    "the weight is f cos / pdf over pi": (1 / math.pi, 0),
    "the weight is f cos / pdf times the cosine once more": (1.0, 1),
    "the weight is f / pdf without the cosine": (1.0, -1),
    "the weight is f cos without the pdf": (1 / math.pi, 1),
    "the weight is f cos over the pdf of directions that are all equally likely": (2.0, 1),
}


_OTHER_PDF = "the pdf is not that of the direction"
_WRONG_PDFS = {
    "the pdf is 0": 0.0,
    "the pdf is not divided by pi": math.pi,
    "the pdf is divided by 2 pi": 0.5,
    "the pdf is multiplied by pi": math.pi**2,
}


def _pdf_problem(pdfs: Numbers, cosines: Numbers) -> str:
    """What is wrong with the densities of directions that are not near the horizon. Of what are no numbers nothing is
    right; a few directions may all be near it."""
    steep = cosines > _STEEP
    if not steep.any():
        return "" if np.isfinite(cosines).all() and np.isfinite(pdfs).all() else _OTHER_PDF
    pdfs, densities = pdfs[steep], np.maximum(cosines[steep], 0.0) / math.pi
    if (np.abs(pdfs - densities) <= _DENSITY.absolute + 1e-3 * densities).all():
        return ""
    if np.ptp(pdfs) == 0 and pdfs[0] != 0:
        of_all = abs(pdfs[0] - 1 / (2 * math.pi)) < 1e-4
        words = "that of directions that are all equally likely" if of_all else "the same for all"
        return ratio_problem(f"the pdf is {words}", pdfs[:1])
    for words, factor in _WRONG_PDFS.items():
        if np.allclose(pdfs, factor * densities, rtol=2e-3, atol=1e-9):
            return words
    return ratio_problem(_OTHER_PDF, pdfs / densities)


def _weight_problem(weights: Numbers, fill: Fill, cosines: Numbers) -> str:
    albedo = np.array(times(fill.kd, fill.color))
    if (np.abs(weights - albedo) <= _WEIGHT.absolute + _WEIGHT.relative * albedo).all():
        return ""
    for words, other in (("kd", np.array(fill.color)), ("the colour", np.full(3, fill.kd))):
        if np.allclose(weights, other, rtol=2e-3, atol=1e-5):
            return f"the weight lacks {words}"
    steep = cosines > _STEEP
    for words, (factor, power) in _WRONG_WEIGHTS.items():
        wrong = factor * cosines[steep, np.newaxis] ** power * albedo
        if steep.any() and np.allclose(weights[steep], wrong, rtol=2e-3, atol=0.0):
            return words
    return ratio_problem("the weight is not f cos / pdf", weights[steep].sum(axis=1) / albedo.sum())


def _sample_problems(inputs: Inputs, actual: Samples) -> tuple[str, ...]:
    hit = inputs["hit"]
    assert isinstance(hit, Hit)
    normal = hit.normal
    if actual.count != whole_of(inputs, "times"):
        return ("no proper answer came",) * 3
    if not any(times(hit.fill.kd, hit.fill.color)):
        return ("a surface that sends no light on gives samples",) * 3 if len(actual.rows) else ("", "", "")
    if actual.nothing:
        return ("nothing came from a surface that sends light on",) * 3
    cosines = actual.directions @ np.array(normal)
    return (
        _density_problem(actual.directions, normal),
        _weight_problem(actual.weights, hit.fill, cosines),
        _pdf_problem(actual.pdfs, cosines),
        "a diffuse surface gives a specular sample" if actual.is_specular_somewhere else "",
    )


def _scatter(draw: RandomSource, fill: Fill, normal: Vector, amount: int, emission: Vector = BLACK) -> Inputs:
    along = times(-1, draw.above(normal, 0.05))
    hit = Hit(draw.point(5), normal, along, draw.real(0.5, 9), fill, draw.chance(0.7))
    return {"hit": hit, "emission": Vec(emission), **seed_and_times(draw, amount)}


def _colored(draw: RandomSource) -> Fill:
    return Fill(draw.color(0.05, 1.0), draw.real(0.2, 1), draw.real(0.1, 1), draw.real(2, 40))


def _one_black(draw: RandomSource) -> Fill:
    """Some channels are 0, others are not."""
    color = [draw.real(0.2, 1.0), 0.0, draw.real(0.2, 1.0) if draw.chance(0.5) else 0.0]
    turn = draw.whole(0, 2)
    x, y, z = color[turn:] + color[:turn]
    return Fill((x, y, z), draw.real(0.2, 1))


def _black(draw: RandomSource) -> Fill:
    return Fill(draw.color(), 0.0) if draw.chance(0.5) else Fill((0.0, 0.0, 0.0), draw.real(0.2, 1))


def _dark(draw: RandomSource) -> Fill:
    return Fill(draw.color(2e-4, 8e-3), draw.real(0.2, 1))


_SCATTER_DIFFUSE = Function(
    "scatter_diffuse",
    Answer(
        read_samples,
        words_of_samples,
        lambda inputs, _expected, actual: first(*_sample_problems(inputs, actual)),
        lambda inputs, _expected, actual: 0.5 * share_beyond(1, *_sample_problems(inputs, actual)),
        is_drawn=True,
    ),
    (
        Group("any colour", lambda d: _scatter(d, _colored(d), d.direction(), 512)),
        Group("some channels black", lambda d: _scatter(d, _one_black(d), d.direction(), 512)),
        Group("a dark colour", lambda d: _scatter(d, _dark(d), d.direction(), 512)),
        Group("white", lambda d: _scatter(d, Fill(), d.direction(), 512)),
        Group("a lamp", lambda d: _scatter(d, _colored(d), d.direction(), 512, d.color(0.5, 4.0))),
        Group("nothing comes back", lambda d: _scatter(d, _black(d), d.direction(), 64), exact=True),
        Group("along an axis", lambda d: _scatter(d, _colored(d), d.axis(), 512), exact=True),
        Group("very many samples", lambda d: _scatter(d, _colored(d), d.direction(), 16_384)),
    ),
)


# Roulette.


def _weight(x: float, y: float, z: float) -> Inputs:
    return {"weight": Vec(rounded((x, y, z)))}


def _mixed(draw: RandomSource, low: float, high: float) -> Inputs:
    return _weight(*draw.color(low, high))


def _one_bright(draw: RandomSource) -> Inputs:
    """One channel is far above the others."""
    color = [draw.real(0.5, 0.93), draw.real(0.0, 0.1), draw.real(0.0, 0.1)]
    turn = draw.whole(0, 2)
    return _weight(*(color[turn:] + color[:turn]))


def _nearly_white(draw: RandomSource) -> Inputs:
    """Its largest channel is above what a path may go on with, and below 1."""
    color = [draw.real(0.955, 0.999), draw.real(0.1, 0.94), draw.real(0.1, 0.94)]
    turn = draw.whole(0, 2)
    return _weight(*(color[turn:] + color[:turn]))


_SURVIVAL = Function(
    "survival_probability",
    number_answer("the probability", Tolerance(1e-6, 1e-5)),
    (
        Group("any weight", lambda d: _mixed(d, 0.01, 0.94)),
        Group("one channel is bright", _one_bright),
        Group(
            "nearly white, and more", lambda d: _weight(d.real(0.951, 20), d.real(0.1, 9), d.real(0.1, 1)), exact=True
        ),
        Group("between the most and white", _nearly_white, exact=True),
        Group("a faint one", lambda d: _mixed(d, 1e-6, 1e-3)),
        Group("black", lambda _d: _weight(0.0, 0.0, 0.0), exact=True),
    ),
)

FUNCTIONS = (_COSINE_DIRECTION, _COSINE_PDF, _SCATTER_DIFFUSE, _SURVIVAL, PATH_LIGHT)
