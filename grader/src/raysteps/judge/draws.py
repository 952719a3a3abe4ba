"""What a function that is asked with many random numbers gives: points and how even they are, directions, or samples of
a path's way on."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from raysteps.judge.answers import no_number
from raysteps.judge.protocol import Inputs, ProtocolError, TokenReader, Whole, f32, text, vector_words, whole_of
from raysteps.judge.random_source import RandomSource
from raysteps.judge.statistics import (
    DEVIATIONS,
    SIGNIFICANCE,
    Numbers,
    has_mean,
    is_uniform,
    ratio_problem,
    uneven_problem,
)

_MAX_SAMPLES = 40_000
_UNIT = 1e-4


def seed_and_times(draw: RandomSource, amount: int) -> dict[str, Whole]:
    """So many random points."""
    return {"seed": Whole(draw.whole(1, 1_000_000_000)), "times": Whole(amount)}


# Points, directions or rays by the row.

FEW, MANY, VERY_MANY = 8, 2048, 16_384
_CORNERS = 16
_MAX_ROWS = 100_000


@dataclass(frozen=True)
class Draws:
    """Rows of numbers, and what the first u gave once more."""

    rows: Numbers
    again: Numbers


def draws_reader(width: int) -> Callable[[TokenReader], Draws]:
    """Reads rows of so many numbers."""

    def read(tokens: TokenReader) -> Draws:
        found = tokens.rows(width, _MAX_ROWS)
        return Draws(found[:-1], found[-1:].ravel())

    return read


def words_of_draws(draws: Draws) -> str:
    """How many, and the first of them."""
    shown = ", ".join("(" + ", ".join(text(f32(number)) for number in row) + ")" for row in draws.rows[:4])
    return f"{len(draws.rows)} answers, first {shown}"


def corners() -> Inputs:
    """No random points, but the corners of the unit square and places between them."""
    return {"seed": Whole(0), "times": Whole(_CORNERS)}


def broken_draws(inputs: Inputs, actual: Draws, what: str) -> str:
    """What is wrong whatever was asked."""
    if len(actual.rows) != whole_of(inputs, "times"):
        return "no proper answer came"
    if not np.isfinite(actual.rows).all():
        return f"{what} is infinite or NaN"
    if not np.array_equal(actual.rows[0], actual.again):
        return "the same u gave another answer"
    return ""


def place_problem(problem: str, points: Numbers) -> str:
    """A place that no point may have. One that all points have comes of no formula at all, as in a function that is
    not written."""
    alike = len(points) > 1 and bool((points == points[0]).all())
    return f"{problem}, the same for every u" if alike else problem


# Whether points lie evenly in a shape.


@dataclass(frozen=True)
class Region:
    """How a shape is measured: of each point two numbers that are even from 0 to 1 where all of the shape is equally
    likely, such as the square of the radius and the angle. What is said where they are not."""

    low: str  # too many have a small first number
    high: str
    uneven: str
    around: str  # the second number is uneven
    way: str  # what the first number is
    way_around: str


DISK = Region(
    "too many points lie near the middle",
    "too many points lie near the rim",
    "some rings get more points than others of the same area",
    "some sides get more points than others",
    "points from the middle to the rim, in rings of equal area",
    "points around the middle, side by side",
)
CAP = Region(
    "too many points lie near the middle of what can be seen",
    "too many points lie near the rim of what can be seen",
    "some rings get more points than others of the same solid angle",
    "some sides get more points than others",
    "points from the middle of what can be seen to its rim, in rings of equal solid angle",
    "points around the middle, side by side",
)
TRIANGLE = Region(
    "too many points lie near the first corner",
    "too many points lie away from the first corner",
    "points are not spread evenly from the first corner to the side opposite to it",
    "points are not spread evenly between the second and the third corner",
    "points from the first corner to the side opposite to it, in strips of equal area",
    "points from the side of the second corner to that of the third",
)


def evenness(inputs: Inputs, region: Region, shares: Numbers) -> str:
    """The corners of the unit square are even nowhere; of a few points no more can be told than that they differ."""
    if whole_of(inputs, "seed") == 0:
        return ""
    if len(shares) < MANY:
        return "" if 2 * len(np.unique(shares, axis=0)) > len(shares) else "different u give the same point"
    is_found = bool(_uneven_problems(region, shares, DEVIATIONS, SIGNIFICANCE))
    problems = _uneven_problems(region, shares, *_TO_TELL) if is_found else []
    words = ", and ".join(problems)
    along, around = shares[:, 0], shares[:, 1]
    if {region.low, region.high, region.uneven} & {*problems}:
        return uneven_problem(words, region.way, along)
    goes_round = region is not TRIANGLE
    return (
        uneven_problem(words, region.way_around, around, goes_round=goes_round) if region.around in problems else words
    )


_TO_TELL = 4.0, 1e-4  # where points are uneven for certain, less is enough to tell how: it hangs less on chance


def _uneven_problems(region: Region, shares: Numbers, deviations: float, significance: float) -> list[str]:
    bins = 32 if len(shares) >= VERY_MANY else 8
    along, around = shares[:, 0], shares[:, 1]

    def has_middle(numbers: Numbers) -> bool:
        return has_mean(numbers, 0.5, math.sqrt(1 / 12), deviations)

    problems = []
    if not has_middle(along):
        problems.append(region.low if float(along.mean()) < 0.5 else region.high)
    elif not is_uniform(along, 2 * bins, significance):
        problems.append(region.uneven)
    if not (has_middle(around) and is_uniform(around, 2 * bins, significance)):
        problems.append(region.around)
    if not is_uniform(_ranks(shares) if problems else shares, bins, significance):
        problems.append("the two random numbers have to do with each other")
    return problems


def _ranks(shares: Numbers) -> Numbers:
    """Each column made even: what is left tells whether one has to do with the other."""
    order = np.argsort(shares, axis=0, kind="stable")
    return np.asarray((np.argsort(order, axis=0) + 0.5) / len(shares))


def turns_around(x: Numbers, y: Numbers) -> Numbers:
    """Angles as shares of a whole turn."""
    return np.asarray(np.arctan2(y, x) / (2 * math.pi) + 0.5)


def as_shares(along: Numbers, around: Numbers) -> Numbers:
    """Rows of both, with what rounding adds cut off."""
    return np.clip(np.stack([along, around], axis=1), 0.0, 1.0)


def heights_of_directions(directions: Numbers) -> Numbers:
    """1 - z of unit vectors, from what they are long across, where 1 - z has no digits left."""
    x, y, z = directions.T
    squares = x * x + y * y
    return np.asarray(np.where(z > 0, squares / (1 + np.sqrt(np.maximum(0.0, 1 - squares))), 1 - z))


# Directions, and samples of a way on.


def read_directions(tokens: TokenReader) -> Numbers:
    """Row by row."""
    return tokens.rows(3, _MAX_SAMPLES)


def _words_of(v: Sequence[float] | Numbers) -> str:
    """Of one direction or colour."""
    x, y, z = (float(value) for value in v)
    return vector_words((x, y, z))


def words_of_directions(directions: Numbers) -> str:
    """How many, and the first of them."""
    shown = ", ".join(_words_of(direction) for direction in directions[:4])
    return f"{len(directions)} directions, first {shown}"


@dataclass(frozen=True)
class Samples:
    """Each row: direction, weight, pdf, 1 where it is specular. `nothing`: so often nothing came."""

    nothing: int
    rows: Numbers

    @property
    def count(self) -> int:
        return len(self.rows) + self.nothing

    @property
    def directions(self) -> Numbers:
        return np.asarray(self.rows[:, :3])

    @property
    def weights(self) -> Numbers:
        return np.asarray(self.rows[:, 3:6])

    @property
    def pdfs(self) -> Numbers:
        return np.asarray(self.rows[:, 6])

    @property
    def are_specular(self) -> bool:
        return bool((self.rows[:, 7] == 1).all())

    @property
    def is_specular_somewhere(self) -> bool:
        return bool(self.rows[:, 7].any())


def read_sample(tokens: TokenReader) -> list[float] | None:
    """One row, or nothing."""
    if not tokens.flag():
        return None
    return [*tokens.vector(), *tokens.vector(), tokens.real(), float(tokens.flag())]


def read_samples(tokens: TokenReader) -> Samples:
    """All that follow."""
    there, rows = _optional_samples(tokens)
    return Samples(there.count(False), rows)


def read_samples_and_first(tokens: TokenReader) -> tuple[Samples, bool]:
    """All that follow but the last, and whether that is the first once more."""
    there, rows = _optional_samples(tokens)
    if not there:
        return Samples(0, rows), False
    same = there[0] == there[-1] and (not there[0] or bool((rows[0] == rows[-1]).all()))
    return Samples(there[:-1].count(False), rows[:-1] if there[-1] else rows), same


def _optional_samples(tokens: TokenReader) -> tuple[list[bool], Numbers]:
    """Which are there, and those."""
    there, rows = tokens.optional_rows(8, _MAX_SAMPLES)
    if not np.isin(rows[:, 7], (0, 1)).all():
        raise ProtocolError("the answer holds another word where a flag belongs")
    return there, rows


def words_of_samples(samples: Samples) -> str:
    """How many, and the first of them."""
    shown = [f"nothing {samples.nothing} times"] if samples.nothing else []
    if len(samples.rows):
        row = samples.rows[0]
        shown.append(
            f"{len(samples.rows)} samples, first direction {_words_of(row[:3])} weight {_words_of(row[3:6])} "
            f"pdf {text(f32(float(row[6])))}{' specular' if row[7] else ''}"
        )
    return ", ".join(shown)


def odd_number(what: str, numbers: Numbers) -> str:
    """Whether one of them is infinite or NaN, in words."""
    return no_number(what, *numbers[~np.isfinite(numbers)].tolist())


def unit_problem(directions: Numbers) -> str:
    """Whether all are numbers, and of unit length."""
    odd = odd_number("a direction", directions)
    if odd:
        return odd
    lengths = np.linalg.norm(directions, axis=1)
    return "" if (np.abs(lengths - 1) <= _UNIT).all() else ratio_problem("a direction does not have length 1", lengths)
