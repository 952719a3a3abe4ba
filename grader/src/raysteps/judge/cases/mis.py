"""Cases of step 15: weights of two ways to the same light, densities of lamps, and paths that find lamps both ways."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from raysteps.common.vectors import Vector, add, cross, minus, times, unit
from raysteps.judge.answers import Answer, Tolerance, channels, first, itself, number_answer, read_vector
from raysteps.judge.cases.whole_paths import (
    BLACK,
    BOUNCES_BEFORE_ROULETTE,
    VERY_LATE,
    WHITE,
    length_problem,
    often,
    once,
    one_channel,
    path_answer,
)
from raysteps.judge.estimates import BatchMeans, estimates_problem
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Inputs, Real, Vec, f32, rounded, vector_words
from raysteps.judge.random_source import RandomSource, next_axis
from raysteps.judge.scripted_tracer import (
    DirectSample,
    DirectSamples,
    MisHit,
    MisScript,
    PlateLamp,
    Scatter,
    WeighedScatter,
)
from raysteps.judge.surfaces import Triangle

# Weights.

_WEIGHT = number_answer("the weight", Tolerance(2e-6, 5e-5))


def _two(pdf: float, other: float) -> Inputs:
    return {"pdf": Real(f32(pdf)), "other_pdf": Real(f32(other))}


def _near_each_other(draw: RandomSource, low: float = 0.01, high: float = 100) -> Inputs:
    """So that neither weight is nearly 0."""
    pdf = draw.logarithmic(low, high)
    return _two(pdf, pdf * draw.logarithmic(0.2, 5))


_BALANCE_HEURISTIC = Function(
    "balance_heuristic",
    _WEIGHT,
    (
        Group("any densities", _near_each_other),
        Group("far from each other", lambda d: _two(d.logarithmic(1e-3, 1e3), d.logarithmic(1e-3, 1e3))),
        Group("very low ones", lambda d: _near_each_other(d, 1e-6, 1e-3)),
        Group("the same", lambda d: _two(*[d.logarithmic(0.01, 100)] * 2), exact=True),
        Group("the other way never comes", lambda d: _two(d.logarithmic(0.01, 100), 0.0), exact=True),
        Group("this way never comes", lambda d: _two(0.0, d.logarithmic(0.01, 100)), exact=True),
        Group("neither comes", lambda _: _two(0.0, 0.0), exact=True),
    ),
)

_POWER_HEURISTIC = Function(
    "power_heuristic",
    _WEIGHT,
    (
        Group("any densities", _near_each_other),
        Group("far from each other", lambda d: _two(d.logarithmic(1e-3, 1e3), d.logarithmic(1e-3, 1e3))),
        Group("very high ones", lambda d: _two(*(d.fine(0.3, 1) * 10 ** d.fine(12, 15) for _ in range(2)))),
        Group("very low ones", lambda d: _near_each_other(d, 1e-6, 1e-3)),
        Group("the same", lambda d: _two(*[d.logarithmic(0.01, 100)] * 2), exact=True),
        Group("the other way never comes", lambda d: _two(d.logarithmic(0.01, 100), 0.0), exact=True),
        Group("this way never comes", lambda d: _two(0.0, d.logarithmic(0.01, 100)), exact=True),
        Group("neither comes", lambda _: _two(0.0, 0.0), exact=True),
    ),
)


# Densities of lamps, of a place that a ray has met.

_DENSITY = number_answer("the density", Tolerance(1e-6, 3e-4))  # 3.14 for pi is more off


def _before(draw: RandomSource, position: Vector, normal: Vector, distance: float, cosines: Sequence[float]) -> Vector:
    """A place that the lamp is seen from at that distance, with a cosine between these at the lamp."""
    return rounded(add(position, draw.above(normal, *cosines), distance))


def _triangle_of(draw: RandomSource, make: Callable[[], Triangle], distance: float, low: float, high: float) -> Inputs:
    light = make()
    u, v = sorted((draw.fine(0.05, 0.95), draw.fine(0.05, 0.95)))
    edges = minus(light.b, light.a), minus(light.c, light.a)
    position = rounded(add(add(light.a, edges[0], u), edges[1], (1 - u) * v))
    normal = unit(cross(*edges))
    from_ = _before(draw, position, normal, distance, (low, high))
    return {"a": Vec(light.a), "b": Vec(light.b), "c": Vec(light.c), "from": Vec(from_), "position": Vec(position)}


def _triangle(draw: RandomSource, distance: float, low: float = 0.15, high: float = 0.99) -> Inputs:
    return _triangle_of(draw, lambda: draw.triangle(2.0), distance, low, high)


def _simple_triangle(draw: RandomSource) -> Inputs:
    """Half a square, straight before it."""
    corner, normal = draw.simple_point(2), draw.axis()
    side = next_axis(normal)
    other, size = cross(normal, side), draw.eighths(0.5, 2)
    b, c = add(corner, side, size), add(corner, other, size)
    position = add(corner, add(side, other), size / 4)
    from_ = add(position, normal, float(draw.whole(1, 3)))
    return {"a": Vec(corner), "b": Vec(b), "c": Vec(c), "from": Vec(from_), "position": Vec(position)}


_TRIANGLE_PDF = Function(
    "triangle_pdf",
    _DENSITY,
    (
        Group("any triangle", lambda d: _triangle(d, d.real(1, 6))),
        Group("simple numbers", _simple_triangle),
        Group("at a slant", lambda d: _triangle(d, d.real(1, 6), 0.03, 0.15)),
        Group("near and far", lambda d: _triangle(d, d.logarithmic(0.5, 200))),
        Group("from behind", lambda d: _triangle(d, d.real(1, 6), -0.99, -0.05)),
    ),
)


def _disk(draw: RandomSource, distance: float, low: float = 0.15, high: float = 0.99) -> Inputs:
    center, normal, radius = draw.point(4), draw.direction(), draw.logarithmic(0.1, 3)
    across = unit(cross(normal, draw.across(normal)))
    position = rounded(add(center, across, radius * draw.fine(0, 0.95)))
    from_ = _before(draw, position, normal, distance, (low, high))
    vectors = {"center": Vec(center), "normal": Vec(normal)}
    return {**vectors, "radius": Real(radius), "from": Vec(from_), "position": Vec(position)}


_DISK_PDF = Function(
    "disk_pdf",
    _DENSITY,
    (
        Group("any disk", lambda d: _disk(d, d.real(1, 6))),
        Group("at a slant", lambda d: _disk(d, d.real(1, 6), 0.03, 0.15)),
        Group("near and far", lambda d: _disk(d, d.logarithmic(0.5, 200))),
        Group("from behind", lambda d: _disk(d, d.real(1, 6), -0.99, -0.05)),
    ),
)


def _sphere(draw: RandomSource, share: float) -> Inputs:
    """Seen from so many radii away."""
    center, radius = draw.point(3), draw.logarithmic(0.1, 3)
    from_ = rounded(add(center, draw.direction(), radius * share))
    return {"center": Vec(center), "radius": Real(radius), "from": Vec(from_)}


def _on_sphere(draw: RandomSource) -> Inputs:
    center, radius = draw.simple_point(2), draw.eighths(0.5, 2)
    return {"center": Vec(center), "radius": Real(radius), "from": Vec(add(center, draw.axis(), radius))}


_SPHERE_PDF = Function(
    "sphere_pdf",
    _DENSITY,
    (
        Group("any distance", lambda d: _sphere(d, d.logarithmic(1.3, 10))),
        Group("near the surface", lambda d: _sphere(d, d.fine(1.02, 1.3))),
        Group("small and far", lambda d: _sphere(d, d.logarithmic(30, 3000))),
        Group("from inside", lambda d: _sphere(d, d.fine(0.05, 0.95))),
        Group("on the sphere", _on_sphere, exact=True),
    ),
)


# What samples of lamps bring.


def _density(draw: RandomSource) -> float:
    return draw.logarithmic(0.05, 20)


def _extreme_density(draw: RandomSource) -> float:
    """Seldom chosen, or of a small lamp far away and of a polished plate."""
    return draw.logarithmic(1e-6, 1e-3) if draw.chance(0.5) else draw.logarithmic(1e4, 1e8)


def _sample(draw: RandomSource, density: Callable[[RandomSource], float] = _density) -> DirectSample:
    pdf = density(draw)
    return DirectSample(draw.color(0.1, 2.0), pdf, f32(pdf * draw.logarithmic(0.2, 5)))


def _point_light(draw: RandomSource) -> DirectSample:
    """No path ever meets it."""
    return DirectSample(draw.color(0.1, 2.0), 1.0, 0.0)


def _unlikely(draw: RandomSource) -> DirectSample:
    """The path all but never goes where the lamp's sample is, or nearly always."""
    sample = _sample(draw)
    factor = draw.logarithmic(1e3, 1e5) if draw.chance(0.5) else draw.logarithmic(1e-5, 1e-3)
    return DirectSample(sample.light, sample.pdf, f32(sample.pdf * factor))


