"""What the judge says of directions and samples that are wrong in one way, and the light of scripted paths."""

import math

import numpy as np
import pytest

from raysteps.judge.cases.mis import mean_of_plates, mean_of_walls
from raysteps.judge.cases.path_tracing import FUNCTIONS
from raysteps.judge.cases.whole_paths import mean_light
from raysteps.judge.functions import Case, Function
from raysteps.judge.protocol import Fill, Hit, Inputs, Vec, Whole, text
from raysteps.judge.scripted_tracer import (
    DirectSample,
    DirectSamples,
    MisHit,
    MisScript,
    PathHit,
    PathScript,
    PlateLamp,
    Scatter,
    WeighedScatter,
)
from raysteps.judge.statistics import Numbers

_FUNCTIONS = {function.name: function for function in FUNCTIONS}
_TIMES = 2048
_UP = (0.0, 0.0, 1.0)


def _line(numbers: Numbers) -> str:
    return " ".join(text(float(np.float32(number))) for number in numbers.ravel())


def _lifted(heights: Numbers, turns: Numbers) -> Numbers:
    """Directions around z with these heights, and angles in turns."""
    across = np.sqrt(np.maximum(0.0, 1 - heights**2))
    angles = 2 * math.pi * turns
    return np.stack([across * np.cos(angles), across * np.sin(angles), heights], axis=1)


def _draw(times: int = _TIMES, seed: int = 13) -> tuple[Numbers, Numbers]:
    one, other = np.random.default_rng(seed).random((2, times))
    return one, other


def _right(seed: int = 13, times: int = _TIMES) -> Numbers:
    u, v = _draw(times, seed)
    return _lifted(np.sqrt(u), v)


def _verdict(function: Function, inputs: Inputs, right: str, line: str) -> str:
    return str(Case(function.name, "", inputs).verdict(function.answer, right, line).problem)


_DIRECTION: Inputs = {"normal": Vec(_UP), "seed": Whole(1), "times": Whole(_TIMES)}


def _of_directions(directions: Numbers, times: int = _TIMES) -> str:
    inputs: Inputs = {**_DIRECTION, "times": Whole(times)}
    return _verdict(_FUNCTIONS["cosine_direction"], inputs, _line(_right(times=times)), _line(directions))


@pytest.mark.parametrize("times", [1, 2, 3, 8, 16, 64, 128, 256, 512, _TIMES])
def test_right_directions_never_fail(times: int) -> None:
    assert not any(_of_directions(_right(seed, times), times) for seed in range(200))


@pytest.mark.parametrize("times", [2, 16, 64, 256, 512])
@pytest.mark.parametrize("sigmas", [-5, 5])
def test_what_chance_explains_is_not_wrong(times: int, sigmas: int) -> None:
    """Heights that lean by as much as they do once in a million cases, to a density that has a name too."""
    mean = 0.5 + sigmas / math.sqrt(12 * times)
    u, v = (np.arange(times) + 0.5) / times, np.random.default_rng(13).permutation(times) / times
    heights = u ** (1 / mean - 1) if 0 < mean < 1 else np.full(times, 0.01 if mean < 0.5 else 0.99)
    assert _of_directions(_lifted(np.sqrt(1 - heights), v), times) == ""


@pytest.mark.parametrize(
    ("directions", "said"),
    [
        (_lifted(np.full(64, 0.05), _draw(64)[1]), "level directions come too often"),
        (_lifted(np.cbrt(0.9 + 0.1 * _draw(64)[0]), _draw(64)[1]), "steep directions come too often"),
        (-_right(times=64), "below the surface"),
    ],
)
def test_a_few_directions_only_tell_that_they_are_wrong(directions: Numbers, said: str) -> None:
    assert said in _of_directions(directions, 64)


_U, _V = _draw()


