"""Fills an exported gradebook with the grades of a class."""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from raysteps.classroom.entries import folded
from raysteps.common.errors import UTF16_MARKS, UsageError, decode_error_position, reason
from raysteps.common.text import clean, delimiter_of, number
from raysteps.exports.class_results import GradedStudent, Person, match, number_at_end, spoken_name

# A CSV file in which single cells can be replaced while every other byte stays as it is.

_MAX_BYTES = 32 << 20


@dataclass(frozen=True)
class Cell:
    """Where a cell stands in the text, quotes included, and what it says."""

    start: int
    end: int
    text: str
    quoted: bool


@dataclass(frozen=True)
class Row:
    """One record; quoted cells may hold line breaks, so it need not be one line."""

    line: int
    cells: tuple[Cell, ...]

    def text(self, column: int) -> str:
        return self.cells[column].text if column < len(self.cells) else ""

    @property
    def is_blank(self) -> bool:
        return not any(cell.text.strip() for cell in self.cells)


class _Scanner:
    def __init__(self, path: Path, text: str, at: int, delimiter: str) -> None:
        self._path = path
        self._text = text
        self._at = at
        self._delimiter = delimiter
        self._line = 1

    def _cell(self) -> Cell:
        text, start = self._text, self._at
        if not text.startswith('"', start):
            while self._at < len(text) and text[self._at] not in (self._delimiter, "\r", "\n"):
                self._at += 1
            return Cell(start, self._at, text[start : self._at], False)
        line = self._line
        parts: list[str] = []
        self._at += 1
        while True:
            close = text.find('"', self._at)
            if close < 0:
                raise UsageError(f"{self._path}:{line}: a quoted cell that begins here has no end")
            parts.append(text[self._at : close])
            self._at = close + 1
            if not text.startswith('"', self._at):
                break
            parts.append('"')
            self._at += 1
        said = "".join(parts)
        self._line += said.count("\n") + said.count("\r") - said.count("\r\n")
        if self._at < len(text) and text[self._at] not in (self._delimiter, "\r", "\n"):
            raise UsageError(f"{self._path}:{self._line}: text after the closing quote of a cell")
        return Cell(start, self._at, said, True)

    def rows(self) -> list[Row]:
        rows, text = [], self._text
        while self._at < len(text):
            line, cells = self._line, [self._cell()]
            while text.startswith(self._delimiter, self._at):
                self._at += 1
                cells.append(self._cell())
            self._at += 2 if text.startswith("\r\n", self._at) else 1
            self._line += 1
            rows.append(Row(line, tuple(cells)))
        return rows


@dataclass(frozen=True)
class Sheet:
    """The file's text, its byte order mark included, and its records."""

    path: Path
    text: str
    delimiter: str
    rows: tuple[Row, ...]

    def filled(self, changes: Mapping[Cell, str]) -> bytes:
        """The file with these cells replaced; a cell keeps its quotes, and gets some where it needs them."""
        parts, at = [], 0
        for cell in sorted(changes, key=lambda one: one.start):
            parts += [self.text[at : cell.start], self._written(changes[cell], cell.quoted)]
            at = cell.end
        return "".join([*parts, self.text[at:]]).encode("utf-8")

    def _written(self, value: str, quoted: bool) -> str:
        if quoted or any(sign in value for sign in (self.delimiter, '"', "\n", "\r")):
            return '"' + value.replace('"', '""') + '"'
        return value


def read_sheet(path: Path) -> Sheet:
    """Reads UTF-8, with or without a byte order mark; what is written back is the same down to the byte."""
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise UsageError(f"{path}: is larger than {_MAX_BYTES >> 20} MB")
        data = path.read_bytes()
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {reason(error)}") from error
    if data.startswith(UTF16_MARKS) or b"\x00" in data:
        raise UsageError(f"{path}: is UTF-16 or no text at all; export or save it as CSV in UTF-8")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise UsageError(
            f"{path}:{decode_error_position(error)}: is not UTF-8; export or save it as CSV in UTF-8"
        ) from error
    start = 1 if text.startswith("\ufeff") else 0
    delimiter = delimiter_of(text[start:])
    rows = _Scanner(path, text, start, delimiter).rows()
    if not rows:
        raise UsageError(f"{path}: is empty")
    return Sheet(path, text, delimiter, tuple(rows))


# What the columns of an exported gradebook mean: Canvas's and Moodle's.

