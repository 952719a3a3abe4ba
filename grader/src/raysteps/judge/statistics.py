"""Whether random numbers are what they ought to be: tests whose errors are fixed in advance.

A grade makes some thousand of them. Each calls a right function wrong with a probability of about 10^-13 (of counts of
16 and more, 10^-12 at most), so that a right submission fails with less than 10^-9; how small a fault is found depends
on how many numbers are drawn.
"""

import math

import numpy as np
from numpy.typing import NDArray

from raysteps.results.model import Histogram

Numbers = NDArray[np.float64]

SIGNIFICANCE = 1e-13
DEVIATIONS = 7.5  # of a normal variable, which is farther off with a probability of 6e-14
_MIN_EXPECTED = 16  # in each bin: with fewer, chi-square is no longer the distribution


def chi_square_tail(value: float, degrees: int) -> float:
    """The probability that a chi-square variable with so many degrees of freedom is at least that large: a finite sum,
    from the recurrence of the incomplete gamma function (Abramowitz and Stegun 26.4.4 and 26.4.5)."""
    half = value / 2
    if half <= 0:
        return 1.0
    odd = degrees % 2
    tail = math.erfc(math.sqrt(half)) if odd else math.exp(-half)
    for a in np.arange(0.5 if odd else 1.0, degrees / 2):
        tail += math.exp(a * math.log(half) - half - math.lgamma(a + 1))
    return min(1.0, tail)


def has_mean(numbers: Numbers, mean: float, deviation: float, most: float = DEVIATIONS) -> bool:
    """Whether the mean of independent numbers with that standard deviation is right (z-test)."""
    return abs(float(numbers.mean()) - mean) <= most * deviation / math.sqrt(len(numbers))


def is_uniform(shares: Numbers, bins: int, significance: float = SIGNIFICANCE) -> bool:
    """Whether numbers from 0 to 1, or rows of several such numbers, are spread evenly over the bins of each (Pearson's
    chi-square test). What is drawn too seldom to tell is taken as even."""
    rows = shares[:, None] if shares.ndim == 1 else shares
    cells = bins ** rows.shape[1]
    expected_count = len(rows) / cells
    if expected_count < _MIN_EXPECTED:
        return True
    places = np.minimum((rows * bins).astype(np.int64), bins - 1)
    index = places @ (bins ** np.arange(rows.shape[1]))
    found = np.bincount(index, minlength=cells)
    statistic = float(((found - expected_count) ** 2).sum() / expected_count)
    return chi_square_tail(statistic, cells - 1) >= significance


def has_same_distribution(shares: Numbers, others: Numbers, bins: int) -> bool:
    """Whether rows of numbers from 0 to 1 are spread over the bins as others are, which are the judge's own draws
    (chi-square test of two samples). Bins with too few to tell are taken together."""

    def counted(rows: Numbers) -> Numbers:
        places = np.minimum((rows * bins).astype(np.int64), bins - 1)
        found = np.bincount(places @ (bins ** np.arange(rows.shape[1])), minlength=bins ** rows.shape[1])
        return found.astype(np.float64)

    found, right = counted(shares), counted(others)
    both = found + right
    few = both * min(len(shares), len(others)) / (len(shares) + len(others)) < _MIN_EXPECTED
    found, right = (np.append(counts[~few], counts[few].sum()) for counts in (found, right))
    there = found + right > 0
    found, right = found[there], right[there]
    if len(found) < 2:
        return True
    more = math.sqrt(len(others) / len(shares))
    statistic = float(((more * found - right / more) ** 2 / (found + right)).sum())
    return chi_square_tail(statistic, len(found) - 1) >= SIGNIFICANCE


def means_agree(numbers: Numbers, others: Numbers) -> bool:
    """Whether independent numbers have the mean of others, which are the judge's own draws (z-test)."""
    deviation = math.sqrt(float(others.var()) * (1 / len(numbers) + 1 / len(others)))
    return abs(float(numbers.mean() - others.mean())) <= DEVIATIONS * deviation


