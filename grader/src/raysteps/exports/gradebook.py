"""Fills an exported gradebook with the grades of a class."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Literal

from raysteps.common.errors import UsageError
from raysteps.common.text import number
from raysteps.exports.class_results import Graded
from raysteps.exports.csv_cells import Cell, Sheet
from raysteps.exports.gradebook_forms import Gradebook
from raysteps.exports.identities import match

Points = Literal["scale", "as-is"]
_NUMBER = re.compile(r"^[0-9]+(?:[.,][0-9]{1,5})?$")
_THOUSANDS = re.compile(r"^[1-9][0-9]{0,2}[.,][0-9]{3}$")  # or a fraction with three digits: nobody knows
_COMMA = re.compile(r"^[0-9]+,[0-9]{1,5}$")


@dataclass
class Filled:
    """The new cells, and what the person at the keyboard must know."""

    changes: dict[Cell, str] = field(default_factory=dict)
    graded: int = 0
    notes: list[str] = field(default_factory=list)


def most_of(text: str, where: str) -> float | None:
    """A maximum as the gradebook writes it; None where it says none."""
    if not text:
        return None
    if not _NUMBER.match(text) or _THOUSANDS.match(text):
        raise UsageError(f"{where}: the maximum is '{text}', expected a number without thousands separators, as 100.00")
    return float(text.replace(",", "."))


def _has_decimal_comma(book: Gradebook) -> bool:
    texts = [student.most for student in book.students]
    texts += [student.row.text(book.grade).strip() for student in book.students]
    return any(_COMMA.match(text) for text in texts)


def _points(one: Graded, most: float | None, how: Points | None) -> float:
    assert one.points is not None
    points = one.points
    if most is None:
        if how != "as-is":
            raise UsageError(
                f"the gradebook has no maximum for {one.label}, who was graded out of {number(one.most)}; "
                "say --points as-is to enter the points unchanged"
            )
        return round(points, 2)
    if abs(most - one.most) > 1e-6:
        if how is None:
            raise UsageError(
                f"the gradebook's maximum is {number(most)}, but {one.label} was graded out of {number(one.most)}: "
                "say --points scale to convert, or --points as-is to enter the points unchanged"
            )
        if how == "scale":
            points = one.points * most / one.most if one.most else 0.0
    return round(points, 2)


def _clipped(points: float, one: Graded, most: float | None, notes: list[str]) -> float:
    if most is None or points <= most:
        return points
    notes.append(f"{one.label}: {number(points)} points are above the maximum; {number(most)} entered")
    return most


def fill(
    sheet: Sheet,
    book: Gradebook,
    graded: Sequence[Graded],
    feedback: Callable[[Graded], str | None],
    *,
    points: Points | None = None,
    clip: bool = False,
) -> Filled:
    """Grades and feedback for whom a row was found; everybody else is only talked about."""
    rows = match(graded, [student.person for student in book.students])
    filled = Filled()
    comma = _has_decimal_comma(book)
    for at, one in enumerate(graded):
        if at not in rows.found:
            filled.notes.append(f"no row for {one.label}" + (f": {rows.doubts[at]}" if at in rows.doubts else ""))
            continue
        student = book.students[rows.found[at]]
        if one.points is None or student.kept:
            why = student.kept or ("has no points in results.csv" if one.submission else "handed nothing in")
            filled.notes.append(f"left as it is: {student.person.label} {why}")
            continue
        last = max(book.grade, book.feedback or 0)
        if len(student.row.cells) <= last:
            cells = len(student.row.cells)
            raise UsageError(f"{sheet.path}:{student.row.line}: {cells} cells, expected at least {last + 1}")
        most = most_of(student.most, f"{sheet.path}:{student.row.line}")
        value = _points(one, most, points)
        if clip:
            value = _clipped(value, one, most, filled.notes)
        text = number(value)
        filled.changes[student.row.cells[book.grade]] = text.replace(".", ",") if comma else text
        if book.feedback is not None:
            said = feedback(one)
            if said is None:
                filled.notes.append(f"{one.label}: has no results.json; the comment on {student.person.label} stays")
            else:
                filled.changes[student.row.cells[book.feedback]] = said
        filled.graded += 1
    graded_rows = set(rows.found.values())
    missing = [student.person.label for at, student in enumerate(book.students) if at not in graded_rows]
    filled.notes += [f"no submission for {label}" for label in missing]
    return filled
