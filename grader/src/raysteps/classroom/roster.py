"""The roster: a CSV file with the students of a class."""

import csv
import io
import re
import unicodedata
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from pathlib import Path

from raysteps.classroom.entries import folded, platform_identity, stem
from raysteps.common.errors import UsageError, decode_error_position, reason
from raysteps.common.text import delimiter_of, join_and, join_some, nearest, one_line, visible_text
from raysteps.submission.load import like

# Header names without anything but letters and digits, in lower case. The first that is there counts.
HEADERS = {
    "id": (
        *("id", "studentid", "studentnumber", "sid", "sisid", "sisuserid", "idnumber", "matriculation"),
        *("matriculationnumber", "matrikelnummer", "identifier", "userid", "user", "username", "login", "sisloginid"),
    ),
    "name": ("name", "fullname", "studentname", "student", "displayname"),
    "first": ("firstname", "givenname", "first", "vorname"),
    "last": ("lastname", "surname", "familyname", "last", "nachname"),
    "email": ("email", "emailaddress", "mail"),
    "submission": ("submission", "entry", "file", "filename", "folder", "archive"),
    "repository": ("repository", "repositoryurl", "studentrepositoryurl", "repo", "repourl", "giturl"),
    "submitted_at": ("submittedat", "submitted", "submissiontime", "submissiondate", "timestamp", "time", "date"),
}
_OF_A_NAME = ("name", "first", "last")
_TYPED = {"first": "first name", "last": "last name"}  # headers that are not called as the columns are here
_MAX_BYTES = 16 << 20
_MAX_NAMED = 5  # columns that nobody knows


@dataclass(frozen=True)
class Student:
    """One line of a roster; what it does not say is empty."""

    line: int
    id: str
    name: str
    email: str
    submission: str = ""
    submitted_at: str = ""  # ISO 8601, with a time zone where the roster has one
    repository: str = ""  # for `nightly`

    @property
    def shown(self) -> str:
        return self.id or self.email or self.name


def _plain_header(header: str) -> str:
    """As `HEADERS` has it."""
    return re.sub(r"[\W_]+", "", folded(header))


def columns_of(header: Sequence[str], known: Mapping[str, Sequence[str]]) -> dict[str, int]:
    """Where the columns are that this header has, by what they may be called."""
    plain = [_plain_header(cell) for cell in header]
    found = {column: next((name for name in names if name in plain), None) for column, names in known.items()}
    return {column: plain.index(name) for column, name in found.items() if name is not None}


def _columns(header: list[str], path: Path) -> dict[str, int]:
    columns = columns_of(header, HEADERS)
    if not columns.keys() & {"id", "name", "email"} and not {"first", "last"} <= columns.keys():
        raise UsageError(
            f"{path}:1: expected a header with a column id, name or email (and perhaps submission and submitted_at), "
            f"found {join_and([repr(cell) for cell in header])}"
        )
    return columns


def _typed(column: str) -> str:
    return _TYPED.get(column, column)


def _unknown_columns(header: list[str], found: Collection[str], path: Path) -> str:
    """What to tell of columns that are passed over, those first that may be one of those not `found`, with a slip of
    the pen; nothing where there is none."""
    names = {name for some in HEADERS.values() for name in some}
    unknown = [cell for cell in dict.fromkeys(header) if _plain_header(cell) and _plain_header(cell) not in names]
    if not unknown:
        return ""
    has_name = "name" in found or {"first", "last"} <= {*found}
    lacking = [column for column in HEADERS if column not in found and not (has_name and column in _OF_A_NAME)]
    owners = {name: column for column in lacking for name in HEADERS[column]}
    meant = {cell: nearest(_plain_header(cell), owners) for cell in unknown}
    asked = [f"{cell!r} (is it {_typed(owners[name])}?)" for cell, name in meant.items() if name is not None]
    asked += [repr(cell) for cell, name in meant.items() if name is None]
    what = "column" if len(unknown) == 1 else "columns"
    known = ", ".join(map(_typed, HEADERS))
    return f"{path}:1: nothing is read from the {what} {join_some(asked, _MAX_NAMED)}; read are {known}"


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


_ZIP = b"PK\x03\x04"  # as the files of spreadsheets begin


