"""Whether random numbers are what they ought to be: tests whose errors are fixed in advance.

A grade asks some hundred of them. Each calls a right function wrong with a probability of 10^-12, so that a right
submission fails with less than 10^-9; how small a fault is found depends on how many numbers are drawn.
"""

import math

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]

SURPRISE = 1e-12
_DEVIATIONS = 7.2  # of a normal variable, which is farther off with a probability of 6e-13


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


def has_mean(numbers: Numbers, mean: float, deviation: float) -> bool:
    """Whether the mean of independent numbers with that standard deviation is right (z-test)."""
    return abs(float(numbers.mean()) - mean) <= _DEVIATIONS * deviation / math.sqrt(len(numbers))


def is_even(shares: Numbers, bins: int) -> bool:
    """Whether numbers from 0 to 1, or rows of several such numbers, are spread evenly over the bins of each (Pearson's
    chi-square test). What is drawn too seldom to tell is taken as even."""
    rows = shares[:, None] if shares.ndim == 1 else shares
    cells = bins ** rows.shape[1]
    expected = len(rows) / cells
    if expected < _LEAST_EXPECTED:
        return True
    places = np.minimum((rows * bins).astype(np.int64), bins - 1)
    index = places @ (bins ** np.arange(rows.shape[1]))
    found = np.bincount(index, minlength=cells)
    surprise = float(((found - expected) ** 2).sum() / expected)
    return chi_square_tail(surprise, cells - 1) >= SURPRISE


_LEAST_EXPECTED = 16


def are_independent(first: Numbers, second: Numbers, bins: int) -> bool:
    """Of two rows of even numbers from 0 to 1: the difference, going round, is even where they have nothing to do with
    each other, and is not where one is made of the other."""
    return is_even((first - second) % 1.0, bins)
