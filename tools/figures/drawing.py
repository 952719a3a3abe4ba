"""Diagrams as SVG on a plate of their own, so that they are readable on light and on dark pages."""

import math
from collections.abc import Sequence
from xml.sax.saxutils import escape, quoteattr

Point = tuple[float, float]

# Lines and letters: ink, muted, and three colours that most colour-blind readers tell apart (after Okabe and Ito).
_STYLE = """.plate{fill:#fff;stroke:#d0d7de}
text{font:14px system-ui,sans-serif;fill:#24292f}
.small{font-size:12px}.strong{font-weight:600}.math{font-family:Georgia,serif;font-style:italic;font-size:16px}
.l{fill:none;stroke-width:1.6;stroke-linecap:round;stroke-linejoin:round}
.thin{stroke-width:1}.thick{stroke-width:2.6}.dash{stroke-dasharray:5 5}
.ink{stroke:#24292f}.muted{stroke:#8c959f}.blue{stroke:#0969da}.red{stroke:#c2410c}.green{stroke:#1a7f37}
.f-ink{fill:#24292f}.f-muted{fill:#8c959f}.f-blue{fill:#0969da}.f-red{fill:#c2410c}.f-green{fill:#1a7f37}
.t-muted{fill:#57606a}.t-blue{fill:#0969da}.t-red{fill:#c2410c}.t-green{fill:#1a7f37}
.w-grey{fill:#8c959f;fill-opacity:.16}.w-blue{fill:#0969da;fill-opacity:.14}
.w-red{fill:#c2410c;fill-opacity:.14}.w-green{fill:#1a7f37;fill-opacity:.16}.w-paper{fill:#fff}
@media (prefers-color-scheme:dark){.plate{fill:#161b22;stroke:#30363d}text{fill:#e6edf3}
.ink{stroke:#e6edf3}.blue{stroke:#58a6ff}.red{stroke:#ff9b5c}.green{stroke:#56d364}
.f-ink{fill:#e6edf3}.f-blue{fill:#58a6ff}.f-red{fill:#ff9b5c}.f-green{fill:#56d364}
.t-muted{fill:#9ea7b3}.t-blue{fill:#58a6ff}.t-red{fill:#ff9b5c}.t-green{fill:#56d364}.w-paper{fill:#161b22}}"""
_HEAD = 9.0  # length of an arrow's head


def _n(value: float) -> str:
    text = f"{value:.1f}"
    return "0" if text in ("0.0", "-0.0") else text.removesuffix(".0")


def toward(start: Point, end: Point, length: float) -> Point:
    """The point that lies so far from start on the way to end."""
    way = math.hypot(end[0] - start[0], end[1] - start[1])
    return start[0] + (end[0] - start[0]) * length / way, start[1] + (end[1] - start[1]) * length / way


def polar(center: Point, degrees: float, radius: float) -> Point:
    """Counted from the right, upwards, as in a mathematics book; on paper y runs down."""
    angle = math.radians(degrees)
    return center[0] + radius * math.cos(angle), center[1] - radius * math.sin(angle)


class Drawing:
    """Elements in the order in which they were drawn. `kind` is a list of the classes above."""

    def __init__(self, width: float, height: float, title: str, description: str) -> None:
        self._size = (width, height)
        self._title, self._description = title, description
        self._parts: list[str] = []

    def line(self, start: Point, end: Point, kind: str = "ink") -> None:
        ends = f'x1="{_n(start[0])}" y1="{_n(start[1])}" x2="{_n(end[0])}" y2="{_n(end[1])}"'
        self._parts.append(f'<line class="l {kind}" {ends}/>')

    def arrow(self, start: Point, end: Point, kind: str = "ink") -> None:
        """A line with a filled head in the colour that `kind` names first."""
        base = toward(end, start, _HEAD)
        side = ((end[1] - base[1]) * 0.42, (base[0] - end[0]) * 0.42)
        self.line(start, base, kind)
        corners = [end, (base[0] + side[0], base[1] + side[1]), (base[0] - side[0], base[1] - side[1])]
        points = " ".join(f"{_n(x)},{_n(y)}" for x, y in corners)
        self._parts.append(f'<polygon class="f-{kind.split()[0]}" points="{points}"/>')

    def dot(self, place: Point, color: str = "ink", radius: float = 3.5) -> None:
        self._parts.append(f'<circle class="f-{color}" cx="{_n(place[0])}" cy="{_n(place[1])}" r="{_n(radius)}"/>')

    def circle(self, center: Point, radius: float, kind: str = "l ink") -> None:
        self._parts.append(f'<circle class="{kind}" cx="{_n(center[0])}" cy="{_n(center[1])}" r="{_n(radius)}"/>')

    def rect(self, corner: Point, width: float, height: float, kind: str = "l ink") -> None:
        size = f'width="{_n(width)}" height="{_n(height)}"'
        self._parts.append(f'<rect class="{kind}" x="{_n(corner[0])}" y="{_n(corner[1])}" {size}/>')

    def polygon(self, corners: Sequence[Point], kind: str = "l ink") -> None:
        points = " ".join(f"{_n(x)},{_n(y)}" for x, y in corners)
        self._parts.append(f'<polygon class="{kind}" points="{points}"/>')

    def curve(self, points: Sequence[Point], kind: str = "ink") -> None:
        """Through all points, open at its ends."""
        text = " ".join(f"{_n(x)},{_n(y)}" for x, y in points)
        self._parts.append(f'<polyline class="l {kind}" points="{text}"/>')

    def arc(self, center: Point, radius: float, start: float, end: float, kind: str = "muted thin") -> None:
        """From one angle to the other, in degrees."""
        count = max(2, int(abs(end - start) / 4))
        self.curve([polar(center, start + (end - start) * i / count, radius) for i in range(count + 1)], kind)

    def text(self, place: Point, words: str, kind: str = "", anchor: str = "start") -> None:
        """Where it begins, ends or has its middle: anchor is start, end or middle."""
        name = f' class="{kind}"' if kind else ""
        at = f'x="{_n(place[0])}" y="{_n(place[1])}" text-anchor="{anchor}"'
        self._parts.append(f"<text{name} {at}>{escape(words)}</text>")

    def svg(self) -> str:
        width, height = (_n(side) for side in self._size)
        head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}"'
        head += f' height={quoteattr(height)} role="img" aria-labelledby="title description">'
        titles = f'<title id="title">{escape(self._title)}</title>'
        titles += f'<desc id="description">{escape(self._description)}</desc>'
        inner = (_n(self._size[0] - 1), _n(self._size[1] - 1))
        plate = f'<rect class="plate" x="0.5" y="0.5" width="{inner[0]}" height="{inner[1]}" rx="8"/>'
        return "\n".join([head, titles, f"<style>{_STYLE}</style>", plate, *self._parts, "</svg>"]) + "\n"
