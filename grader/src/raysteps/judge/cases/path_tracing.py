"""Cases of step 13: directions with a density, what they count, and paths through scripted scenes."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from raysteps.common.vectors import Vector, add, cross, length, minus, times, unit
from raysteps.judge.answers import (
    Answer,
    Tolerance,
    angle,
    channels,
    first,
    itself,
    number_answer,
    plainly_wrong,
    share_beyond,
)
from raysteps.judge.draws import (
    Samples,
    draws,
    read_directions,
    read_samples,
    unit_problem,
    words_of_directions,
    words_of_samples,
)
from raysteps.judge.estimates import BatchMeans, estimates_problem, plan, read_estimates, words_of_estimates
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import (
    Fill,
    Hit,
    Inputs,
    Ray,
    Real,
    TokenReader,
    Vec,
    Whole,
    f32,
    rounded,
    vec_of,
    vector_words,
    whole_of,
)
from raysteps.judge.random_source import RandomSource, next_axis
from raysteps.judge.scripted_tracer import MAX_ASKED, MisScript, PathHit, PathScript, Scatter
from raysteps.judge.statistics import DEVIATIONS, Numbers, has_mean, is_uniform, ratio_problem, uneven_problem

_BLACK: Vector = (0.0, 0.0, 0.0)
WHITE: Vector = (1.0, 1.0, 1.0)

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
    return {"normal": Vec(normal), **draws(draw, amount)}


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


def _scatter(draw: RandomSource, fill: Fill, normal: Vector, amount: int, emission: Vector = _BLACK) -> Inputs:
    along = times(-1, draw.above(normal, 0.05))
    hit = Hit(draw.point(5), normal, along, draw.real(0.5, 9), fill, draw.chance(0.7))
    return {"hit": hit, "emission": Vec(emission), **draws(draw, amount)}


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


# Whole paths. What a scene's rays meet is scripted. As long as no roulette is played one path gives the exact light;
# with it, the mean of many is compared with the sum that the script makes certain.

BOUNCES_BEFORE_ROULETTE = 3  # bounces before roulette, as in the contract
_ON_THE_HIT, _AT_THE_HIT = 5e-5, 0.02  # from the surface, in world units
_DEGREES = 0.5
_SMALLEST = 1e-12  # of a weight: what comes after it adds nothing


@dataclass(frozen=True)
class _Light:
    """Of one path, with the rays that were cast; or the mean of many."""

    color: Vector
    cast: tuple[Ray, ...]
    many: BatchMeans | None


def _read_light(tokens: TokenReader) -> _Light:
    if tokens.word() == "often":
        many = read_estimates(tokens)
        x, y, z = (float(channel) for channel in many.mean)
        return _Light((x, y, z), (), many)
    color = tokens.vector()
    return _Light(color, tuple(Ray(tokens.vector(), tokens.vector()) for _ in range(tokens.whole(0, MAX_ASKED))), None)


def _words_of_light(light: _Light) -> str:
    if light.many is not None:
        return words_of_estimates(light.many)
    cast = "; ".join(ray.words() for ray in light.cast) or "none"
    return f"light {vector_words(light.color)}; rays cast: {cast}"


def _distances(inputs: Inputs) -> list[float]:
    script = inputs["tracer"]
    assert isinstance(script, PathScript | MisScript)
    return [hit.distance for hit in script.hits]


def mean_light(script: PathScript) -> Vector:
    """What paths bring on average: all that the script's rays find, each with the weight that it has there."""
    light, weight = np.zeros(3), np.ones(3)
    sees_lamps = True
    number = 0
    while weight.max() > _SMALLEST:
        if number >= len(script.hits) and not (script.goes_on and script.hits):
            light += weight * np.array(script.background)
            break
        hit = script.hits[min(number, len(script.hits) - 1)]
        light += weight * (np.array(hit.light) + (np.array(hit.emission) if sees_lamps and hit.front_face else 0.0))
        if hit.scatter is None:
            break
        weight = weight * np.array(hit.scatter.weight)
        sees_lamps = hit.scatter.specular
        number += 1
    x, y, z = (float(channel) for channel in light)
    return x, y, z


def _is_astray(inputs: Inputs, expected: Sequence[Ray], actual: Sequence[Ray]) -> bool:
    """A ray other than scattered_ray's, from the hit that the ray before it had."""
    same = all(
        angle(mine.direction, theirs.direction) <= _DEGREES for mine, theirs in zip(expected, actual, strict=True)
    )
    if not same or not length(minus(expected[0].origin, actual[0].origin)) <= 1e-3:
        return True
    for before, after, distance in zip(actual, actual[1:], _distances(inputs), strict=False):
        position = add(before.origin, before.direction, distance)
        if not _ON_THE_HIT <= length(minus(after.origin, position)) <= _AT_THE_HIT:
            return True
    return False


