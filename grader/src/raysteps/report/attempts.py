"""How a student's own points and pictures came about: a small file beside the report, and a chart of it on the page."""

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from msgspec import Meta
from PIL import Image

from raysteps.common.documents import Amount, plain
from raysteps.common.documents import parse as parse_document
from raysteps.common.files import write_json
from raysteps.common.text import clean, tenths
from raysteps.course.manifest import Step
from raysteps.images.compare import read_png
from raysteps.results.model import ImageResult, Results

HISTORY = "history.json"
_MAX = 40  # attempts that are kept
_WIDTH, _MAX_PNG = 96, 40_000  # of a picture that is kept: pixels, and characters of its base64
_MAX_BYTES = 4 << 20
_NO_PICTURE = ""


@dataclass(frozen=True)
class Attempt:
    """What a check came to, and a small picture of the step that it was of."""

    at: Annotated[str, Meta(pattern=r"^[0-9]{4}-[0-9]{2}-[0-9]{2} [0-9]{2}:[0-9]{2}$")]
    points: Amount
    max: Amount
    picture: Annotated[str, Meta(max_length=200)] = ""  # its name
    png: Annotated[str, Meta(max_length=_MAX_PNG, pattern="^[A-Za-z0-9+/=]*$")] = _NO_PICTURE

    def __post_init__(self) -> None:
        datetime.fromisoformat(self.at)  # the form alone lets a thirteenth month pass


@dataclass(frozen=True)
class AttemptList:
    """The file."""

    schema: Literal["raysteps/history/v1"] = "raysteps/history/v1"
    attempts: list[Attempt] = field(default_factory=list)


def read_attempts(folder: Path) -> list[Attempt]:
    """The oldest first. A file that cannot be read is as good as none: the next check begins anew."""
    path = folder / HISTORY
    try:
        if path.stat().st_size > _MAX_BYTES:
            return []
        return parse_document(path.read_bytes(), AttemptList).attempts[-_MAX:]
    except (OSError, ValueError):
        return []


def _small_png(path: Path) -> str:
    """The picture in few pixels, or nothing where it cannot be read."""
    try:
        whole = Image.fromarray(np.asarray(read_png(path)))
    except (OSError, ValueError):
        return _NO_PICTURE
    height = max(1, round(whole.height * _WIDTH / whole.width))
    data = io.BytesIO()
    whole.resize((_WIDTH, min(height, 2 * _WIDTH))).quantize(64).save(data, format="PNG", optimize=True)
    text = base64.b64encode(data.getvalue()).decode("ascii")
    return text if len(text) <= _MAX_PNG else _NO_PICTURE


def _shown(results: Results, checked: Sequence[str]) -> tuple[str, ImageResult] | None:
    """Of the steps that were checked, the last one's picture: a wrong one if there is any."""
    own = [(step, image) for step in results.steps if step.id in checked for image in step.images if image.mine]
    own.sort(key=lambda pair: (pair[0].id, not pair[1].passed))
    return (f"{own[-1][0].id[:2]} {own[-1][1].name}", own[-1][1]) if own else None


def _thinned(attempts: list[Attempt]) -> list[Attempt]:
    """At most so many: of two attempts that follow each other most closely the earlier one goes, but never the first
    of all."""
    moments = [datetime.fromisoformat(attempt.at) for attempt in attempts]
    while len(attempts) > _MAX:
        gaps = [(moments[at + 1] - moments[at], at) for at in range(1, len(attempts) - 1)]
        _, at = min(gaps)
        del attempts[at], moments[at]
    return attempts


def note_attempt(folder: Path, results: Results, checked: Sequence[str], now: datetime) -> list[Attempt]:
    """Adds what a check of these steps came to, unless it is what the last one came to. `results` are of all steps that
    the report shows."""
    shown = _shown(results, checked)
    name, png = ("", _NO_PICTURE)
    if shown is not None and shown[1].mine is not None:
        name, png = clean(shown[0], 200), _small_png(folder / shown[1].mine)
    most = results.total.max or results.total.bonus.max
    made = Attempt(now.isoformat(sep=" ", timespec="minutes")[:16], results.total.points, most, name, png)
    attempts = read_attempts(folder)
    last = attempts[-1] if attempts else None
    if last is None or (last.points, last.max, last.png) != (made.points, made.max, made.png):
        attempts = _thinned([*attempts, made])
        write_json(folder / HISTORY, plain(AttemptList(attempts=attempts)))
    return attempts


# The chart.

_WIDE, _HIGH, _EDGE = 640, 150, 12


@dataclass(frozen=True)
class ChartDot:
    """One attempt, in the units of the drawing."""

    x: float
    y: float
    at: str
    points: str
    picture: str
    src: str  # of the picture; empty where there is none


@dataclass(frozen=True)
class AttemptChart:
    """A drawing, and what it says in words."""

    width: int
    height: int
    line: str
    dots: Sequence[ChartDot]
    words: str


def chart_of(attempts: Sequence[Attempt]) -> AttemptChart | None:
    """None where there is nothing to compare yet."""
    if len(attempts) < 2:
        return None
    top = max([1.0, *(float(attempt.max) for attempt in attempts), *(float(attempt.points) for attempt in attempts)])
    wide, high = _WIDE - 2 * _EDGE, _HIGH - 2 * _EDGE
    dots = [
        ChartDot(
            round(_EDGE + wide * at / (len(attempts) - 1), 1),
            round(_EDGE + high * (1 - attempt.points / top), 1),
            attempt.at,
            f"{tenths(attempt.points)} of {tenths(attempt.max)}",
            clean(attempt.picture, 200),
            f"data:image/png;base64,{attempt.png}" if attempt.png else "",
        )
        for at, attempt in enumerate(attempts)
    ]
    first, last = dots[0], dots[-1]
    words = f"from {first.points} points on {first.at} to {last.points} on {last.at}, in {len(dots)} checks"
    return AttemptChart(_WIDE, _HIGH, " ".join(f"{dot.x},{dot.y}" for dot in dots), dots, words)


@dataclass(frozen=True)
class OwnProgress:
    """What only the report of one's own steps shows, and none that is handed back."""

    attempts: Sequence[Attempt] = ()
    changed: frozenset[str] = frozenset()  # ids of steps whose files are newer than what the report says of them
    following: Step | None = None  # to do when those in the report are right
    has_reference: bool = False  # the kit beside the report is the whole one: its reader can `replay`
