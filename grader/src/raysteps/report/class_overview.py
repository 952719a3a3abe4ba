"""What the page of a class says beside its table: how points and times are spread, and what needs a person's eye."""

import math
import statistics
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from raysteps.common.text import count, first_line, number, tenths
from raysteps.results.class_model import ClassResults, GradedSubmission, NotedStudent

_BARS = 14
_SLOWEST = 5


@dataclass(frozen=True)
class Bar:
    """One column of a histogram."""

    label: str  # under the column; where there is an end, at its left edge
    words: str  # what falls into it, in words
    count: int
    end: str = ""  # at its right edge


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
    """Those whose points count: not those that could not be read."""
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
            number(high),
        )
        for index, (low, high) in enumerate(edges)
    ]


_SHARES = (("none", "no points"), ("≤ ¼", "up to a quarter"), ("≤ ½", "up to a half"), ("≤ ¾", "up to three quarters"))
_MAX = (("< all", "nearly all"), ("all", "all points"))


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
        found = [one for one in graded(document) if step.id in one.steps]
        points = [one.steps[step.id].points for one in found]
        statuses = Counter(one.shown_status(step.id) for one in found)
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

_ABOVE, _BELOW = 18, 40  # for the numbers on the columns; for the labels, and what they are of
_GAP = 0.12  # of a column's room


@dataclass(frozen=True)
class Column:
    """In the units of the drawing."""

    x: float
    y: float
    width: float
    height: float
    middle: float
    left: float  # edges of its room
    right: float
    bar: Bar


@dataclass(frozen=True)
class HistogramDrawing:
    """A drawing, and the same in words."""

    width: int
    height: int
    floor: float
    columns: Sequence[Column]
    axis: str  # what stands below the columns
    words: str


def histogram(bars: Sequence[Bar], width: int, height: int, axis: str) -> HistogramDrawing:
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
                round(room * index, 2),
                round(room * (index + 1), 2),
                bar,
            )
        )
    told = "; ".join(f"{bar.words}: {count(bar.count, 'submission')}" for bar in bars if bar.count)
    return HistogramDrawing(width, height, floor, columns, axis, told or "nothing to show")


@dataclass(frozen=True)
class BarSegment:
    """A stretch of a bar that is divided."""

    status: str
    x: float
    width: float


def divided(counts: Sequence[tuple[str, int]], width: float) -> list[BarSegment]:
    """One bar for all, each part as long as its share."""
    whole = sum(amount for _, amount in counts) or 1
    parts, at = [], 0.0
    for status, amount in counts:
        long = width * amount / whole
        if amount:
            parts.append(BarSegment(status, round(at, 2), round(long, 2)))
        at += long
    return parts


# What needs a person's eye in a class, apart from the table.

Severity = Literal["bad", "warn", "note"]


@dataclass(frozen=True)
class Notice:
    """A submission by its place in the list, or somebody who has none; and what there is to say."""

    row: int | None
    who: str
    words: Sequence[str]


@dataclass(frozen=True)
class Group:
    """Submissions with the same thing to look at."""

    mark: str  # in the table; empty where the table says nothing
    weight: Severity
    heading: str
    why: str
    items: Sequence[Notice]


def _points(value: float | None) -> str:
    return "no points" if value is None else tenths(value)


def has_unread_files(one: GradedSubmission) -> bool:
    return one.status == "graded" and bool(one.not_taken)


def is_late_by_file(one: GradedSubmission) -> bool:
    return one.submitted_from == "files" and one.late is not None and one.late.days > 0


class _Finder:
    def __init__(self, document: ClassResults) -> None:
        self._document = document
        self._rows = {one.name: (row, one) for row, one in enumerate(document.submissions)}

    def _item(self, name: str, words: Sequence[str]) -> Notice:
        found = self._rows.get(name)
        return Notice(found[0] if found else None, name, words)

    def _of(self, names: Sequence[str]) -> list[tuple[str, GradedSubmission]]:
        return [(name, self._rows[name][1]) for name in names if name in self._rows]

    def faults(self) -> list[Notice]:
        return [self._item(name, [first_line(one.fault)]) for name, one in self._of(self._document.faults)]

    def unreadable(self) -> list[Notice]:
        return [self._item(name, one.why_unread) for name, one in self._of(self._document.unreadable)]

    def not_taken(self) -> list[Notice]:
        found = [one for one in self._document.submissions if has_unread_files(one)]
        return [self._item(one.name, one.not_taken) for one in found]

    def late_by_file(self) -> list[Notice]:
        return [
            self._item(name, [f"{one.submitted_at}, {count(one.late.days, 'day')} begun"])
            for name, (_, one) in self._rows.items()
            if one.late is not None and is_late_by_file(one)
        ]

    def strangers(self) -> list[Notice]:
        named = self._of(self._document.submissions_without_student)
        return [self._item(name, [one.note] if one.note else []) for name, one in named]

    def people(self, students: Sequence[NotedStudent]) -> list[Notice]:
        found = []
        for one in students:
            words = [word for word in (one.id, one.name, one.email) if word]
            found.append(Notice(None, " ".join(words), [one.note] if one.note else []))
        return found

    def changed(self) -> list[Notice]:
        return [
            self._item(one.name, [f"{_points(one.before)} before, {_points(one.after)} now{one.why}"])
            for one in self._document.changed
        ]

    def look_again(self) -> list[Notice]:
        return [
            self._item(name, one.review.look_again) for name, (_, one) in self._rows.items() if one.review.look_again
        ]

    def open_requests(self) -> list[Notice]:
        return [self._item(name, []) for name, (_, one) in self._rows.items() if one.review.open_requests]

    def changed_by_hand(self) -> list[Notice]:
        return [self._item(name, one.review.changes) for name, (_, one) in self._rows.items() if one.review.changes]

    def plain(self, names: Sequence[str]) -> list[Notice]:
        return [self._item(name, []) for name in names]