def _text(path: Path) -> str:
    try:
        with path.open("rb") as file:
            data = file.read(_MAX_BYTES + 1)
    except OSError as error:
        expected = "expected a CSV file with a column id, name or email"
        raise UsageError(f"{path}: the roster cannot be read: {reason(error)}; {expected}{like(path)}") from error
    if len(data) > _MAX_BYTES:
        raise UsageError(f"{path}: is larger than {_MAX_BYTES >> 20} MB; expected a roster")
    if data.startswith(_ZIP):
        raise UsageError(f"{path}: is a workbook or an archive; save the roster as `CSV UTF-8`")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise UsageError(
            f"{path}:{decode_error_position(error)}: is not UTF-8; save the roster as `CSV UTF-8`"
        ) from error


def _rows(text: str, path: Path) -> Iterable[tuple[int, list[str]]]:
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter_of(text), strict=True)
    line = 1
    try:
        for row in reader:
            if any(cell.strip() for cell in row):
                yield reader.line_num, row
            line = reader.line_num + 1
    except csv.Error as error:
        open_quote = "a cell that begins with a quotation mark has no second one at its end"
        why = open_quote if "end of data" in str(error) else str(error)
        raise UsageError(f"{path}:{line}: is not CSV: {why}") from error


def _cell(field: str, text: str) -> str:
    """A submission is called what entries are; everything else is what people see, and what they would type."""
    return one_line(text if field == "submission" else visible_text(text)).strip()


def read_roster(path: Path, say: Callable[[str], None] = lambda words: None) -> list[Student]:
    """All students, in the order of the file; `say` is told of columns that nobody knows."""
    rows = iter(_rows(_text(path), path))
    _, header = next(rows, (1, [""]))
    header = [_cell("", cell) for cell in header]
    columns = _columns(header, path)
    unknown = _unknown_columns(header, columns, path)
    if unknown:
        say(unknown)
    students: list[Student] = []
    lines: dict[tuple[str, str], int] = {}
    for line, row in rows:
        cells = {field: _cell(field, row[column]) if column < len(row) else "" for field, column in columns.items()}
        name = cells.get("name") or f"{cells.get('first', '')} {cells.get('last', '')}".strip()
        student = Student(
            line,
            cells.get("id", ""),
            name,
            cells.get("email", ""),
            cells.get("submission", ""),
            _time(cells.get("submitted_at", ""), f"{path}:{line}"),
            cells.get("repository", ""),
        )
        if not student.shown:
            raise UsageError(f"{path}:{line}: expected an id, a name or an email address")
        # Two students of one name need something else that tells them apart.
        alone = "" if student.id or student.email else student.name
        for kind, value in (("id", student.id), ("email", student.email), ("name", alone)):
            if value and lines.setdefault((kind, folded(value)), line) != line:
                other = lines[kind, folded(value)]
                raise UsageError(f"{path}:{line}: the {kind} {value!r} stands in line {other}, too")
        students.append(student)
    if not students:
        raise UsageError(f"{path}: expected a line for each student below the header, found none")
    return students


# Which entry belongs to which student. Only the roster and the entry's own name count. The name must be the student's
# id, email address or name, or begin with it: the beginning is what a learning platform writes, while the end may be
# a file name that a student chose.

_ACCENTS = re.compile("[\u0300-\u036f]")
_NAMED = re.compile(r"⟨U\+[0-9A-F]{4,6}⟩")  # a sign that nobody sees, as an entry is shown


@dataclass
class Matches:
    """Indices of entries and students that belong together, and what to tell about the others."""

    pairs: list[tuple[int, int]] = field(default_factory=list)
    entry_notes: dict[int, str] = field(default_factory=dict)
    student_notes: dict[int, str] = field(default_factory=dict)


def _words(text: str) -> str:
    return re.sub(r"[\W_]+", "_", folded(visible_text(_NAMED.sub("", text)))).strip("_")


def _plain(text: str) -> str:
    """Without accents, too: platforms and students leave them out."""
    return _words(_ACCENTS.sub("", unicodedata.normalize("NFKD", text)))