_SPREAD = 1.5  # standard deviation of a path's questions, as a share of their mean, at most
_SLACK = 0.01


def length_problem(expected: BatchMeans, actual: BatchMeans) -> str:
    """Roulette says how many rays a path has on average. Who ends it by other rules asks more or less."""
    share = actual.cost / actual.count / (expected.cost / expected.count)
    most = _SLACK + DEVIATIONS * _SPREAD * math.sqrt(1 / actual.count + 1 / expected.count)
    if abs(share - 1) <= most:
        return ""
    return ratio_problem(f"paths {'go on for too long' if share > 1 else 'end too soon'}", np.array([share]))


ManyProblem = Callable[[Inputs, BatchMeans, BatchMeans], str]


def _light_problem(of_many: ManyProblem, inputs: Inputs, expected: _Light, actual: _Light) -> str:
    if (expected.many is None) != (actual.many is None):
        return "no proper answer came"
    if expected.many is not None and actual.many is not None:
        return of_many(inputs, expected.many, actual.many)
    counts = ""
    if len(actual.cast) != len(expected.cast):
        counts = f"too {'many' if len(actual.cast) > len(expected.cast) else 'few'} rays were cast"
    astray = not counts and _is_astray(inputs, expected.cast, actual.cast)
    return first(
        counts,
        plainly_wrong("a ray that was cast") if astray else "",
        channels("the light", expected.color, actual.color, Tolerance(1e-4, 5e-4)),
    )


def _light_credit(inputs: Inputs, expected: _Light, actual: _Light) -> float:
    """The right rays with a wrong light are a quarter of it."""
    if expected.many is not None or len(actual.cast) != len(expected.cast) or len(actual.cast) < 2:
        return 0.0
    return 0.0 if _is_astray(inputs, expected.cast, actual.cast) else 0.25


def path_answer(of_many: ManyProblem) -> Answer[_Light]:
    """Of a function that follows paths, one or many."""
    return Answer(
        _read_light,
        _words_of_light,
        partial(_light_problem, of_many),
        _light_credit,
        near=lambda light: itself(light.color),
    )


def _many_problem(inputs: Inputs, expected: BatchMeans, actual: BatchMeans) -> str:
    script = inputs["tracer"]
    assert isinstance(script, PathScript)
    return first(length_problem(expected, actual), estimates_problem("the light", mean_light(script), expected, actual))


def once(draw: RandomSource, script: PathScript | MisScript) -> Inputs:
    """One path."""
    ray = Ray(draw.point(3), draw.direction())
    seed = Whole(draw.whole(1, 1_000_000_000))
    return {"ray": ray, "tracer": script, "seed": seed, "precision": Real(0.0), "most": Whole(0)}


def often(draw: RandomSource, script: PathScript | MisScript, bias: float) -> Inputs:
    """As many paths as it takes to find a bias of that share."""
    return {"ray": Ray(draw.point(3), draw.direction()), "tracer": script, **plan(draw, bias)}


def _path_hit(
    draw: RandomSource,
    number: int,
    *,
    emission: bool = False,
    specular: bool = False,
    last: bool = False,
    behind: bool = False,
) -> PathHit:
    """Light that is sampled there, unless it is a mirror; emission where it is wanted."""
    light = _BLACK if specular else draw.color(0.1, 1.0)
    scatter = None if last else Scatter(draw.direction(), draw.color(0.3, 0.9), specular)
    sent = draw.color(0.5, 4.0) if emission else _BLACK
    return PathHit(number + 1 + draw.real(0.1, 0.8), draw.direction(), sent, light, scatter, not behind)


def _hits(draw: RandomSource, kinds: Sequence[str]) -> tuple[PathHit, ...]:
    """Letters: e that it sends light itself, b that it is met from behind, s that it is specular, x that the path ends
    there."""
    return tuple(
        _path_hit(draw, i, emission="e" in kind, specular="s" in kind, last="x" in kind, behind="b" in kind)
        for i, kind in enumerate(kinds)
    )