def is_plausible_count(found: int, tries: int, seen: int, own_tries: int) -> bool:
    """Whether an event that came `seen` times in the judge's own tries may come so often: exact binomial tails, at the
    end of the range in which its probability must lie."""
    share = seen / own_tries
    unsure = DEVIATIONS * math.sqrt(share * (1 - share) / own_tries) - math.log(SIGNIFICANCE) / own_tries
    probability = share + unsure if found > tries * share else share - unsure
    return _binomial_tail(found, tries, probability, many=found > tries * share) >= SIGNIFICANCE


def _binomial_tail(found: int, tries: int, probability: float, *, many: bool) -> float:
    """How probable it is that an event comes as often in independent tries, or even more often (or as seldom)."""
    probability = min(max(probability, 1e-300), 1 - 1e-12)
    counts = np.arange(found, tries + 1) if many else np.arange(found + 1)
    logs = np.append(0.0, np.cumsum(np.log(np.arange(1, tries + 1))))
    chances = logs[tries] - logs[counts] - logs[tries - counts]
    chances += counts * math.log(probability) + (tries - counts) * math.log1p(-probability)
    return float(np.exp(chances).sum())


def is_plausible_total(found: int, shares: Numbers, slack: int) -> bool:
    """Whether of independent events, each with a probability of its own, so many may come; `slack`: how many of them
    may have gone another way. From one off the mean on, tails are no heavier than those of as many events that all have
    the mean probability (Hoeffding 1956)."""
    tries, expected = len(shares), float(shares.sum())
    many = found > expected
    near = max(found - slack, 0) if many else min(found + slack, tries)
    if abs(found - expected) <= slack + 1:
        return True
    return _binomial_tail(near, tries, expected / tries, many=many) >= SIGNIFICANCE


def are_independent(first: Numbers, second: Numbers, bins: int) -> bool:
    """Of two rows of even numbers from 0 to 1: sum and difference, going round, are even where they have nothing to do
    with each other. One of them is not where one number is made of the other, turned round or not."""
    return is_uniform((first - second) % 1.0, bins) and is_uniform((first + second) % 1.0, bins)


def has_many_near_pairs(rows: Numbers, gap: float) -> bool:
    """Whether, within the rows, many more numbers from 0 to 1 lie within `gap` of another one than chance explains."""
    pairs = rows.shape[0] * (rows.shape[1] - 1)
    alike = int((np.diff(np.sort(rows, axis=1), axis=1) <= gap).sum())
    by_chance = pairs * rows.shape[1] * gap
    return bool(alike > max(_MIN_ALIKE, _ALIKE_SHARE * pairs, 10 * by_chance))


_MIN_ALIKE, _ALIKE_SHARE = 20, 0.01


# What is told of numbers that are not spread as they ought to be.

_BARS = 16


class UnevenProblem(str):
    """A problem of how numbers are spread, with their histogram. `goes_round`: angles, counted from anywhere."""

    histogram: Histogram
    goes_round: bool


def uneven_problem(
    problem: str, over: str, shares: Numbers, others: Numbers | None = None, *, goes_round: bool = False
) -> UnevenProblem:
    """Of numbers from 0 to 1, which should be even, or spread as others are."""
    counts, _ = np.histogram(shares, _BARS, (0.0, 1.0))
    own = np.full(_BARS, 1.0) if others is None else np.histogram(others, _BARS, (0.0, 1.0))[0]
    expected = [round(float(part), 2) for part in own * len(shares) / own.sum()]
    found = UnevenProblem(problem)
    found.histogram = Histogram(over, counts.tolist(), expected)
    found.goes_round = goes_round
    return found


DECILES = 9
_FAR = 1e6


class RatioProblem(str):
    """A problem of numbers that are not what they should be, and how many times that they are."""

    times: tuple[float, ...]


def ratio_problem(problem: str, times: Numbers) -> RatioProblem:
    """Of a few such quotients all are kept, of more the deciles: samples come in any order, numbers in any shape."""
    found = RatioProblem(problem)
    numbers = np.clip(np.nan_to_num(times.ravel(), nan=-_FAR), -_FAR, _FAR)
    kept = numbers if len(numbers) < DECILES else np.quantile(numbers, np.arange(1, DECILES + 1) / (DECILES + 1))
    found.times = tuple(float(f"{one:.4g}") for one in kept)
    return found