def _squeezed(name: str) -> set[str]:
    """`Ann Lee` as Canvas writes it, the last name first and without blanks; nobody knows where that begins."""
    words = _plain(name).split("_")
    return {"".join(words[at:] + words[:at]) for at in range(len(words))} if len(words) > 1 else set()


def _fits_platform(student: Student, entry: str) -> tuple[bool, int]:
    """By the name and the number that Canvas or Moodle put at the beginning. The number alone is no evidence against
    another name: it may be of another kind than those of the roster."""
    name, number = platform_identity(entry)
    if not number:
        return (False, 0)
    named = bool(student.name) and (
        "".join(_plain(name).split("_")) in _squeezed(student.name) or _plain(name) == _plain(student.name)
    )
    numbered = _plain(student.id) in (number, f"participant_{number}")
    if numbered and not student.name:
        return (False, 1)  # anybody whom the name fits comes first
    if numbered and named:
        return (True, len(name) + len(number))
    return (False, len(name)) if named and len(_plain(student.name).split("_")) > 1 else (False, 0)


def _fit(student: Student, entry: str) -> tuple[bool, int]:
    """Whether the entry's name is the student's, and how much of it; (False, 0) when it is not."""
    best = _fits_platform(student, entry)
    entry = _plain(entry)
    words = [student.id, student.email, student.name]
    for word in map(_plain, words):
        if word and entry == word:
            return (True, len(word))
        # A single first name at the beginning is no evidence: there may be an Ann Miller who is not on the roster.
        if word and entry.startswith(word + "_") and (word != _plain(student.name) or "_" in word):
            best = max(best, (False, len(word)))
    if student.email and entry == _plain(student.email.split("@")[0]):
        best = max(best, (True, 1))
    return best


def _is_spelled(student: Student, entry: str) -> bool:
    """Whether all words of the name stand there with their accents."""
    return bool(student.name) and all(word in _words(entry) for word in _words(student.name).split("_"))


def _best(students: list[Student], open_to: list[int], name: str) -> list[int]:
    """Who fits best; of people whose names differ in accents only, whom an entry with accents is spelled like."""
    fits = {number: fit for number in open_to if (fit := _fit(students[number], name)) != (False, 0)}
    best = [number for number, fit in fits.items() if fit == max(fits.values())]
    if len(best) > 1 and _words(name) != _plain(name):
        spelled = [number for number in best if _is_spelled(students[number], name)]
        best = spelled if len(spelled) == 1 else best
    return best


def _named(entries: list[str], name: str) -> list[int]:
    same = [at for at, entry in enumerate(entries) if entry == name]
    return same or [at for at, entry in enumerate(entries) if stem(entry).casefold() == stem(name).casefold()]


def _why_unmatched(name: str, students: list[Student]) -> str:
    """What to say of an entry that fits nobody: who has the same words in another order is asked about, not taken."""
    words = sorted(_plain(name).split("_"))
    there = [student for student in students if student.name and sorted(_plain(student.name).split("_")) == words]
    alike = [f"{one.name} ({one.shown})" if one.shown != one.name else one.name for one in there]
    asked = f" Is it that of {' or '.join(alike)}, with the last name first?" if alike else ""
    return f'Nobody on the roster has this name; say whose it is in the column "submission".{asked}'


def match(entries: list[str], students: list[Student]) -> Matches:
    """Pairs entries and students. Several students may share an entry that the roster names for each of them."""
    matches = Matches()
    claimed: set[int] = set()
    for number, student in enumerate(students):
        if not student.submission:
            continue
        found = _named(entries, student.submission)
        claimed.update(found)
        matches.pairs += [(at, number) for at in found]
        if not found:
            matches.student_notes[number] = f"The roster names the submission {student.submission}, which is not there."
    for at, entry in enumerate(entries):
        if at in claimed:
            continue
        name = stem(entry)
        best = _best(students, [number for number, student in enumerate(students) if not student.submission], name)
        if len(best) == 1:
            matches.pairs.append((at, best[0]))
        elif best:
            shown = ", ".join(students[number].shown for number in best)
            matches.entry_notes[at] = f"Its name fits several students ({shown}), so it was given to none of them."
        elif students:
            matches.entry_notes[at] = _why_unmatched(name, students)
    return matches
