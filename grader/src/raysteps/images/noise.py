"""Noisy pictures: of light that is drawn by chance no two right programs get the same pixels. What they agree in are
means. `raytrace --estimates` tells of each pixel the mean light of its samples and the variance of that mean; the judge
takes the means of parts of the picture, where chance weighs less, and asks whether a difference can be chance at all.

The errors are fixed in advance. A right picture is called wrong where one of some hundred means is more than 7.5
standard deviations off, which a normal variable is with a probability of 6e-14; and where its noise is far above the
reference's.
"""

import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from raysteps.course.manifest import with_option
from raysteps.images.compare import Comparison, Pixels

Light = npt.NDArray[np.float64]

PART = 8  # pixels along a side of a part
_DEVIATIONS = 7.5
_RELATIVE, _ABSOLUTE = 2e-3, 5e-4  # of light: what thresholds and the order of sums may change
_HEADER = re.compile(rb"raysteps-estimates ([1-9][0-9]{0,4}) ([1-9][0-9]{0,4})\n")
_FLOATS = 6  # of a pixel


class EstimatesError(ValueError):
    """Bytes that are no estimates."""


@dataclass(frozen=True)
class Estimates:
    """Rows, columns and channels: mean light, and the variance of that mean."""

    mean: Light
    variance: Light

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows."""
        return self.mean.shape[1], self.mean.shape[0]

    def in_parts(self) -> "Estimates":
        """Of parts of PART x PART pixels, smaller at the right and below. Samples of different pixels have nothing to
        do with each other, so that variances add up."""
        rows, columns = (np.arange(0, length, PART) for length in self.mean.shape[:2])

        def sums(values: Light) -> Light:
            return np.asarray(np.add.reduceat(np.add.reduceat(values, rows, axis=0), columns, axis=1))

        pixels = sums(np.ones((*self.mean.shape[:2], 1)))
        with np.errstate(all="ignore"):  # of infinite light, which is told elsewhere
            return Estimates(sums(self.mean) / pixels, sums(self.variance) / pixels**2)


def read_estimates(data: bytes) -> Estimates:
    """The bytes of `raytrace --estimates`; the size is checked before it is believed."""
    header = _HEADER.match(data)
    if header is None:
        raise EstimatesError("no estimates were written")
    width, height = int(header[1]), int(header[2])
    if len(data) - header.end() != 4 * _FLOATS * width * height:
        raise EstimatesError("the estimates' size does not fit their header")
    values = np.frombuffer(data, dtype="<f4", offset=header.end()).reshape(height, width, 2, 3).astype(np.float64)
    return Estimates(values[:, :, 0], values[:, :, 1])


def as_lists(estimates: Estimates) -> dict[str, Any]:
    """For JSON, to as many digits as a float has."""

    def rounded(light: Light) -> Any:
        return [[[float(f"{channel:.9g}") for channel in part] for part in row] for row in light]

    return {"mean": rounded(estimates.mean), "variance": rounded(estimates.variance)}


def from_lists(lists: Any) -> Estimates:
    """What `as_lists` wrote."""
    try:
        mean, variance = (np.array(lists[name], dtype=np.float64) for name in ("mean", "variance"))
    except (KeyError, TypeError, ValueError) as error:
        raise EstimatesError("expected the means and variances of parts") from error
    if mean.ndim != 3 or mean.shape != variance.shape or mean.shape[2] != 3 or not mean.size:
        raise EstimatesError("expected as many variances as means, three for each part")
    if not np.isfinite([mean, variance]).all() or (variance < 0).any():
        raise EstimatesError("expected numbers, and variances of 0 or more")
    return Estimates(mean, variance)


def samples_of(args: tuple[str, ...]) -> int:
    """How many each pixel gets, by the arguments of `raytrace`."""
    return int(args[args.index("--samples") + 1]) if "--samples" in args else 16


def with_samples(args: tuple[str, ...], factor: int) -> tuple[str, ...]:
    """The arguments of the same picture with `factor`, a square, times as many samples, drawn from another seed."""
    return with_option(with_option(args, "--samples", str(factor * samples_of(args))), "--seed", "11")


def as_picture(light: Light) -> Pixels:
    """By sRGB's curve (IEC 61966-2-1)."""
    channel = np.clip(np.nan_to_num(light), 0.0, 1.0)
    encoded = np.where(channel <= 0.0031308, 12.92 * channel, 1.055 * np.power(channel, 1 / 2.4) - 0.055)
    return np.asarray(np.round(255 * encoded), dtype=np.uint8)


@dataclass(frozen=True)
class NoisyComparison(Comparison):
    """`deviations`: how far each part is off, in standard deviations, negative where it is too dark."""

    deviations: Light | None = None


def _off(mine: Estimates, right: Estimates, factor: float, most_noise: float) -> tuple[Light, Light]:
    """How far each channel of each part is off, and how far it may be. The noise is the larger one of the two: who
    never meets a rare bright path must not pass for sure. But no more of it counts than a picture may have: else all
    means would pass in noise that is wild enough."""
    allowed = most_noise * factor * np.maximum(right.variance, right.variance.mean(axis=(0, 1)))
    own = np.maximum(np.minimum(mine.variance, allowed), factor * right.variance)
    noise = np.sqrt(own + right.variance)
    return mine.mean - right.mean, _DEVIATIONS * noise + _RELATIVE * np.abs(right.mean) + _ABSOLUTE