_ASSIGNMENT = re.compile(r"\((?P<id>[0-9]+)\)\s*$")
_MOODLE = {
    "identifier": "Identifier",
    "id": "ID number",
    "name": "Full name",
    "email": "Email address",
    "grade": "Grade",
    "max": "Maximum Grade",
    "locked": "Grade can be changed",
    "feedback": "Feedback comments",
}
MOODLE_COLUMNS = tuple(_MOODLE)


@dataclass(frozen=True)
class Student:
    """A row that grades can go into."""

    row: Row
    person: Person
    most: str  # as the gradebook says it
    kept: str = ""  # why its grade must stay as it is


@dataclass(frozen=True)
class Gradebook:
    """The columns to fill, and the students."""

    grade: int
    feedback: int | None
    students: list[Student]
    notes: tuple[str, ...] = ()  # what cannot be done for want of a column


def _headers(sheet: Sheet) -> dict[str, int]:
    headers: dict[str, int] = {}
    for at, cell in enumerate(sheet.rows[0].cells):
        headers.setdefault(cell.text.strip(), at)
    return headers


def _label(row: Row, *words: str) -> str:
    return f"{' '.join(filter(None, words))} (line {row.line})"


def _filled(row: Row, columns: Mapping[str, int], *names: str) -> frozenset[str]:
    texts = [folded(row.text(columns[name])) for name in names if name in columns]
    return frozenset(filter(None, texts))


def _assignment_column(sheet: Sheet, headers: Mapping[str, int], wanted: str | None) -> int:
    names = {name: at for name, at in headers.items() if _ASSIGNMENT.search(name)}
    if not names:
        raise UsageError(
            f"{sheet.path}: has no column of an assignment, such as 'Ray tracer (4711)'; expected a gradebook as "
            "Canvas exports it"
        )
    if wanted is not None:
        chosen = {
            name: at
            for name, at in names.items()
            if wanted in (name, _ASSIGNMENT.sub("", name).strip(), _ASSIGNMENT.findall(name)[0])
        }
    else:
        chosen = names
    if len(chosen) == 1:
        return next(iter(chosen.values()))
    known = "; ".join(names)
    if wanted is not None:
        problem = "is not" if not chosen else "is more than once"
        raise UsageError(f"{sheet.path}: the assignment '{wanted}' {problem} among its columns: {known}")
    raise UsageError(f"{sheet.path}: say which assignment with --assignment; its columns are: {known}")


def _canvas_name(row: Row, headers: Mapping[str, int]) -> str:
    if "Student" in headers:
        return row.text(headers["Student"])
    return f"{row.text(headers['LastName'])}, {row.text(headers['FirstName'])}"


def canvas(sheet: Sheet, assignment: str | None) -> Gradebook:
    """`Student,ID,SIS User ID,SIS Login ID,Section,Name (123)`; students come after the row of points possible."""
    headers = _headers(sheet)
    named = "Student" in headers or {"LastName", "FirstName"} <= headers.keys()
    if not named or "ID" not in headers:
        raise UsageError(f"{sheet.path}: has no columns Student and ID; expected a gradebook exported from Canvas")
    grade = _assignment_column(sheet, headers, assignment)
    rows, most = sheet.rows[1:], ""
    for at, row in enumerate(rows[:3]):
        if row.text(0).strip() == "Points Possible":
            rows, most = rows[at + 1 :], row.text(grade).strip()
            break
    students = []
    for row in rows:
        name = _canvas_name(row, headers)
        if not name.strip(" ,") and not row.text(headers["ID"]).strip():
            continue  # as the row that says which grades are posted by hand
        ids = _filled(row, headers, "SIS User ID", "SIS Login ID", "Integration ID")
        numbers = _filled(row, headers, "ID")
        emails = frozenset(one for one in _filled(row, headers, "SIS Login ID", "Email") if "@" in one)
        label = _label(row, name.strip(), row.text(headers["ID"]).strip())
        person = Person(label, emails, ids, numbers, spoken_name(name))
        said = row.text(grade).strip().upper()
        why = {"EX": "is excused", "N/A": "is not assigned"}.get(said, "")
        students.append(Student(row, person, most, why))
    return Gradebook(grade, None, students)


