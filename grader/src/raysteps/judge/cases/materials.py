"""Cases of step 14: Fresnel's laws, the small mirrors of rough surfaces, and what paths make of them."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from raysteps.common.vectors import Vector, cross, dot, minus, times, unit
from raysteps.judge.answers import (
    Answer,
    Tolerance,
    channels,
    direction,
    first,
    number_answer,
    plainly_wrong,
    real,
    share_beyond,
)
from raysteps.judge.cases.microfacets import dielectric, rough_problem, smith_lambda, units, visible_problem
from raysteps.judge.draws import (
    Samples,
    odd_number,
    read_directions,
    read_sample,
    read_samples,
    read_samples_and_first,
    seed_and_times,
    unit_problem,
    words_of_directions,
    words_of_samples,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import (
    Fill,
    Hit,
    Inputs,
    Real,
    TokenReader,
    Vec,
    f32,
    real_of,
    rounded,
    vec_of,
    vector_words,
    whole_of,
)
from raysteps.judge.random_source import RandomSource
from raysteps.judge.statistics import Numbers, is_plausible_total, ratio_problem

_UP: Vector = (0.0, 0.0, 1.0)
Mask = npt.NDArray[np.bool_]


def _color(what: str, tolerance: Tolerance) -> Answer[Vector]:
    return Answer(
        lambda tokens: tokens.vector(),
        vector_words,
        lambda _, expected, actual: channels(what, expected, actual, tolerance),
    )


# Fresnel.


def _fresnel(cosine: float, eta: float) -> Inputs:
    return {"cosine": Real(f32(cosine)), "eta": Real(f32(eta))}


def _least_cosine(eta: float) -> float:
    """From there on refraction is possible."""
    return math.sqrt(max(0.0, 1 - 1 / (eta * eta)))


def _from_dense(draw: RandomSource, *, total: bool) -> Inputs:
    eta = draw.fine(1.15, 2.5)
    least = _least_cosine(eta)
    cosine = draw.fine(0.03, 0.95 * least) if total else draw.fine(min(1.05 * least + 0.01, 0.98), 0.99)
    return _fresnel(cosine, eta)


_FRESNEL_DIELECTRIC = Function(
    "fresnel_dielectric",
    number_answer("the share", Tolerance(2e-5, 2e-4)),
    (
        Group("into the denser medium", lambda d: _fresnel(d.fine(0.05, 0.99), 1 / d.fine(1.15, 2.5))),
        Group("nearly along the surface", lambda d: _fresnel(d.logarithmic(0.002, 0.05), 1 / d.fine(1.15, 2.5))),
        Group("out of it", lambda d: _from_dense(d, total=False)),
        Group("refraction is impossible", lambda d: _from_dense(d, total=True), exact=True),
        Group("straight on", lambda d: _fresnel(1.0, d.fine(1.15, 2.5) ** d.sign()), exact=True),
        Group("along the surface", lambda d: _fresnel(0.0, 1 / d.fine(1.15, 2.5)), exact=True),
        Group("the same on both sides", lambda d: _fresnel(d.fine(0.1, 1.0), 1.0), exact=True),
    ),
)


def _schlick(draw: RandomSource, cosine: float) -> Inputs:
    return {"f0": Vec(draw.color(0.02, 0.98)), "cosine": Real(f32(cosine))}


_FRESNEL_SCHLICK = Function(
    "fresnel_schlick",
    _color("the share", Tolerance(1e-5, 1e-4)),
    (
        Group("any angle", lambda d: _schlick(d, d.fine(0.02, 0.98))),
        Group("straight on", lambda d: _schlick(d, 1.0), exact=True),
        Group("along the surface", lambda d: _schlick(d, 0.0), exact=True),
    ),
)


# A polished metal.

_ONE = 1e-6  # so far may a density of 1 be from it


@dataclass(frozen=True)
class _One:
    """The only sample, or none."""

    row: tuple[float, ...] | None


def _read_one(tokens: TokenReader) -> _One:
    row = read_sample(tokens)
    return _One(None if row is None else tuple(row))


def _words_of_one(one: _One) -> str:
    if one.row is None:
        return "nothing"
    rows = np.array([one.row])
    return words_of_samples(Samples(0, rows)).removeprefix("1 samples, first ")


def _mirror_problems(_inputs: Inputs, expected: _One, actual: _One) -> tuple[str, ...]:
    if actual.row is None or expected.row is None:
        return ("no proper answer came",) * 4
    mine, right = actual.row, expected.row
    return (
        direction("the direction", (right[0], right[1], right[2]), (mine[0], mine[1], mine[2])),
        channels("the weight", (right[3], right[4], right[5]), (mine[3], mine[4], mine[5]), Tolerance(2e-5, 5e-4)),
        "" if mine[7] else "a mirror's sample is not specular",
        real("the pdf", 1.0, mine[6], Tolerance(_ONE, 0)),
    )


def _hit(draw: RandomSource, low: float, high: float, fill: Fill, normal: Vector | None = None) -> Hit:
    normal = draw.direction() if normal is None else normal
    along = times(-1, draw.above(normal, low, high))
    return Hit(draw.point(5), normal, along, draw.real(0.5, 9), fill, draw.chance(0.5))


def _metal(draw: RandomSource) -> Fill:
    """Shares of part one say nothing here."""
    return Fill(draw.color(0.1, 1.0), draw.real(0.2, 0.9), draw.real(0.1, 0.9), draw.real(2, 40))


def _mirror(draw: RandomSource, low: float, high: float, normal: Vector | None = None) -> Inputs:
    return {"hit": _hit(draw, low, high, _metal(draw), normal)}


_SCATTER_MIRROR = Function(
    "scatter_mirror",
    Answer(
        _read_one,
        _words_of_one,
        lambda inputs, expected, actual: first(*_mirror_problems(inputs, expected, actual)),
        lambda inputs, expected, actual: 0.5 * share_beyond(2, *_mirror_problems(inputs, expected, actual)),
    ),
    (
        Group("any angle", lambda d: _mirror(d, 0.1, 0.98)),
        Group("nearly along the surface", lambda d: _mirror(d, 0.02, 0.1)),
        Group("straight on", lambda d: _mirror(d, 1.0, 1.0, d.axis()), exact=True),
    ),
)


# Microfacets, in the frame of the surface.


def _alpha(draw: RandomSource, low: float = 0.05, high: float = 1.0) -> Real:
    return Real(f32(math.exp(draw.fine(math.log(low), math.log(high)))))


def _normal_near(draw: RandomSource, alpha: float) -> Vector:
    """Where there are microfacets: as far from the middle as chance puts them."""
    share = draw.fine(0.02, 0.98)
    tangent = alpha * math.sqrt(share / (1 - share))
    return draw.above(_UP, 1 / math.hypot(1, tangent), 1 / math.hypot(1, tangent))


def _of_normal(draw: RandomSource, low: float, high: float) -> Inputs:
    alpha = _alpha(draw, low, high)
    return {"normal": Vec(_normal_near(draw, alpha.value)), "alpha": alpha}


def _below(v: Vector) -> Vector:
    return v[0], v[1], -v[2]


_GGX_DISTRIBUTION = Function(
    "ggx_distribution",
    number_answer("the density", Tolerance(1e-5, 1e-3)),
    (
        Group("any normal", lambda d: _of_normal(d, 0.1, 1.0)),
        Group("nearly smooth", lambda d: _of_normal(d, 0.03, 0.1)),
        Group("straight up", lambda d: {"normal": Vec(_UP), "alpha": _alpha(d)}, exact=True),
        Group("as rough as can be", lambda d: {"normal": Vec(d.above(_UP, 0.05)), "alpha": Real(1.0)}, exact=True),
        Group("below", lambda d: {"normal": Vec(_below(d.above(_UP, 0.05))), "alpha": _alpha(d)}, exact=True),
    ),
)


def _of_direction(draw: RandomSource, low: float, high: float, side: float = 1.0) -> Inputs:
    x, y, z = draw.above(_UP, low, high)
    return {"direction": Vec((x, y, side * z)), "alpha": _alpha(draw)}


_GGX_LAMBDA = Function(
    "ggx_lambda",
    number_answer("lambda", Tolerance(1e-5, 1e-3)),
    (
        Group("any direction", lambda d: _of_direction(d, 0.1, 0.98)),
        Group("nearly along the surface", lambda d: _of_direction(d, 0.01, 0.1)),
        Group("below", lambda d: _of_direction(d, 0.1, 0.98, -1.0)),
        Group("straight up", lambda d: {"direction": Vec(_UP), "alpha": _alpha(d)}, exact=True),
    ),
)


def _visible(draw: RandomSource, view: Vector, amount: int = 2048) -> Inputs:
    return {"view": Vec(view), "alpha": _alpha(draw, 0.1), **seed_and_times(draw, amount)}


def _nearly_smooth(draw: RandomSource) -> Inputs:
    """A slanting view that is nearly straight from above where the surface is stretched to a half sphere. It leans
    between x and y: a frame that holds one of these two, whichever it is, is not at right angles."""
    alpha, tangent = _alpha(draw, 0.03, 0.1), draw.fine(0.12, 0.141)
    turn = math.radians(draw.sign() * draw.fine(35, 55))
    across = tangent / alpha.value
    view = rounded(unit((across * math.cos(turn), across * math.sin(turn), 1.0)))
    return {"view": Vec(view), "alpha": alpha, **seed_and_times(draw, 32_768)}


_SAMPLE_VISIBLE_NORMAL = Function(
    "sample_visible_normal",
    Answer(
        read_directions,
        words_of_directions,
        lambda inputs, _, actual: (
            visible_problem(actual, vec_of(inputs, "view"), real_of(inputs, "alpha"))
            if len(actual) == whole_of(inputs, "times")
            else "no proper answer came"
        ),
        is_drawn=True,
    ),
    (
        Group("any view", lambda d: _visible(d, d.above(_UP, 0.2, 0.95))),
        Group("a flat view", lambda d: _visible(d, d.above(_UP, 0.03, 0.2))),
        Group("from straight above", lambda d: _visible(d, _UP), exact=True),
        Group("very many normals", lambda d: _visible(d, d.above(_UP, 0.2, 0.9), 32_768)),
        Group("nearly smooth, very many", _nearly_smooth),
    ),
)


def _facing(draw: RandomSource, view: Vector, alpha: float) -> Vector:
    return draw.until(lambda found: dot(found, view) > 0.05, lambda: _normal_near(draw, alpha))


def _visible_pdf(draw: RandomSource, low: float, high: float) -> Inputs:
    view, alpha = draw.above(_UP, low, high), _alpha(draw, 0.1)
    return {"view": Vec(view), "normal": Vec(_facing(draw, view, alpha.value)), "alpha": alpha}


def _unseen_pdf(draw: RandomSource) -> Inputs:
    """A microfacet that is turned away."""
    view = draw.above(_UP, 0.05, 0.4)
    normal = draw.until(lambda found: dot(found, view) < -0.05, lambda: draw.above(_UP, 0.05, 0.9))
    return {"view": Vec(view), "normal": Vec(normal), "alpha": _alpha(draw, 0.1)}


_VISIBLE_NORMAL_PDF = Function(
    "visible_normal_pdf",
    number_answer("the density", Tolerance(1e-5, 1e-3)),
    (
        Group("any view", lambda d: _visible_pdf(d, 0.2, 0.98)),
        Group("a flat view", lambda d: _visible_pdf(d, 0.03, 0.2)),
        Group("turned away", _unseen_pdf, exact=True),
    ),
)


# Rough metal.


def _mirrored(view: Vector, normal: Vector) -> Vector:
    return rounded(unit(minus(times(2 * dot(view, normal), normal), view)))


def _pair(draw: RandomSource, low: float, high: float, alpha: float) -> dict[str, Vec]:
    """View and light, of a microfacet that is likely."""
    view = draw.above(_UP, low, high)
    light = draw.until(lambda found: found[2] > 0.03, lambda: _mirrored(view, _facing(draw, view, alpha)))
    return {"view": Vec(view), "light": Vec(light)}


def _brdf(draw: RandomSource, low: float, high: float, rough: tuple[float, float] = (0.1, 1.0)) -> Inputs:
    alpha = _alpha(draw, *rough)
    return {**_pair(draw, low, high, alpha.value), "f0": Vec(draw.color(0.1, 1.0)), "alpha": alpha}


def _metal_pdf(draw: RandomSource, low: float, high: float) -> Inputs:
    alpha = _alpha(draw, 0.1)
    return {**_pair(draw, low, high, alpha.value), "alpha": alpha}


def _below_one(draw: RandomSource) -> dict[str, Vec]:
    """One of the two below the surface, or both."""
    view, light = draw.above(_UP, 0.1, 0.95), draw.above(_UP, 0.1, 0.95)
    which = draw.whole(1, 3)
    return {
        "view": Vec(_below(view) if which & 1 else view),
        "light": Vec(_below(light) if which & 2 else light),
    }


_METAL_BRDF = Function(
    "metal_brdf",
    _color("f", Tolerance(1e-5, 2e-3)),
    (
        Group("any directions", lambda d: _brdf(d, 0.2, 0.98)),
        Group("a flat view", lambda d: _brdf(d, 0.03, 0.2)),
        Group("nearly smooth", lambda d: _brdf(d, 0.2, 0.98, (0.05, 0.1))),
        Group(
            "below the surface",
            lambda d: {**_below_one(d), "f0": Vec(d.color(0.1, 1.0)), "alpha": _alpha(d, 0.1)},
            exact=True,
        ),
    ),
)

_METAL_PDF = Function(
    "metal_pdf",
    number_answer("the density", Tolerance(1e-5, 2e-3)),
    (
        Group("any directions", lambda d: _metal_pdf(d, 0.2, 0.98)),
        Group("a flat view", lambda d: _metal_pdf(d, 0.03, 0.2)),
        Group("below the surface", lambda d: {**_below_one(d), "alpha": _alpha(d, 0.1)}, exact=True),
    ),
)


# What paths make of it. In the frame of the normal; any frame will do, as GGX is the same all around.


def _local(inputs: Inputs, directions: Numbers) -> tuple[Numbers, Numbers]:
    """The view, and directions, row by row."""
    hit = inputs["hit"]
    assert isinstance(hit, Hit)
    axis = (1.0, 0.0, 0.0) if abs(hit.normal[0]) < 0.7 else (0.0, 1.0, 0.0)
    side = unit(cross(hit.normal, axis))
    frame = np.array([side, cross(hit.normal, side), hit.normal]).T
    view = -np.array(hit.ray_direction) @ frame
    return np.broadcast_to(view, directions.shape), directions @ frame


def _schlick_of(f0: Vector, cosines: Numbers) -> Numbers:
    return np.asarray(np.array(f0) + (1 - np.array(f0)) * (1 - cosines[:, None]) ** 5)


def _dots(one: Numbers, other: Numbers) -> Numbers:
    return np.asarray((one * other).sum(axis=1))


_WEIGHT = 2e-3  # of what the weight should be, besides rounding
_LEVEL = 0.02  # below such a cosine a float's rounding is too much of it to compare with


def _weight_problem(what: str, mine: Numbers, right: Numbers, steep: Mask) -> str:
    mine, right = mine[steep], right[steep]
    if not (np.abs(mine - right) > 1e-4 + _WEIGHT * np.abs(right)).any():
        return ""
    return ratio_problem(what, mine.sum(axis=1) / right.sum(axis=1))


def _metal_problems(inputs: Inputs, actual: Samples) -> tuple[str, ...]:
    hit, alpha = inputs["hit"], real_of(inputs, "roughness")
    assert isinstance(hit, Hit)
    proper = actual.count == whole_of(inputs, "times")
    if proper and dot(hit.ray_direction, hit.normal) > 0:
        return ("a path goes on though the view is not above the surface" if len(actual.rows) else "",) * 4
    if not proper or not len(actual.rows):
        return ("no proper answer came",) * 4
    view, light = _local(inputs, actual.directions)
    wrong = unit_problem(actual.directions) or odd_number("a number of a sample", actual.rows)
    if wrong:
        return (wrong,) * 4
    if not (light[:, 2] > 0).all():
        return ("a direction leads below the surface",) * 4
    half = units(view + light)
    cosines = np.clip(_dots(view, half), 0.0, 1.0)
    seen, hidden = 1 + smith_lambda(view, alpha), smith_lambda(light, alpha)
    steep = light[:, 2] > _LEVEL
    right = _schlick_of(hit.fill.color, cosines) * (seen / (seen + hidden))[:, None]
    density = alpha**2 / (math.pi * ((alpha**2 - 1) * half[:, 2] ** 2 + 1) ** 2) / (4 * seen * view[:, 2])
    pdfs, density = actual.pdfs[steep], density[steep]
    wrong_pdf = bool((np.abs(pdfs - density) > 1e-4 + 5e-3 * density).any())
    return (
        rough_problem(half, actual.nothing, view, alpha),
        _weight_problem("the weight is not f cos / pdf", actual.weights, right, steep),
        ratio_problem("the pdf is not that of the direction", pdfs / density) if wrong_pdf else "",
        "rough metal gives a specular sample" if actual.is_specular_somewhere else "",
    )


def _rough(draw: RandomSource, low: float, high: float, rough: tuple[float, float], amount: int = 1024) -> Inputs:
    hit = _hit(draw, low, high, _metal(draw))
    return {"hit": hit, "roughness": _alpha(draw, *rough), **seed_and_times(draw, amount)}


def _white_metal(draw: RandomSource) -> Inputs:
    """It takes no light, and hides next to nothing: of some samples the weight is exactly white, as of a mirror."""
    return {"hit": _hit(draw, 1.0, 1.0, Fill()), "roughness": _alpha(draw, 0.02, 0.03), **seed_and_times(draw, 1024)}


_SCATTER_METAL = Function(
    "scatter_metal",
    Answer(
        read_samples,
        words_of_samples,
        lambda inputs, _expected, actual: first(*_metal_problems(inputs, actual)),
        lambda inputs, _expected, actual: 0.5 * share_beyond(1, *_metal_problems(inputs, actual)),
        is_drawn=True,
    ),
    (
        Group("nearly smooth, from above", lambda d: _rough(d, 0.8, 0.98, (0.03, 0.06))),
        Group("any angle and roughness", lambda d: _rough(d, 0.15, 0.98, (0.1, 1.0), 256)),
        Group("very many samples", lambda d: _rough(d, 0.9, 0.98, (0.03, 0.05), 16_384)),
        Group("a view from below", lambda d: _rough(d, -0.95, -0.1, (0.1, 1.0), 16)),
        Group("white, nearly smooth, from straight above", _white_metal),
    ),
)


# Glass. Each sample is mirrored or refracted at a normal that can be told from its direction; how often it is mirrored
# there is Fresnel's to say.


@dataclass(frozen=True)
class _Glass:
    """As of rough metal, and what the first stream gave when it was asked once more."""

    samples: Samples
    same_again: bool


def _read_glass(tokens: TokenReader) -> _Glass:
    return _Glass(*read_samples_and_first(tokens))


def _eta(hit: Hit) -> float:
    index = hit.fill.index
    return 1 / index if hit.front_face else index


def _glass_problems(inputs: Inputs, actual: _Glass) -> tuple[str, ...]:
    hit, alpha, samples = inputs["hit"], real_of(inputs, "roughness"), actual.samples
    assert isinstance(hit, Hit)
    if samples.count != whole_of(inputs, "times") or not len(samples.rows):
        return ("no proper answer came",) * 5
    wrong = unit_problem(samples.directions) or odd_number("a number of a sample", samples.rows)
    if wrong:
        return (wrong,) * 5
    if not actual.same_again:
        return ("the same stream gave another answer; all numbers must come from it",) * 5
    view, next_ = _local(inputs, samples.directions)
    eta = _eta(hit)
    is_mirrored = next_[:, 2] > 0
    between = np.where(is_mirrored[:, None], view + next_, eta * view + next_)
    normals = units(between) * np.where(between[:, 2] < 0, -1.0, 1.0)[:, None]
    cosines = np.clip(_dots(view, normals), 0.0, 1.0)
    if alpha == 0 and not (normals[:, 2] > 1 - 2e-4).all():
        return (_astray(is_mirrored, normals),) * 5
    seen, hidden = 1 + smith_lambda(view, alpha), smith_lambda(next_, alpha)
    right = (seen / (seen + hidden))[:, None] * np.ones(3)
    steep = np.abs(next_[:, 2]) > _LEVEL
    shares = dielectric(cosines, eta)
    return (
        _unbent_problem(_dots(view, next_)[~is_mirrored], eta)
        or _share_problem(is_mirrored, shares, samples.nothing)
        or (_odds_problem(is_mirrored, shares, view, normals, samples.nothing) if alpha else ""),
        _weight_problem("the weight is wrong", samples.weights, right, steep),
        rough_problem(normals, samples.nothing, view, alpha, eta) if alpha else _of_smooth(samples.nothing),
        "" if samples.are_specular else "a sample of glass is not specular",
        ratio_problem("the pdf is not 1", samples.pdfs) if (np.abs(samples.pdfs - 1) > _ONE).any() else "",
    )


def _of_smooth(nothing: int) -> str:
    return "nothing comes too often" if nothing else ""


def _astray(is_mirrored: Mask, normals: Numbers) -> str:
    """Of smooth glass: which of the two ways is not the one of its law."""
    astray = normals[:, 2] <= 1 - 2e-4
    return plainly_wrong(f"the {'mirrored' if (astray & is_mirrored).any() else 'refracted'} direction")


def _unbent_problem(cosines: Numbers, eta: float) -> str:
    """`cosines`: between the view and directions below the surface. What is refracted lies on the other side of its
    microfacet, and is bent by no more than a ray along that."""
    return _BENT_TOO_FAR if (cosines > 1e-3 - min(eta, 1 / eta)).any() else ""


_BENT_TOO_FAR = (
    "a direction below the surface is bent farther than glass bends: it was refracted wrongly, or mirrored downwards"
)


def _odds_problem(is_mirrored: Mask, shares: Numbers, view: Numbers, normals: Numbers, nothing: int) -> str:
    """The number that decides may be that which chose the microfacet: then those that face the view, lie flat, or lean
    to one side of it are mirrored too often. What a view sees is the same on its two sides."""
    for measure in (_dots(view, normals), normals[:, 2]):
        more = measure > np.median(measure)
        if any(_share_problem(is_mirrored[half], shares[half], nothing) for half in (more, ~more)):
            return _NOT_DRAWN_ANEW
    x, y, _ = view[0]
    across = normals[:, 0] * y - normals[:, 1] * x if math.hypot(x, y) > _STRAIGHT else normals[:, 0]
    left = across[is_mirrored] > 0
    return "" if is_plausible_total(int(left.sum()), np.full(len(left), 0.5), 0) else _NOT_DRAWN_ANEW


_NOT_DRAWN_ANEW = "whether light is mirrored depends on the microfacet by more than Fresnel's share: draw it anew"
_STRAIGHT = 1e-3  # a view from straight above is the same on all sides


def _share_problem(is_mirrored: Mask, shares: Numbers, nothing: int) -> str:
    """Each sample is mirrored with a probability of its own. Lost ones make no difference as long as they are few."""
    found = int(is_mirrored.sum())
    if is_plausible_total(found, shares, nothing + math.ceil(1e-3 * len(shares))):
        return ""
    words = f"too {'much' if found > shares.sum() else 'little'} light is mirrored"
    return ratio_problem(words, np.array([found / max(float(shares.sum()), 1.0)]))


def _glass_fill(draw: RandomSource) -> Fill:
    return Fill(draw.color(0.1, 1.0), draw.real(0.2, 0.9), 0.0, 1.0, 0.0, draw.real(1.2, 2.2))


def _glass(draw: RandomSource, low: float, high: float, roughness: Real, amount: int = 1024) -> Inputs:
    return {"hit": _hit(draw, low, high, _glass_fill(draw)), "roughness": roughness, **seed_and_times(draw, amount)}


def _inside(draw: RandomSource, *, total: bool) -> Inputs:
    fill = _glass_fill(draw)
    least = _least_cosine(fill.index)
    low, high = (0.05, 0.9 * least) if total else (min(1.03 * least + 0.02, 0.97), 0.99)
    return _from_inside(draw, low, high, fill, Real(0.0))


def _nearly_total(draw: RandomSource) -> Inputs:
    """Where Fresnel's shares of the two sides differ most."""
    fill = _glass_fill(draw)
    least = _least_cosine(fill.index)
    return _from_inside(draw, 1.005 * least + 0.003, 1.03 * least + 0.005, fill, Real(0.0))


