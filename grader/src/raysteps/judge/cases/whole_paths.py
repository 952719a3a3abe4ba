"""Whole paths through scripted scenes, in step 13 and after it."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from raysteps.common.vectors import Vector, add, length, minus, times
from raysteps.judge.answers import Answer, Tolerance, angle, channels, first, itself, plainly_wrong
from raysteps.judge.estimates import BatchMeans, estimates_problem, plan, read_estimates, words_of_estimates
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Inputs, Ray, Real, TokenReader, Whole, f32, rounded, vector_words
from raysteps.judge.random_source import RandomSource
from raysteps.judge.scripted_tracer import MAX_ASKED, MisScript, PathHit, PathScript, Scatter
from raysteps.judge.statistics import DEVIATIONS, ratio_problem

BLACK: Vector = (0.0, 0.0, 0.0)
WHITE: Vector = (1.0, 1.0, 1.0)

# What a scene's rays meet is scripted. As long as no roulette is played one path gives the exact light;
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
    light = BLACK if specular else draw.color(0.1, 1.0)
    scatter = None if last else Scatter(draw.direction(), draw.color(0.3, 0.9), specular)
    sent = draw.color(0.5, 4.0) if emission else BLACK
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
        sky = draw.color(0.1, 0.9) if background else BLACK
        return once(draw, PathScript(sky, goes_on=False, hits=_hits(draw, kinds)))

    return make


def _gray(draw: RandomSource, low: float, high: float) -> Vector:
    value = draw.real(low, high)
    return value, value, value


def _furnace(draw: RandomSource, low: float, high: float) -> PathScript:
    """Each wall sends back the same share of the light, and each gets the same from the lamps."""
    scatter = Scatter(draw.direction(), _gray(draw, low, high))
    hit = PathHit(1.5, draw.direction(), BLACK, draw.color(0.3, 1.0), scatter)
    return PathScript(BLACK, goes_on=True, hits=(hit,))


def _glowing(draw: RandomSource) -> PathScript:
    """Matt walls that are lamps, each of them sampled from the one before: what they send out counts for the eye only,
    however long the path is."""
    scatter = Scatter(draw.direction(), _gray(draw, 0.6, 0.7))
    hit = PathHit(1.5, draw.direction(), draw.color(0.5, 1.0), draw.color(0.1, 0.3), scatter)
    return PathScript(BLACK, goes_on=True, hits=(hit,))


_LATE = 32  # bounces: who cuts paths off finds nothing
VERY_LATE = 80  # of fifty paths one comes so far: enough of the first two thousand estimates find light


def _walls(draw: RandomSource, shares: Sequence[tuple[float, float]]) -> tuple[PathHit, ...]:
    """Grey ones without any light, which send on so much of what they get."""
    return tuple(
        PathHit(
            i + 1 + draw.real(0.1, 0.8),
            draw.direction(),
            BLACK,
            BLACK,
            Scatter(draw.direction(), _gray(draw, *share)),
        )
        for i, share in enumerate(shares)
    )


def _late(draw: RandomSource, bounces: int = _LATE) -> PathScript:
    """All light is found behind many bounces: roulette has taken most of the paths, and those left count more."""
    dark = _walls(draw, [(0.97, 0.99)] * bounces)
    last = PathHit(bounces + 2.5, draw.direction(), BLACK, draw.color(0.5, 2.0), None)
    return PathScript(BLACK, goes_on=False, hits=(*dark, last))


def _dark_wall(draw: RandomSource) -> PathScript:
    """The wall behind which roulette begins takes most of the light: so few paths go on from just there."""
    walls = _walls(draw, [*[(0.95, 0.98)] * BOUNCES_BEFORE_ROULETTE, (0.1, 0.15), (0.3, 0.5)])
    return PathScript(draw.color(0.5, 1.0), goes_on=False, hits=walls)


def _colored_walls(draw: RandomSource) -> PathScript:
    """A channel that is strong, one that is weak."""
    weight = (draw.real(0.75, 0.85), draw.real(0.3, 0.5), draw.real(0.55, 0.7))
    hit = PathHit(1.5, draw.direction(), BLACK, draw.color(0.3, 1.0), Scatter(draw.direction(), weight))
    return PathScript(BLACK, goes_on=True, hits=(hit,))


def _hall_of_mirrors(draw: RandomSource) -> PathScript:
    """Mirrors that glow a little, each shown in the next."""
    scatter = Scatter(draw.direction(), _gray(draw, 0.6, 0.75), specular=True)
    hit = PathHit(1.5, draw.direction(), draw.color(0.3, 1.0), BLACK, scatter)
    return PathScript(BLACK, goes_on=True, hits=(hit,))


def _bright(draw: RandomSource) -> Inputs:
    """A very bright lamp, seen or sampled behind a bounce or two."""
    hits = list(_hits(draw, ("", "", "x")))
    number = draw.whole(0, 2)
    old = hits[number]
    hits[number] = PathHit(old.distance, old.normal, BLACK, draw.color(50, 2000), old.scatter)
    return once(draw, PathScript(BLACK, goes_on=False, hits=tuple(hits)))


def _faint(draw: RandomSource) -> Inputs:
    """Walls that take nearly all of the light, and a lamp so bright that what is left counts: nothing but roulette ends
    a path, and these bounces are sure."""
    walls = _hits(draw, ("", "s", "x") if draw.chance(0.3) else ("",) * draw.whole(1, BOUNCES_BEFORE_ROULETTE) + ("x",))
    light, found = draw.color(0.5, 1.0), []
    for wall in walls:
        share = f32(draw.logarithmic(1e-3, 0.02))
        scatter = wall.scatter and replace(wall.scatter, weight=(share, share, share))
        found.append(replace(wall, light=BLACK if scatter else rounded(light), scatter=scatter))
        light = times(1 / share, light)
    return once(draw, PathScript(BLACK, goes_on=False, hits=tuple(found)))


def _weighing(weight: Callable[[RandomSource], Vector], *choices: tuple[str, ...]) -> Callable[[RandomSource], Inputs]:
    """Scripts of such kinds, with other weights."""
    make = _of_kinds(*choices)

    def changed(draw: RandomSource) -> Inputs:
        inputs = make(draw)
        script = inputs["tracer"]
        assert isinstance(script, PathScript)
        scatters = (hit.scatter and replace(hit.scatter, weight=weight(draw)) for hit in script.hits)
        hits = tuple(replace(hit, scatter=scatter) for hit, scatter in zip(script.hits, scatters, strict=True))
        return {**inputs, "tracer": PathScript(BLACK, goes_on=False, hits=hits)}

    return changed


# White walls take nothing, and are no mirrors. A direction that is seldom drawn counts for more than itself.
_WHITE_WALLS = _weighing(lambda _d: WHITE, ("", "ex"), ("", "", "ex"), ("s", "", "ex"), ("", "s", "ex"))
_ABOVE_WHITE = _weighing(lambda d: d.color(1.2, 4.0), ("", "x"), ("", "", "x"), ("s", "ex"), ("s", "", "x"))


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
        lamps = [emission(draw) if any(hit.emission) else BLACK for hit in script.hits]
        hits = tuple(replace(hit, emission=sent, light=BLACK) for hit, sent in zip(script.hits, lamps, strict=True))
        return {**inputs, "tracer": PathScript(BLACK, goes_on=False, hits=hits)}

    return changed


PATH_LIGHT = Function(
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
        Group("white walls", _WHITE_WALLS),
        Group("weights above 1", _ABOVE_WHITE),
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
