"""Reads what grade-class left: results.csv, and beside it a results.json for each submission."""

import csv
import io
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from raysteps.classroom.class_files import refuse_unwritten
from raysteps.classroom.database import SUBMISSIONS
from raysteps.classroom.entries import folded, platform_identity
from raysteps.common.errors import UsageError, reason
from raysteps.common.text import FORMULA_SIGNS, escape_formula, join_and, number, tenths, unescape_formula
from raysteps.course.manifest import Step
from raysteps.exports.items import as_html, summary
from raysteps.results.model import SAME_POINTS, Results
from raysteps.results.store import RESULTS, read_results

_WHO = ("submission", "id", "name", "email")
_NEEDED = (*_WHO, "points", "max")


@dataclass(frozen=True)
class GradedStudent:
    """One row of results.csv; no points where there is no grade, no submission where nothing was handed in."""

    submission: str
    id: str
    name: str
    email: str
    in_time: float | None  # the points as graded
    points: float | None  # those that count, after lateness
    most: float
    entry: str = ""  # as it is called in the folder that was handed in
    status: str = ""

    @property
    def known(self) -> bool:
        """Whether there was a roster; else only the name of the submission tells whose it is."""
        return bool(self.id or self.name or self.email)

    @property
    def ids(self) -> frozenset[str]:
        """What people are called by: a student number, a login."""
        return frozenset(filter(None, [self.id if self.known else self.submission]))

    @property
    def numbers(self) -> frozenset[str]:
        """What Canvas or Moodle itself may count this student by."""
        said = self.id if self.known else platform_identity(self.submission)[1] or self.submission
        return frozenset(filter(None, [said]))

    @property
    def label(self) -> str:
        who = ", ".join(dict.fromkeys(filter(None, [self.name, self.id, self.email])))
        return f"{self.submission} ({who})" if who and self.submission else self.submission or who


def _number(path: Path, line: int, column: str, text: str) -> float | None:
    if not text.strip():
        return None
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or value < 0:
        raise UsageError(f"{path}:{line}: {column} is '{text}', expected a number")
    return value


def _graded(path: Path, line: int, row: dict[str, str]) -> GradedStudent:
    points = _number(path, line, "points", row["points"])
    late = _number(path, line, "late_points", row.get("late_points") or "")
    most = _number(path, line, "max", row["max"])
    who = {name: unescape_formula((row.get(name) or "").strip()) for name in (*_WHO, "entry", "status")}
    return GradedStudent(**who, in_time=points, points=points if late is None else late, most=most or 0.0)


def _why_not(folder: Path, error: OSError) -> str:
    wanted = "--results wants the folder that grade-class wrote (its --out)"
    if folder.is_file():
        return f"{folder}: is a file; {wanted}"
    if not folder.exists():
        return f"{folder}: is not there; {wanted}"
    if isinstance(error, FileNotFoundError):
        return f"{folder}: holds no results.csv; {wanted}, after grade-class has come to its end"
    return f"{folder / 'results.csv'}: cannot be read: {reason(error)}; {wanted}"


def read_class(folder: Path) -> list[GradedStudent]:
    """The rows of FOLDER/results.csv."""
    path = folder / "results.csv"
    refuse_unwritten(folder)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise UsageError(_why_not(folder, error)) from error
    except ValueError as error:
        raise UsageError(
            f"{path}: is not UTF-8, as when another program has saved it; run grade-class with --resume, "
            "which writes it anew"
        ) from error
    reader = csv.DictReader(io.StringIO(text, newline=""), restval="")
    try:
        missing = [name for name in _NEEDED if name not in (reader.fieldnames or [])]
        if missing:
            raise UsageError(f"{path}: has no column {', '.join(missing)}; expected the output folder of grade-class")
        rows = [_graded(path, reader.line_num, row) for row in reader]
    except csv.Error as error:
        raise UsageError(f"{path}:{reader.line_num}: is not CSV: {error}") from error
    if not rows:
        raise UsageError(f"{path}: holds no submission")
    return rows


def results_of(folder: Path, graded: GradedStudent) -> Results | None:
    """The results.json of a submission, or None where there is none; it must be what the row was made from."""
    home = (folder / SUBMISSIONS).resolve()
    path = (home / graded.submission / RESULTS).resolve()
    if not path.is_relative_to(home) or not path.is_file():
        return None
    results = read_results(path)
    if graded.in_time is None or abs(results.total.points - graded.in_time) > SAME_POINTS:
        raise UsageError(
            f"{path}: is of another run than results.csv, whose points for {graded.label} are not those; "
            "run grade-class with --resume again, which writes both"
        )
    return results