def _bright(draw: RandomSource) -> DirectSample:
    sample = _sample(draw)
    return DirectSample(draw.color(100, 5000), sample.pdf, sample.scatter_pdf)


def _of_extreme_density(draw: RandomSource) -> DirectSample:
    return _sample(draw, _extreme_density)


def _samples(draw: RandomSource, low: int, high: int, make: Callable[[RandomSource], DirectSample]) -> Inputs:
    return {"samples": DirectSamples(tuple(make(draw) for _ in range(draw.whole(low, high))))}


_DIRECT_LIGHT = Function(
    "direct_light",
    Answer(
        read_vector,
        vector_words,
        lambda _, expected, actual: channels("the light", expected, actual, Tolerance(2e-5, 3e-4)),
        near=itself,
    ),
    (
        Group("one lamp", lambda d: _samples(d, 1, 1, _sample)),
        Group("several lamps", lambda d: _samples(d, 2, 5, _sample)),
        Group("lamps without a size", lambda d: _samples(d, 1, 2, _point_light)),
        Group("one way is much the better", lambda d: _samples(d, 1, 2, _unlikely)),
        Group("very bright lamps", lambda d: _samples(d, 1, 2, _bright)),
        Group("very low densities and very high ones", lambda d: _samples(d, 1, 2, _of_extreme_density)),
        Group("no lamps", lambda d: _samples(d, 0, 0, _sample), exact=True),
    ),
)