@pytest.mark.parametrize(
    ("directions", "said"),
    [
        (_lifted(_U, _V), "all directions of the half sphere come equally often"),
        (_lifted(_U**0.75, _V), "level directions come too often"),
        (_lifted(np.cbrt(_U), _V), "the density of the cosine's square"),
        (_lifted(_U**0.4, _V), "steep directions come too often"),
        (_lifted(np.sqrt(1 - _U**2), _V), "steep directions come too often"),
        (_lifted(np.sqrt(_U), 0.5 * _V), "evenly from all sides"),
        (_lifted(np.sqrt(_U), _U), "have to do with each other"),
        (_lifted(np.sqrt(np.where(_U < 0.5, 0.25, 0.75)), _V), "some heights"),
        (_lifted(np.sqrt(_U) * np.where(_V < 0.5, 1, -1), _V), "below the surface"),
        (np.roll(_right(), 1, axis=1), "around another axis"),
        (-_right(), "around another axis"),
        (1.01 * _right(), "length 1"),
        (_right()[:-1], "no proper answer"),
        (np.full((_TIMES, 3), np.nan), "NaN"),
    ],
)
def test_each_wrong_density_has_its_words(directions: Numbers, said: str) -> None:
    assert said in _of_directions(np.asarray(directions))


_HIT = Hit((0.0, 0.0, 0.0), _UP, (0.0, 0.0, -1.0), 1.0, Fill((0.8, 0.4, 0.2), 0.5))
_SCATTER: Inputs = {"hit": _HIT, "seed": Whole(1), "times": Whole(_TIMES)}


def _samples(weight: float = 1.0, pdf: float = 1.0, specular: float = 0.0, power: int = 0) -> str:
    """`power`: of the cosine, in the weight."""
    return _samples_of(_right(), weight, pdf, specular, power)


def _samples_of(
    directions: Numbers, weight: float = 1.0, pdf: float = 1.0, specular: float = 0.0, power: int = 0
) -> str:
    weights = weight * directions[:, 2:] ** power * np.array((0.4, 0.2, 0.1))
    pdfs = pdf * directions[:, 2:] / math.pi
    ends = np.ones((len(directions), 1)), np.full((len(directions), 1), specular)
    return _line(np.concatenate([ends[0], directions, weights, pdfs, ends[1]], axis=1))


def _of_samples(directions: Numbers) -> str:
    inputs: Inputs = {**_SCATTER, "times": Whole(len(directions))}
    line = _samples_of(directions)
    return _verdict(_FUNCTIONS["scatter_diffuse"], inputs, line, line)


@pytest.mark.parametrize("times", [1, 2, 16, 64, 512])
def test_right_samples_never_fail(times: int) -> None:
    assert not any(_of_samples(_right(seed, times)) for seed in range(100))


def test_a_right_sample_may_be_nearly_level() -> None:
    assert _of_samples(_lifted(np.array([0.01]), np.array([0.3]))) == ""


@pytest.mark.filterwarnings("error")  # of NumPy, whose words would stand on the terminal of whoever grades
@pytest.mark.parametrize("odd", ["inf", "-inf", "3.4028235e38", "1e-45"])
def test_odd_numbers_are_wrong_without_another_word(odd: str) -> None:
    line = " ".join(word if index % 9 in (0, 8) else odd for index, word in enumerate(_samples().split()))
    problem = _verdict(_FUNCTIONS["scatter_diffuse"], _SCATTER, _samples(), line)
    assert problem
    assert "no proper answer" not in problem


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (_samples(weight=0.99), "the weight is not f cos / pdf"),
        (_samples(power=2), "the weight is not f cos / pdf"),
        (_samples(weight=math.pi), "the weight is pi times f cos / pdf"),
        (_samples(weight=1 / math.pi), "the weight is f cos / pdf over pi"),
        (_samples(power=1), "times the cosine once more"),
        (_samples(power=-1), "the weight is f / pdf without the cosine"),
        (_samples(weight=1 / math.pi, power=1), "the weight is f cos without the pdf"),
        (_samples(weight=2, power=1), "equally likely"),
        (_samples(weight=2), "the weight lacks kd"),
        (_samples(pdf=1.01), "the pdf is not that of the direction"),
        (_samples(pdf=0), "the pdf is 0"),
        (_samples(pdf=math.pi), "the pdf is not divided by pi"),
        (_samples(pdf=0.5), "the pdf is divided by 2 pi"),
        (_samples(specular=1.0), "a specular sample"),
        ("0 " * _TIMES, "nothing came"),
        (_samples()[:5000], "no proper answer"),
    ],
)
def test_each_part_of_a_sample_is_looked_at(line: str, said: str) -> None:
    scatter = _FUNCTIONS["scatter_diffuse"]
    assert _verdict(scatter, _SCATTER, _samples(), _samples()) == ""
    assert said in _verdict(scatter, _SCATTER, _samples(), line)


# The sums that paths are compared with, beside closed forms.

_BLACK = (0.0, 0.0, 0.0)


