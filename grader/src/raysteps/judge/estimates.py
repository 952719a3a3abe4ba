"""Whether numbers that are estimated by chance are right on average: a test whose errors are fixed in advance.

A function is asked many times, each time with another stream (framework/worker/estimates.hpp), until the mean is known
to a precision that the case names; which mean is right only the judge knows. Right functions are called wrong with a
probability of about 10^-13 for each mean, whatever the shape of the distribution, as long as it is no rarer than that
a few hundred of the estimates show it. What is off by 11.5 times the precision is found in 99 of 100 tries.
"""

import math
from dataclasses import dataclass

import numpy as np

from raysteps.common.vectors import Vector
from raysteps.judge.answers import Tolerance
from raysteps.judge.protocol import Inputs, ProtocolError, Real, TokenReader, Whole, f32, rounded, vector_words
from raysteps.judge.random_source import RandomSource
from raysteps.judge.statistics import DEVIATIONS, Numbers, ratio_problem

BATCHES = 256  # as in the worker
_PRECISION_OF_A_BIAS = 11.5  # DEVIATIONS, as a t-test asks for them, and three more to be sure
_MAX = 200_000  # estimates for one case


@dataclass(frozen=True)
class BatchMeans:
    """Of so many independent estimates: what all cost, the means of batches, row by row, and what the first few streams
    gave together when they were asked at first and at last."""

    size: int  # of each batch
    cost: int
    batches: Numbers
    first: Vector
    again: Vector

    @property
    def count(self) -> int:
        return self.size * len(self.batches)

    @property
    def mean(self) -> Numbers:
        return np.asarray(self.batches.mean(axis=0))

    @property
    def error(self) -> Numbers:
        """Standard error of the mean, of each channel."""
        with np.errstate(invalid="ignore", over="ignore"):  # light may be infinite
            return np.asarray(self.batches.std(axis=0, ddof=1) / math.sqrt(len(self.batches)))

    def inefficiency(self, mean: Vector) -> float:
        """What an error of the size of the right mean costs, of the worst channel: variance times cost. The number of
        estimates does not matter to it; an estimate that asks nothing counts as one question."""
        largest = max(map(abs, mean))
        return float((self.error**2).max()) * max(self.cost, self.count) / largest**2 if largest else 0.0


def plan(draw: RandomSource, bias: float) -> Inputs:
    """As many estimates as it takes to find a bias of that share of the mean."""
    seed = draw.whole(1, 1_000_000_000)
    return {"seed": Whole(seed), "precision": Real(f32(bias / _PRECISION_OF_A_BIAS)), "most": Whole(_MAX)}


def read_estimates(tokens: TokenReader) -> BatchMeans:
    size, cost = tokens.whole(1, 1 << 30), tokens.whole(0, 1 << 50)
    if tokens.whole() != BATCHES:
        raise ProtocolError("the answer holds another number of batches")
    batches = tokens.reals(3 * BATCHES).reshape(BATCHES, 3)
    return BatchMeans(size, cost, batches, tokens.vector(), tokens.vector())


def words_of_estimates(found: BatchMeans) -> str:
    """Mean and what it may be off by: two of three times it is nearer."""
    return f"{_words(found.mean)} +- {_words(found.error)} from {found.count} estimates"


def _words(channels: Numbers) -> str:
    x, y, z = (float(f"{channel:.5g}") for channel in channels)
    return vector_words(rounded((x, y, z)))


def critical_value(batches: Numbers, deviations: float = DEVIATIONS) -> float:
    """How many standard errors a right mean may be off: Student's t for so many batches, as far out as that many
    deviations of a normal variable (Wallace 1959), and what a skew distribution adds to it (Johnson 1978)."""
    degrees = len(batches) - 1
    normal = deviations / (1 - 3 / (8 * degrees))
    student = math.sqrt(degrees * math.expm1(normal * normal / degrees))
    centred = batches - batches.mean()
    deviation = math.sqrt(float((centred**2).mean()))
    skew = abs(float((centred**3).mean())) / deviation**3 if deviation else 0.0
    return student + skew * (1 + 2 * student * student) / (6 * math.sqrt(len(batches)))


_ROUNDING = Tolerance(1e-6, 2e-5)  # what float loses when it adds up


def has_right_mean(batches: Numbers, mean: float) -> bool:
    """Of one channel."""
    error = float(batches.std(ddof=1)) / math.sqrt(len(batches))
    return abs(float(batches.mean()) - mean) <= critical_value(batches) * error + _ROUNDING.of(mean)


_MAX_WORK = 5.0  # times the reference's, before it counts as noise that need not be


def estimates_problem(
    what: str, mean: Vector, expected: BatchMeans, actual: BatchMeans, most_work: float = _MAX_WORK
) -> str:
    """Whether the same stream gives the same, the mean is right, and no needless noise is in it: an estimate that is
    right on average, but takes many more of them, or many more rays, to be of use."""
    if not np.isfinite(actual.batches).all():
        return f"{what} is infinite or NaN in some estimates"
    if actual.first != actual.again:
        return "the same stream gave another answer; all numbers must come from it"
    for channel in range(3):
        if not has_right_mean(actual.batches[:, channel], mean[channel]):
            words = f"{what} is wrong on average, {_side(float(actual.mean[channel]), mean[channel])}"
            return ratio_problem(words, np.divide(actual.mean, mean, out=np.zeros(3), where=np.array(mean) != 0))
    if actual.inefficiency(mean) > most_work * expected.inefficiency(mean) + _NO_NOISE:
        return f"{what} is right on average, but noisier than it need be"
    return ""


_NO_NOISE = 1e-4  # of work: an error of a hundredth for each ray


def _side(found: float, right: float) -> str:
    """In rough words that give no number away."""
    if found * right <= 0:
        return "not even near" if right else "where it should be none"
    share = found / right
    sides = ((0.5, "much too small"), (1.0, "too small"), (2.0, "too large"))
    return next((words for most, words in sides if share <= most), "much too large")
