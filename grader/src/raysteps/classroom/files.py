"""The files that are made from the database: of each submission results.json, its page, pictures and cases; of the
class two tables and a page."""

import json
import sys
from collections.abc import Container, Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

from raysteps.classroom.database import ClassDatabase
from raysteps.classroom.spreadsheet import Cell, csv_bytes
from raysteps.common.files import forget_unfinished, write_bytes, write_if_changed, write_json
from raysteps.judge.feedback import withhold
from raysteps.kit.manifest import Step, read_steps
from raysteps.kit.project import here
from raysteps.reports import class_report
from raysteps.reports.student import REPORT, try_student_page
from raysteps.results.case_places import FOLDER as CASES

SUBMISSIONS = "submissions"
_TABLES = ("results.csv", "class.json")


def _forget_files(folder: Path, kept: set[str]) -> None:
    """Pictures and cases of an earlier result must not be taken for those of this one."""
    for room, ending in ((folder / "pictures", "*.png"), (folder / CASES, "*.json")):
        if room.is_symlink() or not room.is_dir():
            continue
        for path in list(room.rglob(ending)):
            if path.relative_to(folder).as_posix() not in kept and path.resolve().is_relative_to(room.resolve()):
                path.unlink(missing_ok=True)
        for place in (room, *room.rglob("*/")):
            if not place.is_symlink():
                forget_unfinished(place)


def _withheld_cases(document: dict[str, Any] | None, names: Iterable[str]) -> set[str]:
    """Cases that were kept, but that the results for students do not name."""
    steps = document.get("steps", []) if document else []
    named = {item.get("case", "") for step in steps for item in step["hidden"]}
    return {name for name in names if name.startswith(f"{CASES}/") and name not in named}


def _warn(words: str) -> None:
    print(f"raysteps: {words}", file=sys.stderr)


@cache
def _steps() -> list[Step]:
    return read_steps(here())


def write_submission(database: ClassDatabase, out: Path, name: str) -> None:
    """The result that counts. Of a fault there is only fault.txt."""
    row = database.current(name)
    folder = out / SUBMISSIONS / name
    if row is None:
        return
    document = withhold(json.loads(row["document"]), database.feedback()) if row["document"] else None
    files = database.pictures(row["submission"], row["run"])
    shown = set(files) - _withheld_cases(document, files)
    _forget_files(folder, shown)
    forget_unfinished(folder)
    changed = [write_if_changed(folder / path, files[path]) for path in sorted(shown)]
    if document is not None:
        text = json.dumps(document, indent=2, ensure_ascii=False) + "\n"
        changed.append(write_if_changed(folder / "results.json", text.encode()))
        if any(changed) or not (folder / REPORT).is_file():
            try_student_page(folder, _steps(), lambda words: _warn(f"{name}: {words}"))
        (folder / "fault.txt").unlink(missing_ok=True)
    else:
        write_bytes(folder / "fault.txt", f"{row['fault']}\n\n{row['details']}\n".encode("utf-8", "replace"))
        for result in ("results.json", REPORT):
            (folder / result).unlink(missing_ok=True)


_HEAD = ("submission", "entry", "id", "name", "email", "status", "points", "max", "late_points")
_TAIL = ("submitted_at", "days_late", "percent_off", "lateness", "inconsistent", "points_before", "fault", "note")


def _row(one: dict[str, Any], student: dict[str, str], steps: list[str]) -> list[Cell]:
    late = one["late"] or {"days": None, "percent": None, "points": None, "words": ""}
    return [
        *(one["name"], one["entry"], student["id"], student["name"], student["email"]),
        *(one["status"], one["points"], one["max"], late["points"]),
        *(one["steps"][step]["points"] if step in one["steps"] else None for step in steps),
        *(one["submitted_at"], late["days"], late["percent"], late["words"]),
        "yes" if one["inconsistent"] else "",
        one["before"]["points"] if one["before"] is not None else None,
        *(one["fault"], one["note"]),
    ]


def _rows(document: dict[str, Any]) -> Iterator[list[Cell]]:
    """A row for each student of a submission, one for a submission of nobody, one for a student without one."""
    steps = [step["id"] for step in document["steps"]]
    yield [*_HEAD, *steps, *_TAIL]
    nobody = {"id": "", "name": "", "email": ""}
    for one in document["submissions"]:
        for student in one["students"] or [nobody]:
            yield _row(one, student, steps)
    for student in document["students_without_submission"]:
        blank = [None] * (len(steps) + 3)
        head = ("", "", student["id"], student["name"], student["email"], "no submission")
        yield [*head, *blank, *([None] * (len(_TAIL) - 1)), student["note"]]


def withdraw_tables(out: Path) -> None:
    """Before the first result changes: tables of earlier results beside new ones would be taken for theirs."""
    for name in (*_TABLES, class_report.FILE):
        (out / name).unlink(missing_ok=True)


def write_class(database: ClassDatabase, out: Path, document: dict[str, Any], done: Container[str] = ()) -> None:
    """Everything but what is done: also what a run that was killed had no time for."""
    for one in document["submissions"]:
        if one["name"] not in done:
            write_submission(database, out, one["name"])
    forget_unfinished(out)
    table, facts = _TABLES
    write_bytes(out / table, csv_bytes(_rows(document)))
    write_json(out / facts, document)
    class_report.try_class_report(document, out, _warn)