def _plain(draw: RandomSource) -> Inputs:
    """One to four hits, some of which send light; the path ends there, or leaves the scene."""
    size = draw.whole(1, 4)
    kinds = ["e" if draw.chance(0.3) else "" for _ in range(size)]
    if size == 4 or draw.chance(0.5):
        kinds[-1] += "x"
    return once(draw, PathScript(draw.color(0.1, 0.8), goes_on=False, hits=_hits(draw, kinds)))


def _of_kinds(*choices: tuple[str, ...], background: bool = False) -> Callable[[RandomSource], Inputs]:
    def make(draw: RandomSource) -> Inputs:
        kinds = choices[draw.whole(0, len(choices) - 1)]
        sky = draw.color(0.1, 0.9) if background else _BLACK
        return once(draw, PathScript(sky, goes_on=False, hits=_hits(draw, kinds)))

    return make


def _gray(draw: RandomSource, low: float, high: float) -> Vector:
    value = draw.real(low, high)
    return value, value, value


def _furnace(draw: RandomSource, low: float, high: float) -> PathScript:
    """Each wall sends back the same share of the light, and each gets the same from the lamps."""
    scatter = Scatter(draw.direction(), _gray(draw, low, high))
    hit = PathHit(1.5, draw.direction(), _BLACK, draw.color(0.3, 1.0), scatter)
    return PathScript(_BLACK, goes_on=True, hits=(hit,))


def _glowing(draw: RandomSource) -> PathScript:
    """Matt walls that are lamps, each of them sampled from the one before: what they send out counts for the eye only,
    however long the path is."""
    scatter = Scatter(draw.direction(), _gray(draw, 0.6, 0.7))
    hit = PathHit(1.5, draw.direction(), draw.color(0.5, 1.0), draw.color(0.1, 0.3), scatter)
    return PathScript(_BLACK, goes_on=True, hits=(hit,))


_LATE = 32  # bounces: who cuts paths off finds nothing
VERY_LATE = 80  # of fifty paths one comes so far: enough of the first two thousand estimates find light


def _walls(draw: RandomSource, shares: Sequence[tuple[float, float]]) -> tuple[PathHit, ...]:
    """Grey ones without any light, which send on so much of what they get."""
    return tuple(
        PathHit(
            i + 1 + draw.real(0.1, 0.8),
            draw.direction(),
            _BLACK,
            _BLACK,
            Scatter(draw.direction(), _gray(draw, *share)),
        )
        for i, share in enumerate(shares)
    )


def _late(draw: RandomSource, bounces: int = _LATE) -> PathScript:
    """All light is found behind many bounces: roulette has taken most of the paths, and those left count more."""
    dark = _walls(draw, [(0.97, 0.99)] * bounces)
    last = PathHit(bounces + 2.5, draw.direction(), _BLACK, draw.color(0.5, 2.0), None)
    return PathScript(_BLACK, goes_on=False, hits=(*dark, last))


def _dark_wall(draw: RandomSource) -> PathScript:
    """The wall behind which roulette begins takes most of the light: so few paths go on from just there."""
    walls = _walls(draw, [*[(0.95, 0.98)] * BOUNCES_BEFORE_ROULETTE, (0.1, 0.15), (0.3, 0.5)])
    return PathScript(draw.color(0.5, 1.0), goes_on=False, hits=walls)


def _colored_walls(draw: RandomSource) -> PathScript:
    """A channel that is strong, one that is weak."""
    weight = (draw.real(0.75, 0.85), draw.real(0.3, 0.5), draw.real(0.55, 0.7))
    hit = PathHit(1.5, draw.direction(), _BLACK, draw.color(0.3, 1.0), Scatter(draw.direction(), weight))
    return PathScript(_BLACK, goes_on=True, hits=(hit,))


def _hall_of_mirrors(draw: RandomSource) -> PathScript:
    """Mirrors that glow a little, each shown in the next."""
    scatter = Scatter(draw.direction(), _gray(draw, 0.6, 0.75), specular=True)
    hit = PathHit(1.5, draw.direction(), draw.color(0.3, 1.0), _BLACK, scatter)
    return PathScript(_BLACK, goes_on=True, hits=(hit,))


def _bright(draw: RandomSource) -> Inputs:
    """A very bright lamp, seen or sampled behind a bounce or two."""
    hits = list(_hits(draw, ("", "", "x")))
    number = draw.whole(0, 2)
    old = hits[number]
    hits[number] = PathHit(old.distance, old.normal, _BLACK, draw.color(50, 2000), old.scatter)
    return once(draw, PathScript(_BLACK, goes_on=False, hits=tuple(hits)))


