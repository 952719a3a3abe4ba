"""Noisy pictures: what is right passes whatever chance does, what is a little wrong does not."""

import json
import math
import re
from typing import Any

import numpy as np
import pytest
from estimate_files import bytes_of

from raysteps.images.noise import (
    PART,
    Estimates,
    EstimatesError,
    as_lists,
    as_picture,
    bias_map,
    compare_estimates,
    from_lists,
    read_estimates,
    samples_of,
    with_samples,
)

_HEIGHT, _WIDTH, _SAMPLES, _MORE = 30, 44, 16, 4
_SIZE = (_WIDTH, _HEIGHT)
_MAX_NOISE = 2.0


@pytest.fixture
def rng() -> np.random.Generator:
    """The same numbers each time."""
    return np.random.default_rng(2026)


def _scene() -> np.ndarray:
    """The light of a made-up picture: from dark to bright, and a coloured part."""
    light = np.linspace(0.05, 2.0, _WIDTH)[None, :, None] * np.ones((_HEIGHT, 1, 3))
    light[10:20, 5:15] *= (1.0, 0.5, 0.1)
    return np.asarray(light)


def _drawn(rng: np.random.Generator, light: np.ndarray, samples: int, shape: float = 1.0) -> Estimates:
    """What so many samples for each pixel say of the light: of a gamma distribution, skewed to the bright side, whose
    variance is light^2 / shape."""
    drawn = rng.gamma(shape, light / shape, (samples, *light.shape))
    return Estimates(drawn.mean(axis=0), drawn.var(axis=0, ddof=1) / samples)


def _reference(rng: np.random.Generator) -> Estimates:
    return _drawn(rng, _scene(), _MORE * _SAMPLES).in_parts()


def test_right_pictures_pass(rng: np.random.Generator) -> None:
    for _ in range(60):
        verdict = compare_estimates(_drawn(rng, _scene(), _SAMPLES), _reference(rng), _SIZE, _MORE, _MAX_NOISE)
        assert verdict.passed, verdict.message


@pytest.mark.parametrize("factor", [0.9, 1.1])
def test_a_picture_that_is_a_little_too_dark_or_bright_is_found(rng: np.random.Generator, factor: float) -> None:
    verdict = compare_estimates(_drawn(rng, factor * _scene(), _SAMPLES), _reference(rng), _SIZE, _MORE, _MAX_NOISE)
    assert not verdict.passed
    assert ("too dark" if factor < 1 else "too bright") in verdict.message


def test_a_small_part_that_is_wrong_is_found_where_it_is(rng: np.random.Generator) -> None:
    light = _scene()
    light[16:24, 24:32] *= 0.5
    verdict = compare_estimates(_drawn(rng, light, _SAMPLES), _reference(rng), _SIZE, _MORE, _MAX_NOISE)
    assert not verdict.passed
    assert verdict.wrong_share == pytest.approx(1 / 24)
    assert "around x=28, y=20" in verdict.message
    assert verdict.deviations is not None
    picture = bias_map(verdict.deviations, (_WIDTH, _HEIGHT))
    assert picture.shape == (_HEIGHT, _WIDTH, 3)
    blue, grey = picture[20, 28].astype(int), picture[4, 4].astype(int)
    assert blue[2] - blue[0] > 60
    assert abs(grey[2] - grey[0]) < 60


def test_a_picture_that_is_right_but_far_noisier_does_not_pass(rng: np.random.Generator) -> None:
    right = _reference(rng)
    noisy = _drawn(rng, _scene(), _SAMPLES, shape=0.2)
    verdict = compare_estimates(noisy, right, _SIZE, _MORE, _MAX_NOISE)
    assert (verdict.passed, verdict.wrong_share) == (False, 0.0)
    told = re.search(r"too noisy: its variance is ([0-9.]+) times", verdict.message)
    assert told is not None
    assert float(told[1]) == pytest.approx(1 / 0.2, rel=0.25)


def test_no_noise_is_wild_enough_to_hide_all_light(rng: np.random.Generator) -> None:
    """Means that are nobody's, in noise that would explain any."""
    height, width, channels = _scene().shape
    samples = 1e4 * rng.choice([-1.0, 1.0], (_SAMPLES, height, width, channels))
    wild = Estimates(samples.mean(axis=0), samples.var(axis=0, ddof=1) / _SAMPLES)
    verdict = compare_estimates(wild, _reference(rng), _SIZE, _MORE, _MAX_NOISE)
    assert not verdict.passed
    assert verdict.wrong_share > 0.9
    assert "too noisy" not in verdict.message


def test_channels_that_changed_places_are_shown_where_they_are(rng: np.random.Generator) -> None:
    light = _scene()
    light[8:16, 8:16] = light[8:16, 8:16][..., ::-1]
    verdict = compare_estimates(_drawn(rng, light, _SAMPLES), _reference(rng), _SIZE, _MORE, _MAX_NOISE)
    assert "around x=12, y=12" in verdict.message


def test_rare_light_that_never_comes_is_not_taken_for_sure(rng: np.random.Generator) -> None:
    """Few pixels catch a bright path that one sample in a thousand follows: who meets none has no noise to show."""
    light = np.full((16, 16, 3), 0.5)

    def drawn(samples: int, share: float) -> Estimates:
        paths = light + 20.0 * (rng.random((samples, *light.shape)) < share)
        return Estimates(paths.mean(axis=0), paths.var(axis=0, ddof=1) / samples)

    right = drawn(_MORE * 16, 1e-3).in_parts()
    without = Estimates(light, np.zeros_like(light))
    part = compare_estimates(without, right, (16, 16), _MORE, _MAX_NOISE)
    assert part.passed, part.message
    many = drawn(256 * 16, 1e-3).in_parts()
    assert not compare_estimates(Estimates(light, light * 0), many, (16, 16), 1, _MAX_NOISE).passed


