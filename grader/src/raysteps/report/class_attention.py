"""What needs a person's eye in a class, apart from the table."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from raysteps.common.text import count, printable, shorten, tenths
from raysteps.results.class_model import ClassResults, GradedSubmission, NotedStudent

Weight = Literal["bad", "warn", "note"]
_LONGEST = 300


@dataclass(frozen=True)
class Item:
    """A submission by its place in the list, or somebody who has none; and what there is to say."""

    row: int | None
    who: str
    words: Sequence[str]


@dataclass(frozen=True)
class Group:
    """Submissions with the same thing to look at."""

    mark: str  # in the table; empty where the table says nothing
    weight: Weight
    heading: str
    why: str
    items: Sequence[Item]


def _first_line(text: str) -> str:
    return shorten(printable(text).split("\n", 1)[0], _LONGEST)


def _points(value: float | None) -> str:
    return "no points" if value is None else tenths(value)


class _Finder:
    def __init__(self, document: ClassResults) -> None:
        self._document = document
        self._rows = {one.name: (row, one) for row, one in enumerate(document.submissions)}

    def _item(self, name: str, words: Sequence[str]) -> Item:
        found = self._rows.get(name)
        return Item(found[0] if found else None, name, words)

    def _of(self, names: Sequence[str]) -> list[tuple[str, GradedSubmission]]:
        return [(name, self._rows[name][1]) for name in names if name in self._rows]

    def faults(self) -> list[Item]:
        return [self._item(name, [_first_line(one.fault)]) for name, one in self._of(self._document.faults)]

    def late_by_file(self) -> list[Item]:
        return [
            self._item(name, [f"{one.submitted_at}, {count(one.late.days, 'day')} begun"])
            for name, (_, one) in self._rows.items()
            if one.submitted_from == "files" and one.late is not None and one.late.days
        ]

    def strangers(self) -> list[Item]:
        named = self._of(self._document.submissions_without_student)
        return [self._item(name, [one.note] if one.note else []) for name, one in named]

    def people(self, students: Sequence[NotedStudent]) -> list[Item]:
        found = []
        for one in students:
            words = [word for word in (one.id, one.name, one.email) if word]
            found.append(Item(None, " ".join(words), [one.note] if one.note else []))
        return found

    def changed(self) -> list[Item]:
        return [
            self._item(one.name, [f"{_points(one.before)} before, {_points(one.after)} now{one.why}"])
            for one in self._document.changed
        ]

    def look_again(self) -> list[Item]:
        return [
            self._item(name, one.review.look_again) for name, (_, one) in self._rows.items() if one.review.look_again
        ]

    def open_requests(self) -> list[Item]:
        return [self._item(name, []) for name, (_, one) in self._rows.items() if one.review.open_requests]

    def changed_by_hand(self) -> list[Item]:
        return [self._item(name, one.review.changes) for name, (_, one) in self._rows.items() if one.review.changes]

    def plain(self, names: Sequence[str]) -> list[Item]:
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
            "Nothing could be taken from these",
            "0 points, which count in no mean; the report of each says why.",
            find.plain(document.unreadable),
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
