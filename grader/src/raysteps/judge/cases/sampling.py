"""Cases of step 10."""

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass

import numpy as np

from raysteps.common.vectors import Vector
from raysteps.judge.answers import (
    Answer,
    Tolerance,
    channels,
    first,
    itself,
    number_answer,
    read_vector,
    real,
    words_of_number,
    words_of_vector,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Inputs, PixelSample, PixelSamples, Real, TokenReader, Whole, f32, text, whole_of
from raysteps.judge.random_source import RandomSource
from raysteps.judge.statistics import (
    Numbers,
    are_independent,
    has_many_near_pairs,
    has_mean,
    is_uniform,
    ratio_problem,
    uneven_problem,
)

# Stratified samples. Every order of the points is right, and every way to draw them: so no answer is compared with the
# reference's, but each is tested for what the contract promises. The worker asks `times` times, each time with another
# stream, and at last with the first one again.

_BORDER = 1e-4  # of a square: a point so near to its border may have been rounded across
_FEW, _MANY = 8, 32  # bins along a side of a square
_MANY_POINTS = 32_768  # from here on the finer bins
_MAX_TIMES = 10_000


@dataclass(frozen=True)
class _Draws:
    """What came of each time."""

    points: tuple[Numbers, ...]


def _read_draws(tokens: TokenReader) -> _Draws:
    draws: list[Numbers] = []
    while not tokens.at_end() and len(draws) <= _MAX_TIMES:
        size = tokens.whole(0, 1 << 20)
        draws.append(tokens.reals(2 * size).reshape(size, 2))
    return _Draws(tuple(draws))


def _words_of_draws(draws: _Draws) -> str:
    if not draws.points:
        return "nothing"
    found = draws.points[0]
    return f"{len(found)} points, first " + ", ".join(f"({text(f32(x))}, {text(f32(y))})" for x, y in found[:8])


def _in_squares(points: Numbers, side: int) -> Numbers | None:
    """Where in its square each point lies, in the order of the squares; none where a square has not just one point.
    Points: times, points of each, x and y."""
    places = points * side
    near = np.abs(places - np.round(places)) < _BORDER
    squares = np.clip(np.where(near, np.round(places), np.floor(places)), 0, side).astype(np.int64)
    sure = np.asarray(~near.any(axis=2))
    index = squares[..., 1] * side + squares[..., 0]
    order = np.argsort(index, axis=1)
    found = np.take_along_axis(places - squares, order[..., None], axis=1)
    alike = np.diff(np.take_along_axis(index, order, axis=1), axis=1) == 0
    for time in map(int, np.flatnonzero(~np.all(sure, axis=1))):
        # One of a few, in which the square of a point is not known for sure.
        known = np.sort(index[time, sure[time]])
        alike[time] = (np.diff(known) == 0).any()
        x, y = places[time].T
        found[time] = (places[time] % 1.0)[np.lexsort((x, np.floor(y + _BORDER / 2)))]
    return None if alike.any() else np.asarray(found)


def _pairs(shares: Numbers) -> Iterator[tuple[Numbers, Numbers]]:
    """Of squares beside and below each other. Shares: times, rows, columns, x and y."""
    _, rows, columns, _ = shares.shape
    yield shares[:, :, 0 : columns - 1 : 2], shares[:, :, 1::2]
    yield shares[:, 0 : rows - 1 : 2], shares[:, 1::2]


def _are_dependent(one: Numbers, other: Numbers) -> bool:
    """Any coordinate of a point of one on any of the other's."""
    return not all(
        are_independent(one[..., a].ravel(), other[..., b].ravel(), 2 * _FEW) for a in range(2) for b in range(2)
    )


_SQUARES = "the points of different squares have to do with each other"
_STREAMS = "points are the same for different streams"
_SOME_SQUARES = "some squares have their point always at the same place"
_FEW_PLACES = "points lie at a few places of their squares only"
_ON_A_LINE = "only one of x and y of the points is at chance in its square"
_ROUNDING = 1e-6  # of a place in a square: float knows it no better
_SHARED = 1e-4  # of a square: so near are places that one random number has made


def _varies(numbers: Numbers) -> bool:
    return float(numbers.std()) > _ROUNDING


def _copies(in_time: Numbers, shares: Numbers) -> str:
    """Numbers of one coordinate that come again, in other squares (the columns) or for other streams (the rows)."""
    among_squares, among_streams = has_many_near_pairs(in_time, _ROUNDING), has_many_near_pairs(in_time.T, 0.0)
    if among_squares and among_streams and _varies(in_time.std(axis=0)):
        return _FEW_PLACES
    if among_squares:
        return _of_shared_squares(shares)
    if among_streams:
        stay = in_time.std(axis=0) <= _ROUNDING
        return _SOME_SQUARES if stay.any() and not stay.all() else _STREAMS
    return ""


def _of_shared_squares(shares: Numbers) -> str:
    """Which squares have one random shift together."""
    in_rows, in_columns = (
        shares.shape[axis] > 1 and float((np.abs(np.diff(shares, axis=axis)) > _SHARED).mean()) < 0.01
        for axis in (2, 1)
    )
    if in_rows and in_columns:
        return "all squares have their points at the same place in them"
    if in_rows or in_columns:
        return f"the squares of a {'row' if in_rows else 'column'} have their points at the same place in them"
    return _SQUARES


def _problem_of_squares(shares: Numbers) -> str:
    """Shares: times, rows, columns, x and y, each from 0 to 1 within its square. Numbers that were used several times
    are looked for first: they make everything else uneven. Where all are the same they are no copies."""
    times, rows, columns, _ = shares.shape
    in_time = shares.reshape(times, rows * columns, 2)
    copied = first(*(_copies(in_time[..., axis], shares) for axis in range(2) if _varies(in_time[..., axis])))
    if copied:
        return copied
    if _varies(in_time[..., 0]) != _varies(in_time[..., 1]):
        return _ON_A_LINE
    points = shares.reshape(-1, 2)
    bins = _MANY if len(points) >= _MANY_POINTS else _FEW
    for axis, way in zip("xy", points.T, strict=True):
        if not (is_uniform(way, 2 * bins) and has_mean(way, 0.5, math.sqrt(1 / 12))):
            problem = "the points do not lie everywhere in their squares, all places equally likely"
            return uneven_problem(problem, f"{axis} of the points, from one side of their squares to the other", way)
    if not is_uniform(points, bins):
        return "x and y of a point have to do with each other"
    if any(_are_dependent(*pair) for pair in _pairs(shares)):
        return _SQUARES
    return _STREAMS if _are_dependent(shares[0:-1:2], shares[1::2]) else ""


def _problem_of_amounts(amounts: Collection[int], side: int) -> str:
    """In words that tell apart what is missing."""
    if not any(amounts):
        return "there are no points"
    only_row = set(amounts) == {side * (side - 1)}
    return "a row of points is missing" if only_row else "there are not side * side points"


_OFTEN = 16  # random points leave a given square empty so many times once in ten million
_FAR = 2 + 1e-4  # no square is so wide that a point of one within the unit square could lie there


def _empty_squares(points: Numbers, side: int) -> str:
    """Which squares stay empty: some of them each time, or now this one and now that one."""
    x, y = np.clip(np.floor(points * side), 0, side - 1).astype(np.int64).reshape(-1, 2).T
    is_met = np.bincount(y * side + x, minlength=side * side) > 0
    by_chance = is_met.all() or len(points) < _OFTEN
    return "a square has no point, or two" if by_chance else "some squares never have a point, others have several"


def _draws_problem(inputs: Inputs, _expected: _Draws, actual: _Draws) -> str:
    side, times = whole_of(inputs, "side"), whole_of(inputs, "times")
    if len(actual.points) != times + 1:
        return "no proper answer came"
    if any(len(points) != side * side for points in actual.points):
        return _problem_of_amounts({len(points) for points in actual.points}, side)
    every = np.array(actual.points)
    if not np.isfinite(every).all():
        return "a point is no number, or infinite"
    if (every < 0).any():
        return "a point lies outside of the unit square, below 0"
    if (every > 1).any():
        return ratio_problem(
            f"a point lies outside of the unit square, {'far ' if (every > _FAR).any() else ''}beyond 1", every
        )
    shares = _in_squares(every[:-1], side)
    if shares is None:
        return _empty_squares(every[:-1], side)
    if not np.array_equal(actual.points[0], actual.points[-1]):
        return "the same stream gave other points; all numbers must come from it"
    return _problem_of_squares(np.minimum(shares, 1.0).reshape(times, side, side, 2))


def _draws(draw: RandomSource, side: int, points: int) -> Inputs:
    times = 2 * math.ceil(points / side / side / 2)
    return {"side": Whole(side), "seed": Whole(draw.whole(1, 1_000_000_000)), "times": Whole(times)}


_STRATIFIED = Function(
    "stratified_samples",
    Answer(_read_draws, _words_of_draws, _draws_problem, is_drawn=True),
    (
        Group("a few squares", lambda d: _draws(d, d.whole(2, 4), 2048)),
        Group("one square", lambda d: _draws(d, 1, 2048)),
        Group("many squares", lambda d: _draws(d, d.whole(5, 16), 4096)),
        Group("very many points", lambda d: _draws(d, d.whole(4, 8), 65_536)),
        Group("as many as a picture may ask for", lambda d: _draws(d, d.whole(17, 64), 8192)),
    ),
)

# Low-discrepancy points.

_CLOSE = Tolerance(2e-6, 2e-6)
_PRIMES = (2, 3, 5, 7, 11, 13, 29, 101)


def _share_problem(_inputs: Inputs, expected: float, actual: float) -> str:
    if actual >= 1:
        return "the answer is not below 1"
    return real("the answer", expected, actual, _CLOSE)


def _inverse(base: int, index: int) -> Inputs:
    return {"base": Whole(base), "index": Whole(index)}


def _base(draw: RandomSource) -> int:
    return _PRIMES[draw.whole(0, len(_PRIMES) - 1)]


def _next_to_one(draw: RandomSource) -> Inputs:
    """All digits are the largest one."""
    base = (2, 3, 10)[draw.whole(0, 2)]
    digits = math.floor(math.log(1e9) / math.log(base))
    return _inverse(base, base ** draw.whole(digits - 1, digits) - 1)


def _power(draw: RandomSource) -> Inputs:
    """Its digits are a 1 and zeros. Who counts digits by a logarithm finds one too few, if not of every base."""
    base, most = ((3, 9), (7, 5), (10, 4), (17, 3))[draw.whole(0, 3)]
    return _inverse(base, base ** draw.whole(2, most))


_RADICAL_INVERSE = Function(
    "radical_inverse",
    Answer(lambda tokens: tokens.real(), words_of_number, _share_problem),
    (
        Group("any base and index", lambda d: _inverse(_base(d), d.whole(1, 10_000))),
        Group("base 2", lambda d: _inverse(2, d.whole(1, 64))),
        Group("one digit", lambda d: _inverse(d.whole(3, 40), d.whole(1, 2))),
        Group("index 0", lambda d: _inverse(_base(d), 0), exact=True),
        Group("a large index", lambda d: _inverse(_base(d), d.whole(10_000_000, 1_000_000_000))),
        Group("more than an int holds", lambda d: _inverse(_base(d), d.whole(1 << 31, (1 << 32) - 1))),
        Group("close to 1", _next_to_one, exact=True),
        Group("a power of the base", _power, exact=True),
    ),
)

_Point = tuple[float, float]


def _read_point(tokens: TokenReader) -> _Point:
    return tokens.real(), tokens.real()


def _words_of_point(point: _Point) -> str:
    return f"({text(point[0])}, {text(point[1])})"


def _point_problem(_inputs: Inputs, expected: _Point, actual: _Point) -> str:
    return first(real("x", expected[0], actual[0], _CLOSE), real("y", expected[1], actual[1], _CLOSE))


_HALTON = Function(
    "halton_point",
    Answer(_read_point, _words_of_point, _point_problem),
    (
        Group("any index", lambda d: {"index": Whole(d.whole(1, 10_000))}),
        Group("the first points", lambda d: {"index": Whole(d.whole(0, 15))}, exact=True),
        Group("a large index", lambda d: {"index": Whole(d.whole(10_000_000, 1_000_000_000))}),
        Group("more than an int holds", lambda d: {"index": Whole(d.whole(1 << 31, (1 << 32) - 1))}),
    ),
)

# Filters, and what becomes of samples.

_WEIGHT = number_answer("the weight", Tolerance(2e-5, 2e-5))


def _distance(draw: RandomSource, low: float, high: float) -> Inputs:
    return {"distance": Real(f32(draw.sign() * draw.fine(low, high)))}


def _simple_distance(draw: RandomSource, most: int) -> Inputs:
    return {"distance": Real(draw.whole(-2 * most, 2 * most) / 2)}


_TENT = Function(
    "tent_filter",
    _WEIGHT,
    (
        Group("within reach", lambda d: _distance(d, 0.02, 0.98)),
        Group("simple numbers", lambda d: _simple_distance(d, 1), exact=True),
        Group("beyond its reach", lambda d: _distance(d, 1.01, 4), exact=True),
    ),
)
_MITCHELL = Function(
    "mitchell_filter",
    _WEIGHT,
    (
        Group("within reach", lambda d: _distance(d, 0.02, 1.9)),
        Group("the middle part", lambda d: _distance(d, 0.02, 0.98)),
        Group("where it is below 0", lambda d: _distance(d, 1.15, 1.9)),
        Group("simple numbers", lambda d: _simple_distance(d, 2), exact=True),
        Group("beyond its reach", lambda d: _distance(d, 2.01, 6), exact=True),
    ),
)

_BOX, _TENT_KIND, _MITCHELL_KIND = range(3)  # as in core/pixel_sample.hpp
_REACH = (0.5, 1.0, 2.0)


@dataclass(frozen=True)
class _Filter(Whole):
    """One of the three, by its number."""

    def words(self) -> str:
        return ("box", "tent", "Mitchell")[self.value]


def _sample(draw: RandomSource, reach: float, light: Vector) -> PixelSample:
    return PixelSample((draw.real(-reach, reach), draw.real(-reach, reach)), light)


def _samples(draw: RandomSource, filters: tuple[int, ...], size: int) -> Inputs:
    """The first one lies near the middle, so that the weights never add up to little."""
    kind = filters[draw.whole(0, len(filters) - 1)]
    near = _sample(draw, 0.2, draw.color(0.1, 2.0))
    others = [_sample(draw, 0.98 * _REACH[kind], draw.color(0.1, 2.0)) for _ in range(size - 1)]
    return {"filter": _Filter(kind), "samples": PixelSamples((near, *others))}


_EVERY = (_BOX, _TENT_KIND, _MITCHELL_KIND)


def _one_is_bright(draw: RandomSource) -> Inputs:
    inputs = _samples(draw, _EVERY, draw.whole(4, 9))
    samples = inputs["samples"]
    assert isinstance(samples, PixelSamples)
    bright = PixelSample((draw.real(-0.4, 0.4), draw.real(-0.4, 0.4)), draw.color(100, 1000))
    return {**inputs, "samples": PixelSamples((*samples.samples, bright))}


def _black_ones(draw: RandomSource) -> Inputs:
    """Most of what a pixel sees is black: that counts, too."""
    inputs = _samples(draw, _EVERY, draw.whole(4, 9))
    samples = inputs["samples"]
    assert isinstance(samples, PixelSamples)
    first, *others = samples.samples
    black = [PixelSample(one.offset, (0.0, 0.0, 0.0)) for one in others]
    return {**inputs, "samples": PixelSamples((first, *black) if draw.chance(0.5) else (*black, first))}


def _first_ones_do_not_count(draw: RandomSource) -> Inputs:
    """They lie beyond the filter's reach: the weights add up to 0 for a while."""
    inputs = _samples(draw, (_BOX, _TENT_KIND), draw.whole(2, 6))
    samples = inputs["samples"]
    assert isinstance(samples, PixelSamples)
    out = [PixelSample((draw.sign() * draw.eighths(1.125, 3), draw.real(-1, 1)), draw.color()) for _ in range(2)]
    return {**inputs, "samples": PixelSamples((*out, *samples.samples))}


def _of_no_weight(draw: RandomSource) -> Inputs:
    """No sample at all, or only such as lie beyond the filter's reach, where nobody's formula is off by rounding."""
    kind = _EVERY[draw.whole(0, 1)]
    out = [PixelSample((draw.sign() * draw.eighths(1.125, 3), draw.real(-1, 1)), draw.color()) for _ in range(3)]
    return {"filter": _Filter(kind), "samples": PixelSamples(tuple(out[: draw.whole(0, 3)]))}


def _negative_light(draw: RandomSource) -> Inputs:
    """A bright sample where the filter is below 0."""
    near = PixelSample((draw.real(-0.1, 0.1), draw.real(-0.1, 0.1)), draw.color(0.1, 0.3))
    far = PixelSample((draw.sign() * draw.real(1.3, 1.7), draw.real(-0.1, 0.1)), draw.color(20, 30))
    return {"filter": _Filter(_MITCHELL_KIND), "samples": PixelSamples((near, far))}


def _below_zero(draw: RandomSource) -> Inputs:
    """All samples lie where the filter is below 0, and so do the weights' sum; their mean is light like any other."""

    def far() -> tuple[float, float]:
        out, near = draw.sign() * draw.real(1.3, 1.7), draw.real(-0.5, 0.5)
        return (out, near) if draw.chance(0.5) else (near, out)

    samples = tuple(PixelSample(far(), draw.color(0.1, 2.0)) for _ in range(draw.whole(1, 4)))
    return {"filter": _Filter(_MITCHELL_KIND), "samples": PixelSamples(samples)}


def _little_weight(draw: RandomSource) -> Inputs:
    """All samples lie at the rim of the tent. Their mean is light like any other, however little they count."""

    def rim() -> float:
        return draw.sign() * draw.real(0.9, 0.96)

    samples = tuple(PixelSample((rim(), rim()), draw.color(0.1, 2.0)) for _ in range(draw.whole(1, 2)))
    return {"filter": _Filter(_TENT_KIND), "samples": PixelSamples(samples)}


_COLOR = Answer(
    read_vector,
    words_of_vector,
    lambda _, expected, actual: channels("the light", expected, actual, Tolerance(2e-4, 5e-4)),
    near=itself,
)
_RECONSTRUCT = Function(
    "reconstruct",
    _COLOR,
    (
        Group("tent and Mitchell", lambda d: _samples(d, (_TENT_KIND, _MITCHELL_KIND), d.whole(4, 16))),
        Group("the box", lambda d: _samples(d, (_BOX,), d.whole(2, 16))),
        Group("one sample", lambda d: _samples(d, _EVERY, 1)),
        Group("one is very bright", _one_is_bright),
        Group("the answer is below 0", _negative_light),
        Group("the weights' sum is below 0", _below_zero),
        Group("nothing counts", _of_no_weight, exact=True),
        Group("some are black", _black_ones),
        Group("the first ones do not count", _first_ones_do_not_count),
        Group("little weight", _little_weight),
    ),
)


# The curve of a screen.


def _channel(value: float) -> Inputs:
    return {"channel": Real(f32(value))}


_NO_LIGHT = (-1.0, -0.001, -100.0, -math.inf, math.nan, -0.0)
_SRGB = Function(
    "linear_to_srgb",
    Answer(
        lambda tokens: tokens.real(),
        words_of_number,
        lambda _, expected, actual: real("the channel", expected, actual, Tolerance(2e-5, 1e-4)),
    ),
    (
        Group("any channel", lambda d: _channel(d.fine(0.01, 0.99))),
        Group("the darkest", lambda d: _channel(d.fine(0.0001, 0.003))),
        Group("just above the line", lambda d: _channel(d.fine(0.0033, 0.04))),
        Group("0 and 1", lambda d: _channel(float(d.whole(0, 1))), exact=True),
        Group("above 1", lambda d: _channel((1.001, 1.5, 30.0, 1e30, math.inf)[d.whole(0, 4)]), exact=True),
        Group("negative or NaN", lambda d: _channel(_NO_LIGHT[d.whole(0, 5)]), exact=True),
    ),
)

FUNCTIONS = (_STRATIFIED, _RADICAL_INVERSE, _HALTON, _TENT, _MITCHELL, _RECONSTRUCT, _SRGB)
