"""The roster: a CSV file with the students of a class."""

import csv
import io
import re
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from raysteps.classroom.names import folded
from raysteps.common.cells import delimiter_of
from raysteps.common.errors import UsageError
from raysteps.common.text import listed, printable

# Header names without anything but letters and digits, in lower case. The first that is there counts.
_HEADERS = {
    "id": (
        *("id", "studentid", "studentnumber", "sid", "sisid", "sisuserid", "idnumber", "matriculation"),
        *("matriculationnumber", "matrikelnummer", "identifier", "userid", "user", "username", "login", "sisloginid"),
    ),
    "name": ("name", "fullname", "studentname", "student", "displayname"),
    "first": ("firstname", "givenname", "first", "vorname"),
    "last": ("lastname", "surname", "familyname", "last", "nachname"),
    "email": ("email", "emailaddress", "mail"),
    "submission": ("submission", "entry", "file", "filename", "folder", "archive"),
    "submitted_at": ("submittedat", "submitted", "submissiontime", "submissiondate", "timestamp", "time", "date"),
}
_MOST_BYTES = 16 << 20


@dataclass(frozen=True)
class Student:
    """One line of a roster; what it does not say is empty."""

    line: int
    id: str
    name: str
    email: str
    submission: str = ""
    submitted_at: str = ""  # ISO 8601, with a time zone where the roster has one

    @property
    def shown(self) -> str:
        return self.id or self.email or self.name


def _plain(header: str) -> str:
    return re.sub(r"[\W_]+", "", folded(header))


def _columns(header: list[str], path: Path) -> dict[str, int]:
    plain = [_plain(cell) for cell in header]
    columns: dict[str, int] = {}
    for field, names in _HEADERS.items():
        for name in names:
            if name in plain:
                columns[field] = plain.index(name)
                break
    if not columns.keys() & {"id", "name", "email"} and not {"first", "last"} <= columns.keys():
        raise UsageError(
            f"{path}:1: expected a header with a column id, name or email (and perhaps submission and submitted_at), "
            f"found {listed([repr(cell) for cell in header])}"
        )
    return columns


def _time(text: str, where: str) -> str:
    if not text:
        return ""
    try:
        moment = datetime.fromisoformat(text)
    except ValueError:
        moment = None
    if moment is None or ":" not in text:
        raise UsageError(
            f"{where}: submitted_at is {text!r}; expected a date and time such as 2026-11-20T23:59:00+01:00"
        )
    return moment.isoformat()


def _text(path: Path) -> str:
    try:
        with path.open("rb") as file:
            data = file.read(_MOST_BYTES + 1)
    except OSError as error:
        raise UsageError(f"{path}: the roster cannot be read: {error.strerror}") from error
    if len(data) > _MOST_BYTES:
        raise UsageError(f"{path}: is larger than {_MOST_BYTES >> 20} MB; expected a roster")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise UsageError(f"{path}:{line}: is not UTF-8; save the roster as `CSV UTF-8`") from error


def _rows(text: str, path: Path) -> Iterable[tuple[int, list[str]]]:
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter_of(text), strict=True)
    try:
        for row in reader:
            if any(cell.strip() for cell in row):
                yield reader.line_num, [printable(cell).strip() for cell in row]
    except csv.Error as error:
        raise UsageError(f"{path}:{reader.line_num}: is not CSV: {error}") from error


def read_roster(path: Path) -> list[Student]:
    """All students, in the order of the file."""
    rows = iter(_rows(_text(path), path))
    _, header = next(rows, (1, [""]))
    columns = _columns(header, path)
    students: list[Student] = []
    seen: dict[tuple[str, str], int] = {}
    for line, row in rows:
        cells = {field: row[column] if column < len(row) else "" for field, column in columns.items()}
        name = cells.get("name") or f"{cells.get('first', '')} {cells.get('last', '')}".strip()
        student = Student(
            line,
            cells.get("id", ""),
            name,
            cells.get("email", ""),
            cells.get("submission", ""),
            _time(cells.get("submitted_at", ""), f"{path}:{line}"),
        )
        if not student.shown:
            raise UsageError(f"{path}:{line}: expected an id, a name or an email address")
        # Two students of one name need something else that tells them apart.
        alone = "" if student.id or student.email else student.name
        for field, value in (("id", student.id), ("email", student.email), ("name", alone)):
            if value and seen.setdefault((field, folded(value)), line) != line:
                other = seen[field, folded(value)]
                raise UsageError(f"{path}:{line}: the {field} {value!r} stands in line {other}, too")
        students.append(student)
    if not students:
        raise UsageError(f"{path}: expected a line for each student below the header, found none")
    return students
