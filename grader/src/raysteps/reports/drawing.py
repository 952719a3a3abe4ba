"""Where the columns of a histogram stand in a drawing."""

from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.common.text import count
from raysteps.reports.class_statistics import Bar

_ABOVE, _BELOW = 18, 20  # for the numbers on the columns, and for the labels
_GAP = 0.12  # of a column's room


@dataclass(frozen=True)
class Column:
    """In the units of the drawing."""

    x: float
    y: float
    width: float
    height: float
    middle: float
    bar: Bar


@dataclass(frozen=True)
class Histogram:
    """A drawing, and the same in words."""

    width: int
    height: int
    floor: float
    columns: Sequence[Column]
    words: str


def histogram(bars: Sequence[Bar], width: int, height: int, noun: str = "submission") -> Histogram:
    """The highest column reaches the top."""
    floor = height - _BELOW
    most = max((bar.count for bar in bars), default=0) or 1
    room = width / max(len(bars), 1)
    columns = []
    for index, bar in enumerate(bars):
        tall = (floor - _ABOVE) * bar.count / most
        tall = max(tall, 1.5) if bar.count else 0.0
        left = room * (index + _GAP / 2)
        columns.append(
            Column(
                round(left, 2),
                round(floor - tall, 2),
                round(room * (1 - _GAP), 2),
                round(tall, 2),
                round(room * (index + 0.5), 2),
                bar,
            )
        )
    told = "; ".join(f"{bar.words}: {count(bar.count, noun)}" for bar in bars if bar.count)
    return Histogram(width, height, floor, columns, told or "nothing to show")


@dataclass(frozen=True)
class Part:
    """A stretch of a bar that is divided."""

    status: str
    x: float
    width: float


def divided(counts: Sequence[tuple[str, int]], width: float) -> list[Part]:
    """One bar for all, each part as long as its share."""
    whole = sum(amount for _, amount in counts) or 1
    parts, at = [], 0.0
    for status, amount in counts:
        long = width * amount / whole
        if amount:
            parts.append(Part(status, round(at, 2), round(long, 2)))
        at += long
    return parts