def _scatter(draw: RandomSource, pdf: float, *, specular: bool = False) -> WeighedScatter:
    return WeighedScatter(Scatter(draw.direction(), draw.color(0.3, 0.9), specular), pdf)


def _emission(
    draw: RandomSource, low: float, high: float, density: Callable[[RandomSource], float] = _density
) -> Inputs:
    pdf = density(draw)
    return {"sample": _scatter(draw, pdf), "light_pdf": Real(f32(pdf * draw.logarithmic(low, high)))}


def _emission_in_mirror(draw: RandomSource) -> Inputs:
    """What is specular says the sample, not its density, which is 1 of some matt surfaces, too."""
    pdf = _density(draw) if draw.chance(0.4) else 1.0
    return {"sample": _scatter(draw, pdf, specular=draw.chance(0.7)), "light_pdf": Real(_density(draw))}


def _behind_white(draw: RandomSource) -> Inputs:
    """Takes nothing, and is no mirror."""
    inputs = _emission(draw, 0.2, 5)
    sample = inputs["sample"]
    assert isinstance(sample, WeighedScatter)
    return {**inputs, "sample": _whitened(sample)}


def _whitened(sample: WeighedScatter) -> WeighedScatter:
    return _weighing(sample, WHITE)


def _weighing(sample: WeighedScatter, weight: Vector) -> WeighedScatter:
    return replace(sample, scatter=replace(sample.scatter, weight=weight))


def _never_sampled(draw: RandomSource) -> Inputs:
    return {"sample": _scatter(draw, _density(draw)), "light_pdf": Real(0.0)}