def test_without_any_noise_only_rounding_may_differ() -> None:
    still = Estimates(_scene(), np.zeros_like(_scene()))
    assert compare_estimates(still, still.in_parts(), _SIZE, _MORE, _MAX_NOISE).passed
    near = Estimates(1.0005 * _scene(), still.variance)
    assert compare_estimates(near, still.in_parts(), _SIZE, _MORE, _MAX_NOISE).passed
    off = Estimates(1.01 * _scene(), still.variance)
    assert not compare_estimates(off, still.in_parts(), _SIZE, _MORE, _MAX_NOISE).passed


def test_no_variance_is_negative(rng: np.random.Generator) -> None:
    mine = _drawn(rng, _scene(), _SAMPLES)
    mine.variance[2, 5, 0] = -1e9
    assert "no finite number" in compare_estimates(mine, _reference(rng), _SIZE, _MORE, _MAX_NOISE).message


@pytest.mark.filterwarnings("error")
def test_parts_of_infinite_light_are_no_numbers_and_no_warning_says_so() -> None:
    light = np.zeros((PART, PART, 3))
    light[0, 0], light[0, 1] = np.inf, -np.inf
    assert np.isnan(Estimates(light, light).in_parts().mean).all()


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_what_is_no_finite_number_is_wrong(rng: np.random.Generator, bad: float) -> None:
    for field in ("mean", "variance"):
        mine = _drawn(rng, _scene(), _SAMPLES)
        getattr(mine, field)[3, 7, 1] = bad
        verdict = compare_estimates(mine, _reference(rng), _SIZE, _MORE, _MAX_NOISE)
        assert not verdict.passed
        assert "no finite number; the first is x=7, y=3" in verdict.message


@pytest.mark.parametrize(("rows", "columns"), [(8, 8), (_HEIGHT - 1, _WIDTH), (_HEIGHT, _WIDTH + 1)])
def test_another_size_is_wrong(rng: np.random.Generator, rows: int, columns: int) -> None:
    """Even where it has as many parts."""
    mine = _drawn(rng, np.ones((rows, columns, 3)), _SAMPLES)
    verdict = compare_estimates(mine, _reference(rng), _SIZE, _MORE, _MAX_NOISE)
    assert f"another size: {columns}x{rows}" in verdict.message


def test_parts_have_the_mean_of_their_pixels() -> None:
    light = np.arange(10 * 9 * 3, dtype=float).reshape(10, 9, 3)
    parts = Estimates(light, np.full_like(light, 2.0)).in_parts()
    assert parts.size == (2, 2)
    assert np.allclose(parts.mean[1, 1], light[PART:, PART:].mean(axis=(0, 1)))
    assert np.allclose(parts.mean[0, 0], light[:PART, :PART].mean(axis=(0, 1)))
    assert np.allclose(parts.variance[0, 0], 2.0 / PART**2)
    assert np.allclose(parts.variance[1, 1], 2.0 / 2)


def test_estimates_are_read_as_they_are_written() -> None:
    light = _scene()
    found = read_estimates(bytes_of(Estimates(light, 2 * light)))
    assert np.allclose(found.mean, light)
    assert np.allclose(found.variance, 2 * light)


def test_a_students_kit_keeps_estimates_as_text() -> None:
    light = _scene().astype(np.float32).astype(np.float64)
    found = from_lists(json.loads(json.dumps(as_lists(Estimates(light, 3 * light)))))
    assert np.allclose(found.mean, light, rtol=1e-7, atol=0)
    assert np.allclose(found.variance, 3 * light, rtol=1e-7, atol=0)


@pytest.mark.parametrize(
    "lists",
    [
        None,
        {},
        {"mean": [[[1, 2, 3]]], "variance": [[[1, 2]]]},
        {"mean": [[[1, 2, 3]]], "variance": [[[1, 2, -1]]]},
        {"mean": [[[1, 2, math.nan]]], "variance": [[[1, 2, 1]]]},
        {"mean": [[[1, 2, 3], [1]]], "variance": [[[1, 2, 3]]]},
        {"mean": [], "variance": []},
    ],
)
def test_other_lists_are_no_estimates(lists: Any) -> None:
    with pytest.raises(EstimatesError):
        from_lists(lists)


@pytest.mark.parametrize("data", [b"", b"P6 1 1 255\n", b"raysteps-estimates 0 1\n", b"raysteps-estimates 2 1\n1234"])
def test_other_bytes_are_no_estimates(data: bytes) -> None:
    with pytest.raises(EstimatesError):
        read_estimates(data)


def test_the_reference_takes_more_samples_of_another_seed() -> None:
    args = ("--step", "12", "--samples", "9", "--filter", "box")
    assert with_samples(args, 4) == ("--step", "12", "--samples", "36", "--filter", "box", "--seed", "11")
    assert samples_of(with_samples(("--step", "12"), 16)) == 256
    seeded = with_samples(("--seed", "8", "--samples", "9"), 4)
    assert seeded == ("--seed", "11", "--samples", "36")


def test_light_is_shown_by_the_curve_of_a_screen() -> None:
    assert as_picture(np.array([[[0.0, 0.214, 5.0]]])).tolist() == [[[0, 127, 255]]]
