"""Charts as SVG, readable on light and on dark paper."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from xml.sax.saxutils import escape

# Axes: from numbers to places on paper, and where the ticks stand.


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


# Told apart by most colour-blind readers too (Okabe and Ito), and visible on white as on black.
_COLORS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a8a8a", "#b58900", "#56b4e9", "#a0522d")
_WIDTH, _HEIGHT = 380.0, 300.0
_LEFT, _RIGHT, _TOP, _BOTTOM = 62.0, 14.0, 34.0, 48.0
_LEGEND_LINE, _LEGEND_COLUMN = 18.0, 135.0
_STYLE = """text{font:12px system-ui,sans-serif;fill:#24292f}
.grid{stroke:#d0d7de;stroke-width:1}.axis{stroke:#57606a;stroke-width:1.2;fill:none}
.title{font-weight:600;font-size:13px}
@media (prefers-color-scheme:dark){text{fill:#e6edf3}.grid{stroke:#30363d}.axis{stroke:#8b949e}}"""


@dataclass(frozen=True)
class Series:
    """Points of one colour, joined by lines; or the heights of bars, one for each group."""

    name: str
    points: list[tuple[float, float]]
    marked: bool = True  # a dot at each point; none where the line is a formula


@dataclass(frozen=True)
class Chart:
    """Lines over x, or bars in groups where `groups` names them (x is then the place of the group)."""

    title: str
    x: Axis
    y: Axis
    series: list[Series]
    groups: tuple[str, ...] = ()


def _text(x: float, y: float, text: str, anchor: str = "middle", more: str = "") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(text)}</text>'


def _line(kind: str, x1: float, y1: float, x2: float, y2: float) -> str:
    return f'<line class="{kind}" x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"/>'


@dataclass(frozen=True)
class _Panel:
    """One chart and where it stands."""

    chart: Chart
    left: float
    width: float

    def x(self, value: float) -> float:
        return self.left + _LEFT + self.chart.x.share(value) * (self.width - _LEFT - _RIGHT)

    def y(self, value: float) -> float:
        return _HEIGHT - _BOTTOM - self.chart.y.share(value) * (_HEIGHT - _TOP - _BOTTOM)

    def frame(self) -> Iterator[str]:
        chart = self.chart
        left, right, bottom = self.left + _LEFT, self.left + self.width - _RIGHT, _HEIGHT - _BOTTOM
        for value in chart.y.ticks():
            yield _line("grid", left, self.y(value), right, self.y(value))
            yield _text(left - 7, self.y(value) + 4, tick_text(value), "end")
        for value in [] if chart.groups else chart.x.ticks():
            yield _line("grid", self.x(value), _TOP, self.x(value), bottom)
            yield _text(self.x(value), bottom + 17, tick_text(value))
        for place, name in enumerate(chart.groups):
            yield _text(self.x(place), bottom + 17, name)
        yield f'<path class="axis" d="M{left:.1f} {_TOP:.1f}V{bottom:.1f}H{right:.1f}"/>'
        yield _text((left + right) / 2, 18, chart.title, more=' class="title"')
        yield _text((left + right) / 2, bottom + 38, chart.x.label)
        middle = (_TOP + bottom) / 2
        turn = f' transform="rotate(-90 {self.left + 16:.1f} {middle:.1f})"'
        yield _text(self.left + 16, middle, chart.y.label, more=turn)

    def lines(self) -> Iterator[str]:
        for number, series in enumerate(self.chart.series):
            color = _COLORS[number % len(_COLORS)]
            places = [(self.x(x), self.y(y)) for x, y in series.points]
            path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
            yield f'<polyline fill="none" stroke="{color}" stroke-width="2" points="{path}"/>'
            for x, y in places if series.marked else []:
                yield f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.2" fill="{color}"/>'

    def bars(self) -> Iterator[str]:
        bottom = self.y(self.chart.y.low)
        room = abs(self.x(1) - self.x(0)) * 0.8
        width = room / max(1, len(self.chart.series))
        for number, series in enumerate(self.chart.series):
            color = _COLORS[number % len(_COLORS)]
            for place, value in series.points:
                x, y = self.x(place) - room / 2 + number * width, self.y(value)
                size = f'width="{width - 1:.1f}" height="{bottom - y:.1f}"'
                yield f'<rect x="{x:.1f}" y="{y:.1f}" {size} fill="{color}"/>'


def _legend(names: Sequence[str], columns: int) -> Iterator[str]:
    for number, name in enumerate(names):
        x = _LEFT + _LEGEND_COLUMN * (number % columns)
        y = _HEIGHT + _LEGEND_LINE * (number // columns + 0.7)
        color = _COLORS[number % len(_COLORS)]
        yield f'<rect x="{x:.1f}" y="{y - 9:.1f}" width="10" height="10" rx="2" fill="{color}"/>'
        yield _text(x + 15, y, name, "start")


def _plate(width: float, height: float) -> list[str]:
    """Paper of its own, in the reader's light or dark."""
    style = ".plate{fill:#fff;stroke:#d0d7de}"
    style += "@media (prefers-color-scheme:dark){.plate{fill:#161b22;stroke:#30363d}}"
    rect = f'<rect class="plate" x="0.5" y="0.5" width="{width - 1:.0f}" height="{height - 1:.0f}" rx="8"/>'
    return [f"<style>{style}</style>", rect]


def svg_text(charts: Sequence[Chart], *, width: float = _WIDTH, description: str = "", plate: bool = False) -> str:
    """Charts side by side. They share one legend, so all have the same series in the same order."""
    names = [series.name for series in charts[0].series]
    parts: list[str] = []
    for number, chart in enumerate(charts):
        panel = _Panel(chart, number * width, width)
        parts += [*panel.frame(), *(panel.bars() if chart.groups else panel.lines())]
    columns = max(1, int((width * len(charts) - _LEFT) / _LEGEND_COLUMN))
    height = _HEIGHT + _LEGEND_LINE * (-(-len(names) // columns) + 0.7)
    size = f"{width * len(charts):.0f} {height:.0f}"
    if plate:
        parts = [*_plate(width * len(charts), height), *parts]
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}" role="img">'
    title = f"<title>{escape('; '.join(chart.title for chart in charts))}</title>"
    if description:
        title += f"<desc>{escape(description)}</desc>"
    return "\n".join([head, title, f"<style>{_STYLE}</style>", *parts, *_legend(names, columns), "</svg>"]) + "\n"
