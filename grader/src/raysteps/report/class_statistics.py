"""Figures of a class: how points and times are spread, step by step and in all."""

import math
import statistics
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from raysteps.common.text import count, number
from raysteps.results.class_model import ClassResults, GradedSubmission

_BARS = 14
_SLOWEST = 5


@dataclass(frozen=True)
class Bar:
    """One column of a histogram."""

    label: str  # under the column
    words: str  # what falls into it, in words
    count: int


@dataclass(frozen=True)
class StepFigures:
    """One step of all submissions that were graded."""

    id: str
    title: str
    max: float
    bonus: bool
    statuses: Mapping[str, int]
    mean: float | None
    median: float | None
    bars: Sequence[Bar]

    @property
    def graded(self) -> int:
        return sum(self.statuses.values())

    @property
    def passed(self) -> int:
        return self.statuses.get("passed", 0)


@dataclass(frozen=True)
class Times:
    """Seconds that grading took."""

    total: float
    mean: float
    median: float
    slowest: Sequence[tuple[int, float]]  # which submission, and its seconds


def span(seconds: float) -> str:
    """`44.3 s`, `2 min 13 s`, `3 h 5 min`."""
    whole = round(seconds)
    if whole < 100:
        return f"{seconds:.1f} s"
    hours, minutes = whole // 3600, whole % 3600 // 60
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {whole % 60} s"


def graded(document: ClassResults) -> list[GradedSubmission]:
    """Those whose points count: not those from which nothing could be taken."""
    return [one for one in document.submissions if one.status == "graded"]


def mean(values: Sequence[float]) -> float | None:
    return round(statistics.fmean(values), 2) if values else None


def median(values: Sequence[float]) -> float | None:
    return round(statistics.median(values), 2) if values else None


def _width(top: float) -> float:
    """Of a column: 1, 2, 5, 10, 20, 50, ... points, so that there are few of them."""
    exponent = 0
    while True:
        for base in (1, 2, 5):
            if math.ceil(top / (base * 10**exponent)) <= _BARS:
                return float(base * 10**exponent)
        exponent += 1


def total_bars(values: Sequence[float], top: float) -> list[Bar]:
    """Of all points, from 0 to `top`; whoever has exactly `top` is in the last column."""
    width = _width(max(top, *values, 1.0))
    columns = math.ceil(max(top, *values, 1.0) / width)
    counts = Counter(min(int(value / width), columns - 1) for value in values)
    edges = [(index * width, (index + 1) * width) for index in range(columns)]
    last = columns - 1
    return [
        Bar(
            number(low),
            f"{number(low)} to {number(high)}" if index == last else f"{number(low)} to under {number(high)}",
            counts[index],
        )
        for index, (low, high) in enumerate(edges)
    ]


_SHARES = (("0", "no points"), ("", "up to a quarter"), ("", "up to a half"), ("", "up to three quarters"))
_MAX = (("", "nearly all"), ("all", "all points"))


def share_bars(values: Sequence[float], top: float) -> list[Bar]:
    """Of one step: none, four columns between, and all of its points."""
    counts: Counter[int] = Counter()
    for value in values:
        share = value / top if top else 1.0
        counts[0 if share <= 0 else 5 if share >= 1 else min(4, math.ceil(share * 4))] += 1
    return [Bar(label, words, counts[index]) for index, (label, words) in enumerate((*_SHARES, *_MAX))]


def step_figures(document: ClassResults) -> list[StepFigures]:
    """In the order of the steps."""
    figures = []
    for step in document.steps:
        found = [one.steps[step.id] for one in graded(document) if step.id in one.steps]
        points = [result.points for result in found]
        statuses = Counter(result.status for result in found)
        bars = share_bars(points, step.points)
        figures.append(
            StepFigures(step.id, step.title, step.points, step.bonus, statuses, mean(points), median(points), bars)
        )
    return figures


def times(document: ClassResults) -> Times | None:
    """None where no time is known, as in the files of an older kit."""
    known = [(index, one.seconds) for index, one in enumerate(document.submissions) if one.seconds]
    if not known:
        return None
    seconds = [value for _, value in known]
    slowest = sorted(known, key=lambda item: (-item[1], item[0]))[:_SLOWEST]
    return Times(sum(seconds), statistics.fmean(seconds), statistics.median(seconds), slowest)


# Where the columns of a histogram stand in a drawing.

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
class HistogramDrawing:
    """A drawing, and the same in words."""

    width: int
    height: int
    floor: float
    columns: Sequence[Column]
    words: str


def histogram(bars: Sequence[Bar], width: int, height: int, noun: str = "submission") -> HistogramDrawing:
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
    return HistogramDrawing(width, height, floor, columns, told or "nothing to show")


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