def groups(document: ClassResults) -> list[Group]:
    """Those with something in them, the most urgent first."""
    find = _Finder(document)
    found = [
        Group(
            "fault",
            "bad",
            "Faults of the grader",
            "No zero: --resume grades these again, but none that it gave up.",
            find.faults(),
        ),
        Group(
            "unreadable",
            "bad",
            "Nothing could be read of these",
            "0 points, which count in no mean.",
            find.unreadable(),
        ),
        Group(
            "file not read",
            "warn",
            "Files that could not be read",
            "Their steps have 0 points, as if they were not handed in.",
            find.not_taken(),
        ),
        Group("not graded", "warn", "Not graded yet", "--resume goes on with these.", find.plain(document.not_graded)),
        Group(
            "earlier result",
            "warn",
            "With an earlier result",
            "What is there now is not graded yet: the last run was interrupted, or nightly waits.",
            find.plain(document.outdated),
        ),
        Group(
            "late by file time",
            "warn",
            "Late by the time of the file",
            "The roster has no submitted_at for these; copying may have set that time.",
            find.late_by_file(),
        ),
        Group(
            "look again",
            "warn",
            "Changed points to look at again",
            "The grader gives other points now than when a person changed them. What the person said counts.",
            find.look_again(),
        ),
        Group(
            "open request",
            "warn",
            "Open regrade requests",
            "The desk is where they are answered.",
            find.open_requests(),
        ),
        Group("nobody's", "warn", "Without a student on the roster", "Nothing is lost.", find.strangers()),
        Group(
            "", "note", "On the roster, but without a submission", "", find.people(document.students_without_submission)
        ),
        Group("", "note", "With more than one submission", "", find.people(document.students_with_several)),
        Group("", "note", "Points that a person changed", "", find.changed_by_hand()),
        Group("", "note", "Changed since the last time", "", find.changed()),
        Group("", "note", "Graded earlier, but no longer in the folder", "", find.plain(document.gone)),
        Group("", "note", "Extensions for ids that nobody has", "", find.plain(document.unknown_extensions)),
    ]
    return [group for group in found if group.items]


def marks(found: Sequence[Group]) -> dict[int, list[str]]:
    """Row -> why it needs a look."""
    named: dict[int, list[str]] = {}
    for group in found:
        for item in group.items:
            if group.mark and item.row is not None:
                named.setdefault(item.row, []).append(group.mark)
    return named


def marks_of(one: GradedSubmission, has_roster: bool) -> list[str]:
    """The marks of one submission, for who does not have the others at hand: those that `marks` gives it."""
    found = {
        "fault": one.status == "fault",
        "unreadable": one.status == "unreadable",
        "file not read": has_unread_files(one),
        "not graded": one.status == "not-graded",
        "earlier result": one.outdated,
        "late by file time": is_late_by_file(one),
        "look again": bool(one.review.look_again),
        "open request": one.review.open_requests > 0,
        "nobody's": has_roster and not one.students,
    }
    return [mark for mark, holds in found.items() if holds]


# Which known mistakes are common in a class, step by step, and who made them.


@dataclass(frozen=True)
class CommonMistake:
    """A mistake, and the places in the list of submissions of those who made it. Files of an older kit do not tell
    who, only how many."""

    number: int  # its place among all mistakes of the class
    step: str
    title: str
    submissions: int
    rows: Sequence[int]


def common_mistakes(document: ClassResults) -> list[CommonMistake]:
    """The most common first, in the order of class.json."""
    rows: dict[tuple[str, str], list[int]] = defaultdict(list)
    for index, one in enumerate(document.submissions):
        for step, titles in one.mistakes.items():
            for title in titles:
                rows[step, title].append(index)
    return [
        CommonMistake(index, found.step, found.title, found.submissions, rows.get((found.step, found.title), ()))
        for index, found in enumerate(document.mistakes)
    ]