_EMISSION_WEIGHT = Function(
    "emission_weight",
    _WEIGHT,
    (
        Group("any densities", lambda d: _emission(d, 0.2, 5)),
        Group("far from each other", lambda d: _emission(d, 1e-3, 1e3)),
        Group("very low densities and very high ones", lambda d: _emission(d, 0.2, 5, _extreme_density)),
        Group("in a mirror", _emission_in_mirror, exact=True),
        Group("a lamp that is never sampled", _never_sampled, exact=True),
        Group("behind a white surface", _behind_white),
    ),
)


# Whole paths. Where all is scripted one path gives the exact light, with weights by the power heuristic. Then plates
# with lamps: a plate scatters by the cosine with its normal to a power m, so a direction whose cosine lies between
# low and high comes with the probability high^(m + 1) - low^(m + 1). A lamp fills all of these. What a plate sends on
# is weight * radiance * probability, whichever way it is found; where no lamp is met the path goes on.


def _hit(draw: RandomSource, number: int, kind: str) -> MisHit:
    """Letters: e that it sends light itself, b that it is met from behind, n that it is never sampled, s that it is
    specular, l that lamps are sampled there, p that lamps without a size are, x that the path ends there."""
    samples = [_sample(draw) for _ in range(draw.whole(1, 3))] if "l" in kind else []
    samples += [_point_light(draw)] if "p" in kind else []
    specular = "s" in kind
    scatter = None if "x" in kind else _scatter(draw, 1.0 if specular else _density(draw), specular=specular)
    return MisHit(
        f32(number + 1 + draw.real(0.1, 0.8)),
        draw.direction(),
        draw.color(0.5, 4.0) if "e" in kind else BLACK,
        "b" not in kind,
        0.0 if "n" in kind else _density(draw),
        DirectSamples(tuple(samples)),
        scatter,
    )


def _script(draw: RandomSource, kinds: Sequence[str], background: Vector = BLACK) -> MisScript:
    return MisScript(background, goes_on=False, hits=tuple(_hit(draw, i, kind) for i, kind in enumerate(kinds)))


def _plain(draw: RandomSource) -> Inputs:
    """One to four hits, lamps at all and among them; the path ends there, or leaves the scene."""
    size = draw.whole(1, 4)
    kinds = ["el" if draw.chance(0.4) else "l" for _ in range(size)]
    if size == 4 or draw.chance(0.5):
        kinds[-1] += "x"
    return once(draw, _script(draw, kinds, draw.color(0.1, 0.8)))


def _of_kinds(*choices: tuple[str, ...], background: bool = False) -> Callable[[RandomSource], Inputs]:
    def make(draw: RandomSource) -> Inputs:
        kinds = choices[draw.whole(0, len(choices) - 1)]
        return once(draw, _script(draw, kinds, draw.color(0.1, 0.9) if background else BLACK))

    return make


def _changed(
    change: Callable[[RandomSource, MisHit], MisHit], *choices: tuple[str, ...]
) -> Callable[[RandomSource], Inputs]:
    """Scripts of such kinds, with each hit changed."""

    def make(draw: RandomSource) -> Inputs:
        script = _script(draw, choices[draw.whole(0, len(choices) - 1)])
        hits = tuple(change(draw, hit) for hit in script.hits)
        return once(draw, MisScript(BLACK, goes_on=False, hits=hits))

    return make


def _very_bright(draw: RandomSource, hit: MisHit) -> MisHit:
    """Whoever cuts bright light off makes the mean wrong."""
    emission = draw.color(100, 5000) if any(hit.emission) else BLACK
    return replace(hit, emission=emission, samples=DirectSamples(tuple(_bright(draw) for _ in hit.samples.samples)))


def _white(_draw: RandomSource, hit: MisHit) -> MisHit:
    """It takes nothing, and is no mirror for that."""
    return replace(hit, scatter=hit.scatter and _whitened(hit.scatter))


def _above_white(draw: RandomSource, hit: MisHit) -> MisHit:
    """A direction that is seldom drawn counts for more than itself."""
    return replace(hit, scatter=hit.scatter and _weighing(hit.scatter, draw.color(1.2, 4.0)))