# Finds the row of a gradebook that belongs to a submission.

_NUMBER_AT_END = re.compile(r"[0-9]+$")


@dataclass(frozen=True)
class Person:
    """Who a row of the gradebook is about, from the best evidence to the least."""

    label: str
    emails: frozenset[str]
    ids: frozenset[str]  # student number, login
    numbers: frozenset[str]  # what the platform itself counts people by
    name: str


@dataclass
class Rows:
    """From submissions to rows, by index; and why a row that looks right was not taken."""

    found: dict[int, int] = field(default_factory=dict)
    doubts: dict[int, str] = field(default_factory=dict)


def spoken_name(text: str) -> str:
    """`Lee, Ann` and `Ann Lee` are one name."""
    last, comma, first = text.partition(",")
    return folded(f"{first} {last}" if comma and "," not in first else text)


def number_at_end(text: str) -> str:
    """`Participant 123` is 123, in whatever language Moodle wrote it."""
    found = _NUMBER_AT_END.search(text)
    return found.group() if found else ""


def _emails(graded: GradedStudent) -> frozenset[str]:
    return frozenset(word for word in map(folded, (graded.email, *graded.ids)) if "@" in word)


def _is_another(graded: GradedStudent, person: Person) -> bool:
    """Whether a name or an email says so: numbers of different kinds may be alike by chance."""
    words, theirs = set(spoken_name(graded.name).split()), set(person.name.split())
    if words and theirs:
        return not (words <= theirs or theirs <= words)
    emails = _emails(graded)
    return bool(emails and person.emails and not emails & person.emails)


def _sure(graded: GradedStudent, people: Sequence[Person]) -> tuple[list[int], list[int]]:
    """The rows that an email address or a number speaks for, and those that a number alone does against the rest."""
    emails, ids, numbers = _emails(graded), set(map(folded, graded.ids)), set(map(folded, graded.numbers))
    by_email = [at for at, one in enumerate(people) if emails & one.emails]
    by_id = [at for at, one in enumerate(people) if ids & one.ids]
    by_number = [at for at, one in enumerate(people) if numbers & one.numbers] if not by_email else []
    words = {at for at in by_id if any(not word.isdecimal() for word in ids & people[at].ids)}
    alone = [at for at in (*by_id, *by_number) if at not in words and at not in by_email]
    doubtful = [at for at in alone if _is_another(graded, people[at])]
    return sorted({*by_email, *by_id, *by_number} - set(doubtful)), doubtful


def match(graded: Sequence[GradedStudent], people: Sequence[Person]) -> Rows:
    """One that fits no row is left out. Whatever fits twice is an error."""
    rows = Rows()
    taken: dict[int, int] = {}
    for at, one in enumerate(graded):
        fits, doubtful = _sure(one, people)
        name = spoken_name(one.name)
        fits = fits or [row for row, person in enumerate(people) if name and person.name == name]
        if len(fits) > 1:
            which = join_and([people[row].label for row in fits])
            raise UsageError(f"{one.label} fits more than one row: {which}; make their identities differ")
        if not fits:
            if doubtful:
                rows.doubts[at] = f"{people[doubtful[0]].label} has that number, but another name or email address"
            continue
        if fits[0] in taken:
            both = join_and([graded[taken[fits[0]]].label, one.label])
            raise UsageError(f"{both} both fit {people[fits[0]].label}; remove one of them from results.csv")
        rows.found[at] = fits[0]
        taken[fits[0]] = at
    return rows


# The feedback on a submission as the cell of a gradebook.

_LIMIT = 8000
_SIGNS = re.compile(rf"(?<=;)[\s{re.escape(FORMULA_SIGNS)}]+")


def _plain_signs(html: str) -> str:
    """An entity ends with a semicolon: what a spreadsheet might take for a formula after it becomes one, too."""
    signs = {ord(one): f"&#{ord(one)};" for one in FORMULA_SIGNS}
    return _SIGNS.sub(lambda found: found[0].translate(signs), html)


def moodle_cell(results: Results | None, graded: GradedStudent, steps: Mapping[str, Step]) -> str | None:
    """What the results say, as HTML on one line: Moodle shows comments as HTML. None where there are none."""
    if results is None:
        return None
    lines = [summary(results, steps, checks=True)]
    told = results.handed_in is not None and results.handed_in.late is not None  # an older kit did not
    if not told and graded.points is not None and graded.in_time is not None and graded.points != graded.in_time:
        lines.insert(0, f"{tenths(graded.in_time)} points, {number(graded.points)} after lateness.")
    return escape_formula(_plain_signs(as_html("\n".join(lines), _LIMIT)))
