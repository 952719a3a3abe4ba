"""How a student's points came about: in the own checks, with a small file beside the report and a chart of it on the
page; and in what was handed in before.
"""

import base64
import io
from collections.abc import Mapping, Sequence
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
from raysteps.common.text import clean, join_and, signed, tenths
from raysteps.course.manifest import Step
from raysteps.images.compare import read_png
from raysteps.results.model import EarlierSubmission, ImageResult, Results, StepResult
from raysteps.results.statuses import in_words

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


# What was handed in before, and what is better or worse now.

_MAX_SHOWN = 4  # earlier submissions that have a column
_ALIKE = 0.05


@dataclass(frozen=True)
class HistoryRow:
    """A step: its points each time, the oldest first, and what the last change was."""

    step: str
    points: Sequence[str]
    change: str
    tone: str


@dataclass(frozen=True)
class History:
    """Of a submission that was handed in more than once."""

    words: Sequence[str]
    heads: Sequence[str]  # when each was handed in
    rows: Sequence[HistoryRow]


def _graded(step: StepResult) -> float:
    """The grader's points, since those of before are, too: what a person changed is told beside."""
    return step.review.automatic if step.review is not None else step.points


def _graded_in_all(results: Results) -> float:
    return sum(map(_graded, results.steps))


def _changed_by_hand(results: Results) -> bool:
    reviews = [results.review, *(step.review for step in results.steps)]
    return any(review.overrides for review in reviews if review is not None)


def _when(one: EarlierSubmission) -> str:
    shown = clean(one.submitted_at or one.graded_at, 40).replace("T", " ")[:16]
    return f"{shown}, by the time of the file" if one.submitted_at and one.by_file else shown


def _change(change: float) -> str:
    return "=" if abs(change) < _ALIKE else signed(change, tenths)


def _moved(results: Results, titles: Mapping[str, str], direction: int) -> list[str]:
    last = results.earlier[-1].steps
    return [
        f"{titles[step.id]} from {tenths(last[step.id].points)} to {tenths(_graded(step))}"
        + (f" ({in_words(step.status)})" if step.status in ("does-not-build", "crashed", "timeout") else "")
        for step in results.steps
        if step.id in last and direction * (_graded(step) - last[step.id].points) >= _ALIKE
    ]


def history_words(results: Results, titles: Mapping[str, str]) -> list[str]:
    """What changed since the last time, in sentences; nothing where nothing was handed in before. `titles` by step."""
    if not results.earlier:
        return []
    times = [f"{tenths(one.points)} points ({_when(one)})" for one in results.earlier[-_MAX_SHOWN:]]
    amount = (results.earlier[-1].number or len(results.earlier)) + 1
    last = ", most recently" if amount - 1 > len(times) else ""
    now = tenths(_graded_in_all(results))
    lines = [f"You have handed in {amount} times{last}: {', then '.join(times)}, and {now} now."]
    if _changed_by_hand(results):
        lines.append("All points here are by the grader, before your instructor changed some.")
    better, worse = (_moved(results, titles, direction) for direction in (1, -1))
    lines += [f"Better than the last time: {join_and(better)}."] if better else []
    lines += [f"Worse than the last time: {join_and(worse)}."] if worse else []
    lines += [] if better or worse else ["No step has other points than the last time."]
    if not results.earlier[-1].same_grading:
        lines.append("The grading itself was changed in between: not every difference need come from your work.")
    return lines


def history_of(results: Results, titles: Mapping[str, str]) -> History | None:
    """The same as a table as well; None where nothing was handed in before."""
    earlier = results.earlier[-_MAX_SHOWN:]
    if not earlier:
        return None
    rows = []
    for step in results.steps:
        then = [one.steps.get(step.id) for one in earlier]
        points = [tenths(found.points) if found is not None else "" for found in then]
        change = _graded(step) - then[-1].points if then[-1] is not None else 0.0
        tone = "good" if change >= _ALIKE else "bad" if change <= -_ALIKE else ""
        shown = _change(change) if then[-1] is not None else ""
        rows.append(HistoryRow(titles[step.id], [*points, tenths(_graded(step))], shown, tone))
    now = _graded_in_all(results)
    total = [*(tenths(one.points) for one in earlier), tenths(now)]
    rows.append(HistoryRow("in all", total, _change(now - earlier[-1].points), ""))
    return History(history_words(results, titles), [_when(one) for one in earlier], rows)