def _faint(draw: RandomSource) -> Inputs:
    """Walls that take nearly all of the light, and a lamp so bright that what is left counts: nothing but roulette ends
    a path, and these bounces are sure."""
    kinds = ("",) * draw.whole(1, BOUNCES_BEFORE_ROULETTE) + (("ex", "lx")[draw.whole(0, 1)],)
    walls, light = _script(draw, kinds).hits, draw.real(0.5, 1.0)
    found = []
    for wall in walls[:-1]:
        share = f32(draw.logarithmic(1e-3, 0.02))
        light /= share
        assert wall.scatter is not None
        found.append(replace(wall, scatter=_weighing(wall.scatter, (share, share, share))))
    lamp = replace(walls[-1], emission=_brighter(walls[-1].emission, light))
    samples = (replace(sample, light=_brighter(sample.light, light)) for sample in lamp.samples.samples)
    hits = (*found, replace(lamp, samples=DirectSamples(tuple(samples))))
    return once(draw, MisScript(BLACK, goes_on=False, hits=hits))


def _brighter(color: Vector, by: float) -> Vector:
    return rounded(times(by, color))


def _one_colored(draw: RandomSource, hit: MisHit) -> MisHit:
    """Its lamp shines in one channel alone."""
    return replace(hit, emission=one_channel(draw)) if any(hit.emission) else hit


def _plate(draw: RandomSource, exponent: float, lamps: tuple[PlateLamp, ...], low: float, high: float) -> MisHit:
    scatter = WeighedScatter(Scatter(draw.direction(), draw.color(low, high)), 0.0)
    return MisHit(2.5, draw.direction(), BLACK, True, 0.0, DirectSamples(()), scatter, f32(exponent), lamps)


def _lamp(draw: RandomSource, low: float, high: float = 1.0) -> PlateLamp:
    return PlateLamp(f32(low), f32(high), draw.color(0.5, 4.0))


def _one_plate(draw: RandomSource, exponent: float, *lamps: PlateLamp) -> MisScript:
    return MisScript(BLACK, goes_on=False, hits=(_plate(draw, exponent, lamps, 0.4, 0.9),))


def _polished(draw: RandomSource) -> MisScript:
    """Samples of the lamp all but never lie where the plate mirrors to, and about half of the paths meet it."""
    exponent = draw.logarithmic(200, 1000)
    return _one_plate(draw, exponent, _lamp(draw, draw.fine(0.2, 0.6), draw.fine(0.4, 0.7) ** (1 / exponent)))


def _dull(draw: RandomSource) -> MisScript:
    """Paths all but never meet the lamp. A dim, large one beside it makes some noise, whatever one does."""
    high = draw.fine(0.9, 1.0)
    dim = PlateLamp(f32(draw.fine(0.1, 0.2)), f32(draw.fine(0.6, 0.7)), draw.color(0.02, 0.04))
    return _one_plate(draw, draw.fine(1, 3), _lamp(draw, high - draw.fine(0.0005, 0.001), high), dim)


def _of_all_sizes(draw: RandomSource) -> MisScript:
    edges = [draw.fine(0.1, 0.5), draw.fine(0.7, 0.9), draw.fine(0.98, 0.99), draw.fine(0.9995, 0.9998)]
    lamps = (_lamp(draw, edges[0], edges[1]), _lamp(draw, edges[2] - 0.02, edges[2]), _lamp(draw, edges[3]))
    return _one_plate(draw, draw.logarithmic(20, 60), *lamps)


def _in_turn(draw: RandomSource) -> MisScript:
    """Plate after plate, and most of the light is found late."""
    lamp = _lamp(draw, draw.fine(0.98, 0.99))
    return MisScript(BLACK, goes_on=True, hits=(_plate(draw, draw.fine(3, 8), (lamp,), 0.8, 0.92),))