def _numbers(light: Light) -> str:
    return "(" + ", ".join(f"{channel:.3g}" for channel in light) + ")"


def _whole(parts: Estimates, size: tuple[int, int]) -> Estimates:
    """Of the whole picture, from its parts."""
    width, height = size
    rows = np.minimum(PART, height - PART * np.arange(parts.size[1]))
    columns = np.minimum(PART, width - PART * np.arange(parts.size[0]))
    weights = np.outer(rows, columns)[:, :, None] / (width * height)
    mean = (weights * parts.mean).sum(axis=(0, 1), keepdims=True)
    return Estimates(mean, (weights**2 * parts.variance).sum(axis=(0, 1), keepdims=True))


def compare_estimates(
    mine: Estimates, parts: Estimates, size: tuple[int, int], factor: float, max_noise: float
) -> NoisyComparison:
    """Passes when all means are right but for chance, and the noise is at most `max_noise` times the reference's.
    `parts`: the reference's, of the same scene and `size` in parts, with `factor` times as many samples for each pixel.
    The wrong share is that of the parts."""
    if mine.size != size:
        width, height = mine.size
        return NoisyComparison(False, 1.0, f"The picture has another size: {width}x{height} pixels.")
    values = np.concatenate([mine.mean, mine.variance], axis=2)
    lost = ~np.isfinite(values).all(axis=2) | (mine.variance < 0).any(axis=2)
    if lost.any():
        y, x = (int(index) for index in np.argwhere(lost)[0])
        message = f"{lost.mean():.2%} of the pixels have light that is no finite number; the first is x={x}, y={y}."
        return NoisyComparison(False, float(lost.mean()), message)
    own = mine.in_parts()
    off, most = _off(own, parts, factor, max_noise)
    wrong = (np.abs(off) > most).any(axis=2)
    channel = np.abs(off / most).argmax(axis=2)[..., None]
    deviations = _DEVIATIONS * np.take_along_axis(off / most, channel, axis=2)[..., 0]
    all_mine, all_right = _whole(own, mine.size), _whole(parts, mine.size)
    all_off, all_most = _off(all_mine, all_right, factor, max_noise)
    share = float(wrong.mean())
    if (np.abs(all_off) > all_most).any():
        how = "dark" if all_off.sum() < 0 else "bright"
        message = (
            f"The picture is too {how}: its mean light is {_numbers(all_mine.mean[0, 0])}, "
            f"expected {_numbers(all_right.mean[0, 0])}; chance explains at most {float(all_most.max()):.2g} of that."
        )
        return NoisyComparison(False, max(share, 1 / wrong.size), message, deviations)
    if wrong.any():
        row, column = (int(index) for index in np.unravel_index(int(np.abs(deviations).argmax()), wrong.shape))
        message = (
            f"The light of {share:.2%} of the picture is wrong by more than chance explains; farthest off is the part "
            f"around x={PART * column + PART // 2}, y={PART * row + PART // 2}: its mean light is "
            f"{_numbers(own.mean[row, column])}, expected {_numbers(parts.mean[row, column])}."
        )
        return NoisyComparison(False, share, message, deviations)
    noise = _ratio(all_mine, all_right, factor)
    if noise > max_noise:
        message = (
            f"The picture is too noisy: its variance is {noise:.3g} times the reference's with as many samples; at "
            f"most {max_noise:.3g} times is expected. Its mean light is right, as far as that can be told."
        )
        return NoisyComparison(False, 0.0, message, deviations)
    return NoisyComparison(True, 0.0, "", deviations)


def _ratio(all_mine: Estimates, all_right: Estimates, factor: float) -> float:
    """The variance of the whole picture beside the reference's, for as many samples."""
    own, right = float(all_mine.variance.sum()), float(all_right.variance.sum())
    return own / (factor * right) if right > 0 else math.inf if own > 0 else 1.0


_VISIBLE = 10  # of 255


def visibly_wrong_share(mine: Pixels, right: Pixels) -> float:
    """The share of the parts whose mean colour is off by more than the eye overlooks; for pages that show pictures."""
    off = [Estimates(light, light).in_parts().mean for light in (np.asarray(mine, float), np.asarray(right, float))]
    return float((np.abs(off[0] - off[1]).max(axis=2) > _VISIBLE).mean())


def bias_map(deviations: Light, size: tuple[int, int]) -> Pixels:
    """A picture of that size: grey where a part is right but for chance, red where it is too bright, blue where it is
    too dark."""
    width, height = size
    strength = np.clip(np.abs(deviations) / _DEVIATIONS, 0.0, 2.0)[..., None] / 2
    color = np.where((deviations > 0)[..., None], np.array([220.0, 40.0, 30.0]), np.array([40.0, 80.0, 230.0]))
    parts = np.round((1 - strength) * 128.0 + strength * color).astype(np.uint8)
    return np.asarray(parts.repeat(PART, axis=0).repeat(PART, axis=1)[:height, :width])
