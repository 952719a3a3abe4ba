"""Reads what grade-class left: results.csv, and beside it a results.json for each submission."""

import csv
import io
import math
import re
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.cells import harmless_cell
from raysteps.common.errors import UsageError
from raysteps.exports.reading import read_results
from raysteps.exports.summary import Document

_CANVAS_FILE = re.compile(r"[^_]+_(?:LATE_)?([0-9]+)_[0-9]+_")  # leeann_4711_815_steps
_MOODLE_FILE = re.compile(r"_([0-9]+)_assignsubmission_")  # Ann Lee_123_assignsubmission_file
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
    def ids(self) -> frozenset[str]:
        """What tells whose it is. Without a roster, the name that Canvas or Moodle gave to the file does."""
        if self.id or self.name or self.email:
            return frozenset(filter(None, [self.id]))
        found = _CANVAS_FILE.match(self.submission) or _MOODLE_FILE.search(self.submission)
        return frozenset([self.submission, *(found.groups() if found else ())])

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


def read_class(folder: Path) -> list[Graded]:
    """The rows of FOLDER/results.csv."""
    path = folder / "results.csv"
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        raise UsageError(f"{path}: cannot be read ({error}); expected the output folder of grade-class") from error
    reader = csv.DictReader(io.StringIO(text, newline=""), restval="")
    missing = [name for name in _NEEDED if name not in (reader.fieldnames or [])]
    if missing:
        raise UsageError(f"{path}: has no column {', '.join(missing)}; expected the output folder of grade-class")
    rows = []
    for row in reader:
        line = reader.line_num
        points = _number(path, line, "points", row["points"])
        late = _number(path, line, "late_points", row.get("late_points") or "")
        most = _number(path, line, "max", row["max"])
        who = {name: _unmarked(row[name].strip()) for name in ("submission", "id", "name", "email")}
        rows.append(Graded(**who, in_time=points, points=points if late is None else late, most=most or 0.0))
    if not rows:
        raise UsageError(f"{path}: holds no submission")
    return rows


def results_of(folder: Path, graded: Graded) -> Document | None:
    """The results.json of a submission, or None where there is none."""
    home = (folder / "submissions").resolve()
    path = (home / graded.submission / "results.json").resolve()
    if not path.is_relative_to(home) or not path.is_file():
        return None
    return read_results(path)