def _late(draw: RandomSource) -> MisScript:
    """Plates without lamps, and light behind all of them: who cuts paths off finds none."""
    plates = (replace(_plate(draw, 1.0, (), 0.97, 0.99), distance=f32(i + 2.5)) for i in range(VERY_LATE))
    return MisScript(draw.color(0.5, 1.0), goes_on=False, hits=tuple(plates))


def _met_late(draw: RandomSource) -> MisScript:
    """Bright walls, and lamps behind those from which on roulette is played: met as likely as sampled."""
    hits = [_wall(draw, i, "", 0.9, 0.97) for i in range(BOUNCES_BEFORE_ROULETTE + 1)]
    hits += [
        _wall(draw, BOUNCES_BEFORE_ROULETTE + 1 + i, kind, 0.9, 0.97)
        for i, kind in enumerate(("le", "l", "le", "le", "ex"))
    ]
    return MisScript(BLACK, goes_on=False, hits=tuple(hits))


def _wall(draw: RandomSource, number: int, kind: str, low: float, high: float) -> MisHit:
    """That sends so much of each channel on."""
    hit = _hit(draw, number, kind)
    if hit.scatter is None:
        return hit
    return replace(hit, scatter=_weighing(hit.scatter, draw.color(low, high)))


def _met_after_dark_wall(draw: RandomSource) -> MisScript:
    """A lamp that is met where few paths go on: roulette has no part in the density of their direction."""
    walls = [_wall(draw, i, "", 0.95, 0.98) for i in range(BOUNCES_BEFORE_ROULETTE)]
    dark = _wall(draw, BOUNCES_BEFORE_ROULETTE, "", 0.2, 0.4)
    lamp = _hit(draw, BOUNCES_BEFORE_ROULETTE + 1, "ex")
    assert dark.scatter is not None
    alike = f32(dark.scatter.pdf * draw.logarithmic(0.5, 2))
    return MisScript(BLACK, goes_on=False, hits=(*walls, dark, replace(lamp, light_pdf=alike)))


_LAMPS = 60  # to be asked: so whoever goes on too often asks much more


def _dark_wall(draw: RandomSource) -> MisScript:
    """The wall behind which roulette begins takes nearly all of the light: so few paths go on from just there. One of
    those before it is a mirror: bounces there count, too."""
    mirror = draw.whole(0, BOUNCES_BEFORE_ROULETTE - 1)
    walls = [_wall(draw, i, "s" if i == mirror else "", 0.95, 0.98) for i in range(BOUNCES_BEFORE_ROULETTE)]
    lamps = DirectSamples(tuple(_sample(draw) for _ in range(_LAMPS)))
    last = replace(_hit(draw, BOUNCES_BEFORE_ROULETTE + 1, "x"), samples=lamps)
    return MisScript(BLACK, goes_on=False, hits=(*walls, _wall(draw, BOUNCES_BEFORE_ROULETTE, "", 0.02, 0.05), last))


def mean_of_walls(script: MisScript) -> Vector:
    """What paths bring on average where all that they meet is certain: only roulette is left to chance."""
    light, weight = np.zeros(3), np.ones(3)
    last: WeighedScatter | None = None
    for hit in script.hits:
        met = 1.0 if last is None or last.scatter.specular else _power(last.pdf, hit.light_pdf)
        light += weight * met * np.array(hit.emission)
        for sample in hit.samples.samples:
            light += weight * _power(sample.pdf, sample.scatter_pdf) * np.array(sample.light)
        last = hit.scatter
        weight = weight * (np.zeros(3) if last is None else np.array(last.scatter.weight))
    x, y, z = (float(channel) for channel in light + weight * np.array(script.background))
    return x, y, z


def _power(pdf: float, other: float) -> float:
    return pdf * pdf / (pdf * pdf + other * other)


