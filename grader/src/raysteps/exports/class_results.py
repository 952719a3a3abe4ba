"""Reads what grade-class left: results.csv, and beside it a results.json for each submission."""

import csv
import io
import math
from dataclasses import dataclass
from pathlib import Path

from raysteps.classroom.names import platform_identity
from raysteps.common.cells import harmless_cell
from raysteps.common.errors import UsageError
from raysteps.exports.reading import read_results
from raysteps.exports.summary import Document

_ALIKE = 0.005  # points are written in hundredths
_NEEDED = ("submission", "id", "name", "email", "points", "max")


@dataclass(frozen=True)
class Graded:
    """One row of results.csv; no points where there is no grade, no submission where nothing was handed in."""

    submission: str
    id: str
    name: str
    email: str
    in_time: float | None  # the points as graded
    points: float | None  # those that count, after lateness
    most: float

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


def _unmarked(text: str) -> str:
    """Without the sign that keeps a spreadsheet from taking a text for a formula."""
    return text[1:] if text.startswith("'") and harmless_cell(text[1:]) == text else text


def _graded(path: Path, line: int, row: dict[str, str]) -> Graded:
    points = _number(path, line, "points", row["points"])
    late = _number(path, line, "late_points", row.get("late_points") or "")
    most = _number(path, line, "max", row["max"])
    who = {name: _unmarked(row[name].strip()) for name in ("submission", "id", "name", "email")}
    return Graded(**who, in_time=points, points=points if late is None else late, most=most or 0.0)


def _why_not(folder: Path, error: OSError) -> str:
    wanted = "--results wants the folder that grade-class wrote (its --out)"
    if folder.is_file():
        return f"{folder}: is a file; {wanted}"
    if not folder.exists():
        return f"{folder}: is not there; {wanted}"
    if isinstance(error, FileNotFoundError):
        return f"{folder}: holds no results.csv; {wanted}, after grade-class has come to its end"
    return f"{folder / 'results.csv'}: cannot be read: {error.strerror}; {wanted}"


def read_class(folder: Path) -> list[Graded]:
    """The rows of FOLDER/results.csv."""
    path = folder / "results.csv"
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


def results_of(folder: Path, graded: Graded) -> Document | None:
    """The results.json of a submission, or None where there is none; it must be what the row was made from."""
    home = (folder / "submissions").resolve()
    path = (home / graded.submission / "results.json").resolve()
    if not path.is_relative_to(home) or not path.is_file():
        return None
    document = read_results(path)
    if graded.in_time is None or abs(document["total"]["points"] - graded.in_time) > _ALIKE:
        raise UsageError(
            f"{path}: is of another run than results.csv, whose points for {graded.label} are not those; "
            "run grade-class with --resume again, which writes both"
        )
    return document
