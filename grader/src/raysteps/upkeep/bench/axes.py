"""Axes: from numbers to places on paper, and where the ticks stand."""

import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Axis:
    """What one side of a chart shows. Logarithmic axes hold numbers above 0 only."""

    label: str
    low: float
    high: float
    log: bool = False

    def share(self, value: float) -> float:
        """0 at the low end, 1 at the high end."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def ticks(self) -> list[float]:
        """Round numbers from end to end."""
        if self.log:
            return _powers(self.low, self.high)
        step = _round_step((self.high - self.low) / 5)
        first, last = math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9)
        return [number * step for number in range(first, last + 1)]


def _powers(low: float, high: float) -> list[float]:
    first, last = math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9)
    powers = [10.0**exponent for exponent in range(first, last + 1)]
    if len(powers) >= 3:
        return powers
    fine = [factor * 10.0**exponent for exponent in range(first - 1, last + 1) for factor in (1, 2, 5)]
    return [value for value in fine if low * (1 - 1e-9) <= value <= high * (1 + 1e-9)]


def _round_step(least: float) -> float:
    power: float = 10.0 ** math.floor(math.log10(least))
    return next(factor * power for factor in (1, 2, 5, 10) if factor * power >= least * (1 - 1e-9))


def linear_axis(label: str, values: Sequence[float]) -> Axis:
    """From 0 to a round number above all values."""
    most = max(values, default=0.0) or 1.0
    step = _round_step(most / 5)
    return Axis(label, 0.0, step * math.ceil(most / step - 1e-9))


def log_axis(label: str, values: Sequence[float]) -> Axis:
    """Around all values, with a little room, so that no point stands on an edge."""
    low, high = min(values), max(values)
    return Axis(label, low / 1.3, high * 1.3, log=True)


def tick_text(value: float) -> str:
    """Short: 1000000 is 1M."""
    for size, letter in ((1e6, "M"), (1e3, "k")):
        if abs(value) >= size:
            return f"{value / size:.3g}{letter}"
    return f"{value:.3g}"