def mean_of_plates(script: MisScript) -> Vector:
    """What paths bring on average between plates; the last one may come again and again."""
    light = np.array(script.background)
    for hit in reversed(script.hits):
        assert hit.scatter is not None
        weight, power = np.array(hit.scatter.scatter.weight), hit.exponent + 1
        shares = [lamp.high**power - lamp.low**power for lamp in hit.lamps]
        direct = sum(
            (weight * share * lamp.radiance for share, lamp in zip(shares, hit.lamps, strict=True)), np.zeros(3)
        )
        rest = weight * (1 - sum(shares))
        is_last = hit is script.hits[-1]
        light = direct / (1 - rest) if script.goes_on and is_last else direct + rest * light
    x, y, z = (float(channel) for channel in light)
    return x, y, z


_MAX_WORK = 12.0  # times the reference's: other weights that add up to 1 take up to 6, one way alone 40 and more


def _many_problem(inputs: Inputs, expected: BatchMeans, actual: BatchMeans) -> str:
    """Who leaves one of the two ways out asks less; where that makes no noise it is right."""
    script = inputs["tracer"]
    assert isinstance(script, MisScript)
    mean = mean_of_plates(script) if script.hits[-1].exponent > 0 else mean_of_walls(script)
    return first(
        estimates_problem("the light", mean, expected, actual, _MAX_WORK),
        length_problem(expected, actual) if actual.cost * expected.count > expected.cost * actual.count else "",
    )


_MIS_PATH_LIGHT = Function(
    "mis_path_light",
    path_answer(_many_problem),
    (
        Group("up to four hits", _plain),
        Group("a lamp that is seen", _of_kinds(("ex",), ("el", "x"), ("e", "l", "x"))),
        Group("a lamp that the path meets", _of_kinds(("", "ex"), ("l", "ex"), ("", "", "ex"), ("l", "el", "ex"))),
        Group("a lamp that is never sampled", _of_kinds(("", "enx"), ("l", "enx"), ("", "", "enx"))),
        Group("a lamp from behind", _of_kinds(("ebx",), ("eb", "x"), ("s", "ebx"), ("", "ebx"))),
        Group("sampled from behind", _of_kinds(("blx",), ("bl", "x"), ("l", "blx"), ("bl", "ex"), ("s", "blx"))),
        Group("lamps without a size", _of_kinds(("px",), ("p", "px"), ("lp", "lpx"))),
        Group("mirrors", _of_kinds(("s", "ex"), ("s", "s", "ex"), ("", "s", "ex"), ("s", "", "ex"), ("s", "le", "x"))),
        Group("very bright lamps", _changed(_very_bright, ("el", "x"), ("l", "ex"), ("", "lex"), ("s", "ex"))),
        Group("lamps of one colour", _changed(_one_colored, ("ex",), ("", "ex"), ("s", "ex"), ("e", "l", "ex"))),
        Group("nothing is met", _of_kinds((), ("",), ("s",), ("", "l"), ("l", "s", ""), background=True)),
        Group("white walls", _changed(_white, ("", "ex"), ("l", "ex"), ("", "", "ex"), ("s", "", "ex"))),
        Group("weights above 1", _changed(_above_white, ("", "lx"), ("l", "lx"), ("", "ex"), ("s", "l", "lx"))),
        Group("faint paths", _faint),
        Group("a polished plate, a large lamp", lambda d: often(d, _polished(d), 0.1)),
        Group("a dull plate, a small lamp", lambda d: often(d, _dull(d), 0.05)),
        Group("lamps of all sizes", lambda d: often(d, _of_all_sizes(d), 0.06)),
        Group("plate after plate", lambda d: often(d, _in_turn(d), 0.1)),
        Group("light found very late", lambda d: often(d, _late(d), 0.7)),
        Group("lamps met behind many walls", lambda d: often(d, _met_late(d), 0.06)),
        Group("a dark wall", lambda d: often(d, _dark_wall(d), 0.3)),
        Group("a lamp met behind a dark wall", lambda d: often(d, _met_after_dark_wall(d), 0.1)),
    ),
)

FUNCTIONS = (
    _BALANCE_HEURISTIC,
    _POWER_HEURISTIC,
    _TRIANGLE_PDF,
    _DISK_PDF,
    _SPHERE_PDF,
    _DIRECT_LIGHT,
    _EMISSION_WEIGHT,
    _MIS_PATH_LIGHT,
)
