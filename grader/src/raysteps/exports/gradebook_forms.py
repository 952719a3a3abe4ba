"""What the columns of an exported gradebook mean: Canvas's and Moodle's."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from raysteps.classroom.names import folded
from raysteps.common.errors import UsageError
from raysteps.exports.csv_cells import Row, Sheet
from raysteps.exports.identities import Person, number_at_end, spoken_name

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
    known = "; ".join(names) or "none"
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