def _not_there(columns: Mapping[str, int]) -> tuple[str, ...]:
    notes = []
    if not columns.keys() & {"email", "name", "id"}:
        notes.append(
            "only the identifier tells whose a row is, because the worksheet has none of the columns "
            f"{_MOODLE['email']}, {_MOODLE['name']} and {_MOODLE['id']}; name them with --column email=HEADING, "
            "--column name=HEADING or --column id=HEADING"
        )
    if "feedback" not in columns:
        notes.append(
            f"no comments are written, because the worksheet has no column {_MOODLE['feedback']}; "
            "name it with --column feedback=HEADING"
        )
    return tuple(notes)


def moodle(sheet: Sheet, renamed: Mapping[str, str]) -> Gradebook:
    """A grading worksheet; `renamed` gives the headings where Moodle speaks another language."""
    headers = _headers(sheet)
    names = {**_MOODLE, **renamed}
    columns = {kind: headers[name] for kind, name in names.items() if name in headers}
    unknown = [name for name in renamed.values() if name not in headers]
    missing = [names[kind] for kind in ("identifier", "grade") if kind not in columns]
    if unknown or missing:
        hint = (
            "if Moodle speaks another language, name all of identifier, grade, max, email or name, and feedback with "
            "--column, as in --column grade=Bewertung"
        )
        raise UsageError(f"{sheet.path}: has no column {', '.join([*unknown, *missing])}; {hint}")
    students = []
    for row in sheet.rows[1:]:
        if row.is_blank:
            continue
        identifier = row.text(columns["identifier"]).strip()
        name = row.text(columns["name"]) if "name" in columns else ""
        numbers = {*_filled(row, columns, "identifier"), number_at_end(identifier)} - {""}
        label = _label(row, name.strip(), identifier)
        emails, ids = _filled(row, columns, "email"), _filled(row, columns, "id")
        person = Person(label, emails, ids, frozenset(numbers), spoken_name(name))
        most = row.text(columns["max"]).strip() if "max" in columns else ""
        locked = "locked" in columns and folded(row.text(columns["locked"])) == "no"
        students.append(Student(row, person, most, "has a locked grade" if locked else ""))
    return Gradebook(columns["grade"], columns.get("feedback"), students, _not_there(columns))


Points = Literal["scale", "as-is"]
_NUMBER = re.compile(r"^[0-9]+(?:[.,][0-9]{1,5})?$")
_THOUSANDS = re.compile(r"^[1-9][0-9]{0,2}[.,][0-9]{3}$")  # or a fraction with three digits: nobody knows
_COMMA = re.compile(r"^[0-9]+,[0-9]{1,5}$")


_SINGLY = 3  # people with one reason who are named in a line each


def gathered(people: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """Labels and reasons, of which many with the same reason stand together: hundreds who handed nothing in would hide
    whatever else is said."""
    labels: dict[str, list[str]] = {}
    for label, why in people:
        labels.setdefault(why, []).append(clean(label))
    return [
        (text, why)
        for why, some in labels.items()
        for text in (some if len(some) <= _SINGLY else [f"{len(some)} people: {'; '.join(some)}"])
    ]


@dataclass
class FilledGradebook:
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


def _points(one: GradedStudent, most: float | None, how: Points | None) -> float:
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


def _clipped(points: float, one: GradedStudent, most: float | None, notes: list[str]) -> float:
    if most is None or points <= most:
        return points
    notes.append(f"{one.label}: {number(points)} points are above the maximum; {number(most)} entered")
    return most


def fill(
    sheet: Sheet,
    book: Gradebook,
    graded: Sequence[GradedStudent],
    feedback: Callable[[GradedStudent], str | None],
    *,
    points: Points | None = None,
    clip: bool = False,
) -> FilledGradebook:
    """Grades and feedback for whom a row was found; everybody else is only talked about."""
    rows = match(graded, [student.person for student in book.students])
    filled = FilledGradebook()
    left: list[tuple[str, str]] = []
    comma = _has_decimal_comma(book)
    for at, one in enumerate(graded):
        if at not in rows.found:
            filled.notes.append(f"no row for {one.label}" + (f": {rows.doubts[at]}" if at in rows.doubts else ""))
            continue
        student = book.students[rows.found[at]]
        if one.points is None or student.kept:
            why = student.kept or ("has no points in results.csv" if one.submission else "handed nothing in")
            left.append((student.person.label, why))
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
    filled.notes += [f"left as it is: {who} {why}" for who, why in gathered(left)]
    filled.notes += [f"no submission for {who}" for who, _ in gathered((label, "") for label in missing)]
    return filled
