"""Error rates of the test of estimates, for distributions as they come out of lights and paths: even, skew, rare."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from raysteps.judge.estimates import (
    BATCHES,
    BatchMeans,
    critical_value,
    estimates_problem,
    has_right_mean,
    plan,
    read_estimates,
    words_of_estimates,
)
from raysteps.judge.protocol import ProtocolError, Real, TokenReader, text
from raysteps.judge.random_source import RandomSource
from raysteps.judge.statistics import Numbers

_SEED = 13
_Sums = Callable[[np.random.Generator, int, int], NDArray[np.floating]]

# Sums of `size` independent numbers, drawn at once, for so many rows of batches: each number has mean 1.
_KINDS: dict[str, tuple[float, _Sums]] = {  # the second moment about the mean of one number
    "nearly even": (0.01, lambda draw, rows, size: draw.normal(size, 0.1 * size**0.5, (rows, BATCHES))),
    "exponential": (1.0, lambda draw, rows, size: draw.gamma(size, 1.0, (rows, BATCHES))),
    "one in four": (3.0, lambda draw, rows, size: 4.0 * draw.binomial(size, 0.25, (rows, BATCHES))),
    "one in fifty": (49.0, lambda draw, rows, size: 50.0 * draw.binomial(size, 0.02, (rows, BATCHES))),
    "long tail": (10.0, lambda draw, rows, size: draw.gamma(0.1 * size, 10.0, (rows, BATCHES))),
}
_TRIES = 600


def _batches(kind: str, bias: float, tries: int) -> Numbers:
    """As many estimates as finding that bias takes; means of batches."""
    variance, sums = _KINDS[kind]
    precision = plan(RandomSource("1"), bias)["precision"]
    assert isinstance(precision, Real)
    size = int(np.ceil(variance / precision.value**2 / BATCHES))
    return np.asarray(sums(np.random.default_rng(_SEED), tries, size) / size)


@pytest.mark.parametrize("kind", _KINDS)
@pytest.mark.parametrize("bias", [0.01, 0.02, 0.05])
def test_right_estimates_never_fail_and_biased_ones_do(kind: str, bias: float) -> None:
    batches = _batches(kind, bias, _TRIES)
    assert all(has_right_mean(one, 1.0) for one in batches)
    for off in (1 - bias, 1 + bias):
        found = sum(not has_right_mean(one * off, 1.0) for one in batches)
        assert found >= 0.98 * _TRIES


@pytest.mark.parametrize("kind", _KINDS)
def test_the_error_is_the_one_that_was_fixed(kind: str) -> None:
    """Farther in, where errors can be counted: at three deviations 27 in 10 000 are off."""
    batches = _batches(kind, 0.05, 4000)
    off = np.abs(batches.mean(axis=1) - 1.0) / (batches.std(axis=1, ddof=1) / BATCHES**0.5)
    failed = sum(distance > critical_value(one, 3.0) for distance, one in zip(off, batches, strict=True))
    assert failed <= 24


def test_no_noise_at_all_is_no_fault() -> None:
    assert has_right_mean(np.full(BATCHES, 0.3), 0.3)
    assert not has_right_mean(np.full(BATCHES, 0.3), 0.301)


# What a whole answer is told.

_MEAN = (1.0, 0.5, 0.0)


def _estimates(scale: float = 1.0, noise: float = 0.1, cost: int = 3) -> BatchMeans:
    draw = np.random.default_rng(_SEED)
    batches = scale * np.array(_MEAN) * draw.normal(1.0, noise, (BATCHES, 1))
    return BatchMeans(100, 100 * BATCHES * cost, batches, (1.0, 0.5, 0.0), (1.0, 0.5, 0.0))


def _problem(actual: BatchMeans) -> str:
    return estimates_problem("the light", _MEAN, _estimates(), actual)


def test_a_right_answer_has_no_problem() -> None:
    assert _problem(_estimates()) == ""
    assert _problem(_estimates(noise=0.15)) == ""
    assert _problem(_estimates(cost=6)) == ""


@pytest.mark.parametrize(
    ("actual", "said"),
    [
        (_estimates(scale=0.9), "wrong on average, too small"),
        (_estimates(scale=3.14), "wrong on average, much too large"),
        (_estimates(scale=1 / 3.14), "wrong on average, much too small"),
        (_estimates(scale=-1.0), "not even near"),
        (_estimates(noise=0.3), "noisier than it need be"),
        (_estimates(cost=20), "noisier than it need be"),
        (_estimates(scale=float("nan")), "NaN"),
    ],
)
def test_each_fault_has_its_words(actual: BatchMeans, said: str) -> None:
    assert said in _problem(actual)


def test_infinite_light_is_wrong_and_can_be_told() -> None:
    found = _estimates()
    found.batches[3] = np.inf
    assert "infinite" in _problem(found)
    assert "inf" in words_of_estimates(found)


def test_the_same_stream_must_give_the_same() -> None:
    found = _estimates()
    assert "the same stream" in _problem(
        BatchMeans(found.size, found.cost, found.batches, found.first, (1.0, 0.5, 0.1))
    )


def test_an_answer_is_read_as_it_was_written() -> None:
    found = _estimates()
    words = [100, found.cost, BATCHES, *found.batches.ravel(), *found.first, *found.again]
    line = " ".join(str(word) if isinstance(word, int) else text(float(word)) for word in words)
    read = read_estimates(TokenReader(line))
    assert read.count == 100 * BATCHES
    assert np.allclose(read.batches, found.batches)
    assert words_of_estimates(read).endswith("from 25600 estimates")
    for broken in ("", "1 1", line.replace(" 256 ", " 3 ", 1), line[:-30]):
        with pytest.raises(ProtocolError):
            read_estimates(TokenReader(broken))
