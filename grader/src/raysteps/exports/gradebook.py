"""Fills an exported gradebook with the grades of a class."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Literal

from raysteps.common.errors import UsageError
from raysteps.common.text import number
from raysteps.exports.class_results import Graded
from raysteps.exports.csv_cells import Cell, Sheet
from raysteps.exports.gradebook_forms import Gradebook, Student
from raysteps.exports.identities import match

Points = Literal["scale", "as-is"]
_NUMBER = re.compile(r"^[0-9]+(?:[.,][0-9]{1,5})?$")
_COMMA = re.compile(r"^[0-9]+,[0-9]{1,5}$")


@dataclass
class Filled:
    """The new cells, and what the person at the keyboard must know."""

    changes: dict[Cell, str] = field(default_factory=dict)
    graded: int = 0
    notes: list[str] = field(default_factory=list)


def most_of(text: str) -> float | None:
    """A maximum as the gradebook writes it; None where it says none."""
    return float(text.replace(",", ".")) if _NUMBER.match(text) else None


def _has_decimal_comma(book: Gradebook) -> bool:
    texts = [student.most for student in book.students]
    texts += [student.row.text(book.grade).strip() for student in book.students]
    return any(_COMMA.match(text) for text in texts)


def _points(one: Graded, student: Student, how: Points | None) -> float:
    assert one.points is not None
    most = most_of(student.most)
    if most is None:
        return one.points
    points = one.points
    if abs(most - one.most) > 1e-6:
        if how is None:
            raise UsageError(
                f"the gradebook's maximum is {number(most)}, but {one.label} was graded out of {number(one.most)}: "
                "say --points scale to convert, or --points as-is to enter the points unchanged"
            )
        if how == "scale":
            points = one.points * most / one.most if one.most else 0.0
    return round(points, 2)


def _clipped(points: float, one: Graded, student: Student, notes: list[str]) -> float:
    most = most_of(student.most)
    if most is None or points <= most:
        return points
    notes.append(f"{one.label}: {number(points)} points are above the maximum; {number(most)} entered")
    return most


def fill(
    sheet: Sheet,
    book: Gradebook,
    graded: Sequence[Graded],
    feedback: Callable[[Graded], str],
    *,
    points: Points | None = None,
    clip: bool = False,
) -> Filled:
    """Grades and feedback for whom a row was found; everybody else is only talked about."""
    found = match(graded, [student.person for student in book.students])
    filled = Filled()
    comma = _has_decimal_comma(book)
    for at, one in enumerate(graded):
        if at not in found:
            filled.notes.append(f"no row for {one.label}")
            continue
        student = book.students[found[at]]
        if one.points is None or student.kept:
            why = student.kept or ("has no points in results.csv" if one.submission else "handed nothing in")
            filled.notes.append(f"left as it is: {student.person.label} {why}")
            continue
        last = max(book.grade, book.feedback or 0)
        if len(student.row.cells) <= last:
            cells = len(student.row.cells)
            raise UsageError(f"{sheet.path}:{student.row.line}: {cells} cells, expected at least {last + 1}")
        value = _points(one, student, points)
        if clip:
            value = _clipped(value, one, student, filled.notes)
        text = number(value)
        filled.changes[student.row.cells[book.grade]] = text.replace(".", ",") if comma else text
        if book.feedback is not None:
            filled.changes[student.row.cells[book.feedback]] = feedback(one)
        filled.graded += 1
    rows = set(found.values())
    missing = [student.person.label for at, student in enumerate(book.students) if at not in rows]
    filled.notes += [f"no submission for {label}" for label in missing]
    return filled