def _faint(draw: RandomSource) -> Inputs:
    """Walls that take nearly all of the light, and a lamp so bright that what is left counts: nothing but roulette ends
    a path, and these bounces are sure."""
    walls = _hits(draw, ("", "s", "x") if draw.chance(0.3) else ("",) * draw.whole(1, BOUNCES_BEFORE_ROULETTE) + ("x",))
    light, found = draw.color(0.5, 1.0), []
    for wall in walls:
        share = f32(draw.logarithmic(1e-3, 0.02))
        scatter = wall.scatter and replace(wall.scatter, weight=(share, share, share))
        found.append(replace(wall, light=_BLACK if scatter else rounded(light), scatter=scatter))
        light = times(1 / share, light)
    return once(draw, PathScript(_BLACK, goes_on=False, hits=tuple(found)))


def _white_walls(draw: RandomSource) -> Inputs:
    """They take nothing, and are no mirrors."""
    make = _of_kinds(("", "ex"), ("", "", "ex"), ("s", "", "ex"), ("", "s", "ex"))
    inputs = make(draw)
    script = inputs["tracer"]
    assert isinstance(script, PathScript)
    hits = tuple(replace(hit, scatter=hit.scatter and replace(hit.scatter, weight=WHITE)) for hit in script.hits)
    return {**inputs, "tracer": PathScript(_BLACK, goes_on=False, hits=hits)}


def one_channel(draw: RandomSource) -> Vector:
    """A light that is red, green or blue and nothing else."""
    channel, light = draw.whole(0, 2), draw.color(0.5, 4.0)
    x, y, z = (light[i] if i == channel else 0.0 for i in range(3))
    return x, y, z


def _seen(emission: Callable[[RandomSource], Vector]) -> Callable[[RandomSource], Inputs]:
    """Lamps that the eye or a mirror sees, and none that is sampled."""
    make = _of_kinds(("ex",), ("e", "x"), ("s", "ex"), ("s", "s", "ex"), ("", "s", "ex"))

    def changed(draw: RandomSource) -> Inputs:
        inputs = make(draw)
        script = inputs["tracer"]
        assert isinstance(script, PathScript)
        lamps = [emission(draw) if any(hit.emission) else _BLACK for hit in script.hits]
        hits = tuple(replace(hit, emission=sent, light=_BLACK) for hit, sent in zip(script.hits, lamps, strict=True))
        return {**inputs, "tracer": PathScript(_BLACK, goes_on=False, hits=hits)}

    return changed


_PATH_LIGHT = Function(
    "path_light",
    path_answer(_many_problem),
    (
        Group("up to four hits", _plain),
        Group("a lamp that is seen", _of_kinds(("ex",), ("e", "x"), ("e", "", "x"))),
        Group("a lamp behind a diffuse bounce", _of_kinds(("", "ex"), ("", "", "ex"), ("", "e", "ex"))),
        Group("a lamp from behind", _of_kinds(("ebx",), ("eb", "x"), ("s", "ebx"), ("e", "ebx"))),
        Group("mirrors", _of_kinds(("s", "ex"), ("s", "s", "ex"), ("", "s", "ex"), ("s", "", "ex"), ("s", "e", "x"))),
        Group("nothing is met", _of_kinds((), ("",), ("s",), ("", ""), ("", "s", ""), background=True)),
        Group("a very bright lamp", _bright),
        Group("a very bright lamp that is seen", _seen(lambda d: d.color(50, 2000))),
        Group("a lamp of one colour", _seen(one_channel)),
        Group("white walls", _white_walls),
        Group("faint paths", _faint),
        Group("a furnace", lambda d: often(d, _furnace(d, 0.5, 0.6), 0.03)),
        Group("bright walls", lambda d: often(d, _furnace(d, 0.75, 0.8), 0.06)),
        Group("light found late", lambda d: often(d, _late(d), 0.2)),
        Group("light found very late", lambda d: often(d, _late(d, VERY_LATE), 0.7)),
        Group("walls that glow", lambda d: often(d, _glowing(d), 0.06)),
        Group("a dark wall", lambda d: often(d, _dark_wall(d), 0.3)),
        Group("coloured walls", lambda d: often(d, _colored_walls(d), 0.08)),
        Group("a hall of mirrors", lambda d: often(d, _hall_of_mirrors(d), 0.08)),
    ),
)

FUNCTIONS = (_COSINE_DIRECTION, _COSINE_PDF, _SCATTER_DIFFUSE, _SURVIVAL, _PATH_LIGHT)