def _hit(
    distance: float, weight: float | None, *, emission: float = 0.0, light: float = 0.0, mirror: bool = False
) -> PathHit:
    scatter = None if weight is None else Scatter(_UP, (weight, weight, weight), mirror)
    return PathHit(distance, _UP, (emission,) * 3, (light,) * 3, scatter)


@pytest.mark.parametrize(
    ("script", "light"),
    [
        (PathScript((0.3, 0.3, 0.3), goes_on=False, hits=()), 0.3),
        (PathScript(_BLACK, goes_on=True, hits=(_hit(1, 0.5, light=1.0),)), 2.0),
        (PathScript(_BLACK, goes_on=True, hits=(_hit(1, 0.8, emission=1.0, mirror=True),)), 5.0),
        (PathScript(_BLACK, goes_on=True, hits=(_hit(1, 0.8, emission=1.0),)), 1.0),
        (PathScript((0.5, 0.5, 0.5), goes_on=False, hits=(_hit(1, 0.5, light=0.1), _hit(2, 0.5, emission=9.0))), 0.225),
        (PathScript(_BLACK, goes_on=False, hits=(_hit(1, 0.5, mirror=True), _hit(2, None, emission=9.0))), 4.5),
    ],
)
def test_the_mean_light_of_a_script(script: PathScript, light: float) -> None:
    assert mean_light(script) == pytest.approx((light, light, light))


def _plate(weight: float, exponent: float, *lamps: PlateLamp) -> MisHit:
    scatter = WeighedScatter(Scatter(_UP, (weight, weight, weight)), 0.0)
    return MisHit(2.5, _UP, _BLACK, True, 0.0, DirectSamples(()), scatter, exponent, lamps)


_SKY = PlateLamp(0.0, 1.0, (2.0, 2.0, 2.0))
_QUARTER = PlateLamp(0.75, 1.0, (2.0, 2.0, 2.0))
_HALF = PlateLamp(0.25, 0.75, (4.0, 4.0, 4.0))


@pytest.mark.parametrize(
    ("script", "light"),
    [
        (MisScript(_BLACK, goes_on=False, hits=(_plate(0.5, 3.0, _SKY),)), 1.0),
        (MisScript((1.0, 1.0, 1.0), goes_on=False, hits=(_plate(0.5, 0.0, _QUARTER),)), 0.25 + 0.375),
        (MisScript(_BLACK, goes_on=False, hits=(_plate(0.5, 1.0, _QUARTER, _HALF),)), 0.4375 + 1.0),
        (MisScript(_BLACK, goes_on=True, hits=(_plate(0.5, 0.0, _QUARTER),)), 0.25 / (1 - 0.375)),
        (MisScript(_BLACK, goes_on=True, hits=(_plate(0.5, 0.0), _plate(0.5, 0.0, _QUARTER))), 0.2),
    ],
)
def test_the_mean_light_between_plates(script: MisScript, light: float) -> None:
    assert mean_of_plates(script) == pytest.approx((light, light, light))


def _wall(pdf: float, *samples: DirectSample, emission: float = 0.0, ends: bool = False) -> MisHit:
    """It sends on half of the light; where it is a lamp, its sample has the density 1."""
    scatter = None if ends else WeighedScatter(Scatter(_UP, (0.5, 0.5, 0.5)), pdf)
    return MisHit(2.5, _UP, (emission,) * 3, True, 1.0, DirectSamples(samples), scatter)


_SAMPLED = DirectSample((1.0, 1.0, 1.0), 3.0, 1.0)  # weight 0.9


@pytest.mark.parametrize(
    ("hits", "light"),
    [
        ((_wall(1.0, emission=1.0),), 1.0 + 0.5),
        ((_wall(1.0, _SAMPLED, _SAMPLED, ends=True),), 1.8),
        ((_wall(2.0), _wall(1.0, emission=1.0, ends=True)), 0.5 * 0.8),
        ((_wall(1.0, _SAMPLED), _wall(0.5), _wall(1.0, _SAMPLED, emission=1.0)), 0.9 + 0.25 * (0.2 + 0.9) + 0.125),
    ],
)
def test_the_mean_light_between_walls(hits: tuple[MisHit, ...], light: float) -> None:
    """Below a sky of 1."""
    script = MisScript((1.0, 1.0, 1.0), goes_on=False, hits=hits)
    assert mean_of_walls(script) == pytest.approx((light, light, light))