def _frosted_inside(draw: RandomSource) -> Inputs:
    """Clear glass would mirror all of it; the microfacets let through what they lean for."""
    fill = _glass_fill(draw)
    least = _least_cosine(fill.index)
    return _from_inside(draw, 0.7 * least, 0.95 * least, fill, _alpha(draw, 0.3, 0.7))


def _from_inside(draw: RandomSource, low: float, high: float, fill: Fill, roughness: Real) -> Inputs:
    hit = _hit(draw, low, high, fill)
    inside = Hit(hit.position, hit.normal, hit.ray_direction, hit.distance, fill, False)
    return {"hit": inside, "roughness": roughness, **seed_and_times(draw, 1024)}


_SCATTER_GLASS = Function(
    "scatter_glass",
    Answer(
        _read_glass,
        lambda glass: words_of_samples(glass.samples),
        lambda inputs, _expected, actual: first(*_glass_problems(inputs, actual)),
        lambda inputs, _expected, actual: 0.5 * share_beyond(2, *_glass_problems(inputs, actual)),
        is_drawn=True,
    ),
    (
        Group("smooth", lambda d: _glass(d, 0.1, 0.98, Real(0.0))),
        Group("smooth, from inside", lambda d: _inside(d, total=False)),
        Group("just before refraction is impossible", _nearly_total),
        Group("refraction is impossible", lambda d: _inside(d, total=True)),
        Group("a little rough, from above", lambda d: _glass(d, 0.85, 0.98, _alpha(d, 0.01, 0.06))),
        Group("rough", lambda d: _glass(d, 0.4, 0.98, _alpha(d, 0.1, 0.6), 256)),
        Group("rough, from inside", _frosted_inside),
        Group("rough, and a flat view", lambda d: _glass(d, 0.1, 0.25, _alpha(d, 0.6, 1.0), 2048)),
        Group("very many samples", lambda d: _glass(d, 0.3, 0.9, Real(0.0), 16_384)),
    ),
)

FUNCTIONS = (
    _FRESNEL_DIELECTRIC,
    _FRESNEL_SCHLICK,
    _SCATTER_MIRROR,
    _GGX_DISTRIBUTION,
    _GGX_LAMBDA,
    _SAMPLE_VISIBLE_NORMAL,
    _VISIBLE_NORMAL_PDF,
    _METAL_BRDF,
    _METAL_PDF,
    _SCATTER_METAL,
    _SCATTER_GLASS,
)
