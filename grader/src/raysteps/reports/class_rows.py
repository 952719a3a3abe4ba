"""The table of a class: what each row shows, and what it is sorted and found by."""

import hashlib
import unicodedata
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from raysteps.common.text import number, printable
from raysteps.reports.words import STATUS_WORDS

Document = Mapping[str, Any]
Link = Callable[[str], str | None]

STATUSES = {str(status): words for status, (words, _, _) in STATUS_WORDS.items()}
_NO_POINTS = {"fault": "fault", "not-graded": "not graded"}


@dataclass(frozen=True)
class Cell:
    """One step of one submission."""

    status: str
    words: str
    points: str


@dataclass(frozen=True)
class Row:
    """One submission."""

    alias: str  # what it is called while names are hidden
    who: str
    more: str
    link: str | None
    cells: Sequence[Cell | None]
    total: str
    days: int
    final: str
    seconds: str
    marks: Sequence[str]
    words: str  # it is found by
    keys: Sequence[float | None]  # the numbers that its columns are sorted by, after the name


def aliases(names: Sequence[str]) -> list[str]:
    """A number for each name, the same at every look, in an order that tells nothing about the name."""
    order = sorted(names, key=lambda name: (hashlib.sha256(name.encode("utf-8", "replace")).digest(), name))
    numbers = {name: index for index, name in enumerate(order, start=1)}
    return [f"student {numbers[name]}" for name in names]


def _who(one: Document) -> tuple[str, str]:
    """The name to show, and what else tells who it is."""
    people = [student["name"] or student["id"] or student["email"] for student in one["students"]]
    ids = [student["id"] for student in one["students"] if student["id"] and student["name"]]
    if not people:
        return printable(one["name"]), ""
    return printable(", ".join(people)), printable(" · ".join([*ids, one["name"]]))


def _found_by(one: Document) -> str:
    """As the page makes what is searched for: lower case without folding, and one code for each letter."""
    words = [one["name"], one["entry"]]
    words += [student[key] for student in one["students"] for key in ("id", "name", "email")]
    return unicodedata.normalize("NFC", " ".join(dict.fromkeys(word for word in words if word)).lower())


def _cell(result: Document | None) -> Cell | None:
    if result is None:
        return None
    words = STATUSES.get(result["status"], printable(result["status"]))
    return Cell(result["status"], words, number(result["points"]))


def _points(value: float | None, status: str) -> str:
    return _NO_POINTS.get(status, "") if value is None else number(value)


def table_rows(document: Document, marks: Mapping[int, Sequence[str]], link: Link) -> list[Row]:
    """One for each submission, in the order of class.json."""
    submissions = document["submissions"]
    steps = [step["id"] for step in document["steps"]]
    rows = []
    for index, (one, alias) in enumerate(zip(submissions, aliases([one["name"] for one in submissions]), strict=True)):
        results = [one["steps"].get(step) for step in steps]
        days = one["late"]["days"] if one["late"] is not None else 0
        seconds = one.get("seconds")
        who, more = _who(one)
        keys = [result["points"] if result is not None else None for result in results]
        rows.append(
            Row(
                alias=alias,
                who=who,
                more=more,
                link=link(one["name"]),
                cells=[_cell(result) for result in results],
                total=_points(one["points"], one["status"]),
                days=days,
                final="" if one["final"] is None else number(one["final"]),
                seconds="" if seconds is None else f"{seconds:.1f}",
                marks=marks.get(index, []),
                words=_found_by(one),
                keys=[*keys, one["points"], days, one["final"], seconds],
            )
        )
    return rows
