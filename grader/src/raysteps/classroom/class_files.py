"""The files that are made from the database: of each submission results.json, its page, pictures and cases; of the
class two tables and a page.
"""

import csv
import io
import sqlite3
import sys
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from raysteps.classroom.annotations import annotated, is_unwritten, latest_serial, note_written
from raysteps.classroom.class_document import class_document, hand_in, read_class_document, steps_of
from raysteps.classroom.database import CLASS_JSON, SUBMISSIONS, ClassDatabase, open_readonly
from raysteps.classroom.database import FILE as DATABASE
from raysteps.classroom.review import reviewed
from raysteps.common.documents import as_text, plain
from raysteps.common.errors import UsageError, reason
from raysteps.common.files import forget_unfinished, write_bytes, write_if_changed, write_json
from raysteps.common.platform import kit_command
from raysteps.common.text import escape_formula, number
from raysteps.course.manifest import Step
from raysteps.grading.withhold import withhold
from raysteps.report import class_page as class_report
from raysteps.report.class_page import write_class_report
from raysteps.report.student import try_student_page
from raysteps.results.class_model import ClassResults, GradedSubmission, Student
from raysteps.results.model import Feedback, Results
from raysteps.results.store import CASES_FOLDER, REPORT, RESULTS, stored_results

# CSV that a spreadsheet shows and never runs.

Cell = str | float | int | None


def safe_cell(value: Cell) -> str:
    """Text is made harmless; numbers stay numbers."""
    if value is None:
        return ""
    if isinstance(value, (int, float)):
        return number(value)
    return escape_formula(value)


def csv_bytes(rows: Iterable[Sequence[Cell]]) -> bytes:
    """With a byte order mark: without it, Excel takes UTF-8 for something else."""
    out = io.StringIO(newline="")
    writer = csv.writer(out)
    for row in rows:
        writer.writerow([safe_cell(cell) for cell in row])
    return out.getvalue().encode("utf-8-sig")


_TABLES = ("results.csv", CLASS_JSON)


def _forget_files(folder: Path, kept: set[str]) -> None:
    """Pictures and cases of an earlier result must not be taken for those of this one."""
    for room, ending in ((folder / "pictures", "*.png"), (folder / CASES_FOLDER, "*.json")):
        if room.is_symlink() or not room.is_dir():
            continue
        for path in list(room.rglob(ending)):
            if path.relative_to(folder).as_posix() not in kept and path.resolve().is_relative_to(room.resolve()):
                path.unlink(missing_ok=True)
        for place in (room, *room.rglob("*/")):
            if not place.is_symlink():
                forget_unfinished(place)


def _withheld_cases(results: Results | None, names: Iterable[str]) -> set[str]:
    """Cases that were kept, but that the results for students do not name."""
    named = {item.case for step in results.steps for item in step.hidden} if results is not None else set()
    return {name for name in names if name.startswith(f"{CASES_FOLDER}/") and name not in named}


def _warn(words: str) -> None:
    print(f"raysteps: {words}", file=sys.stderr)


def write_submission(
    database: ClassDatabase,
    out: Path,
    one: GradedSubmission,
    course: str,
    steps: Sequence[Step],
    feedback: Feedback | None = None,
) -> None:
    """The result that counts. Of a fault there is only fault.txt. `course` and `steps` are the run's, and so is how
    much it tells, where nothing else is said."""
    name = one.name
    row = database.current(name)
    folder = out / SUBMISSIONS / name
    if row is None:
        return
    stored = stored_results(row["document"])
    if stored is None and row["document"]:
        _warn(f"{name}: a kit of another form graded it; grade it again")
        _forget_files(folder, set())
        for left in (RESULTS, REPORT):
            (folder / left).unlink(missing_ok=True)
        return
    results = None
    if stored is not None:
        full = reviewed(database, row["submission"], row["run"], stored, steps).results
        told = withhold(full, feedback or database.feedback())
        results = replace(told, course=course, handed_in=hand_in(one), earlier=one.earlier)
    files = database.pictures(row["submission"], row["run"])
    shown = set(files) - _withheld_cases(results, files)
    _forget_files(folder, shown)
    forget_unfinished(folder)
    changed = [write_if_changed(folder / path, files[path]) for path in sorted(shown)]
    if results is not None:
        changed.append(write_if_changed(folder / RESULTS, as_text(results).encode()))
        if any(changed) or not (folder / REPORT).is_file():
            try_student_page(folder, steps, lambda words: _warn(f"{name}: {words}"))
        (folder / "fault.txt").unlink(missing_ok=True)
    else:
        write_bytes(folder / "fault.txt", f"{row['fault']}\n\n{row['details']}\n".encode("utf-8", "replace"))
        for left in (RESULTS, REPORT):
            (folder / left).unlink(missing_ok=True)


_HEAD = ("submission", "entry", "id", "name", "email", "status", "points", "max", "late_points")
_TAIL = ("submitted_at", "days_late", "percent_off", "lateness", "points_before", "fault", "note")
_BY_HAND = ("automatic_points", "changed_by_hand", "look_again", "open_requests")


def _row(one: GradedSubmission, student: Student, steps: list[str]) -> list[Cell]:
    late = one.late
    return [
        *(one.name, one.entry, student.id, student.name, student.email),
        *(one.status, one.points, one.max, late.points if late is not None else None),
        *(one.steps[step].points if step in one.steps else None for step in steps),
        one.submitted_at,
        *((late.days, late.percent, late.words) if late is not None else (None, None, "")),
        one.before.points if one.before is not None else None,
        *(one.fault, " ".join(one.why_unread)),
        *_by_hand(one),
    ]


def _by_hand(one: GradedSubmission) -> list[Cell]:
    """What people changed; empty where nobody did."""
    review = one.review
    automatic = review.automatic if review.changes else None
    return [automatic, "; ".join(review.changes), "; ".join(review.look_again), review.open_requests or None]


def _rows(document: ClassResults) -> Iterator[list[Cell]]:
    """A row for each student of a submission, one for a submission of nobody, one for a student without one."""
    steps = [step.id for step in document.steps]
    yield [*_HEAD, *steps, *_TAIL, *_BY_HAND]
    nobody = Student("", "", "")
    for one in document.submissions:
        for student in one.students or [nobody]:
            yield _row(one, student, steps)
    for student in document.students_without_submission:
        blank = [None] * (len(steps) + 3)
        head = ("", "", student.id, student.name, student.email, "no submission")
        yield [*head, *blank, *([None] * (len(_TAIL) - 1)), student.note, *([None] * len(_BY_HAND))]


def withdraw_tables(out: Path) -> None:
    """Before the first result changes: tables of earlier results beside new ones would be taken for theirs."""
    for name in (*_TABLES, class_report.FILE):
        (out / name).unlink(missing_ok=True)


def write_class(database: ClassDatabase, out: Path, done: Collection[str] = ()) -> ClassResults:
    """Everything but what is done: also what a run that was killed had no time for, and what people said since it was
    done."""
    serial = latest_serial(database.connection)
    document = class_document(database)
    steps = steps_of(document.steps)
    still_to_do = {one.name for one in document.submissions} - (set(done) - annotated(database))
    for one in document.submissions:
        if one.name in still_to_do:
            write_submission(database, out, one, document.course, steps)
    forget_unfinished(out)
    write_tables(database, out, document, serial)
    return document


def write_tables(database: ClassDatabase, out: Path, document: ClassResults, serial: int) -> None:
    """What is made of the whole class; `serial` is the last annotation that the document surely knows of."""
    table, facts = _TABLES
    write_bytes(out / table, csv_bytes(_rows(document)))
    write_json(out / facts, plain(document))
    class_report.try_class_report(document, out, _warn)
    note_written(database, serial)


def refuse_unwritten(out: Path) -> None:
    """Files that do not hold what people changed since must not be given to anybody."""
    path = out / DATABASE
    if not path.is_file():
        return
    with open_readonly(path) as connection:
        if is_unwritten(connection):
            raise UsageError(
                f"{out}: comments or points were changed after its files were made; "
                f"`{kit_command('desk', out, '--write')}` makes them anew"
            )


# Makes the page of a class anew from what a grading left.


def class_source(place: Path) -> Path | None:
    """What the class is read from, when the place is a class: its folder, its database or its class.json."""
    if place.name in (DATABASE, CLASS_JSON) and place.is_file():
        return place
    return next((place / name for name in (DATABASE, CLASS_JSON) if (place / name).is_file()), None)


def _from_database(path: Path) -> ClassResults:
    with open_readonly(path) as connection:
        try:
            return class_document(ClassDatabase(path.parent, connection))
        except (sqlite3.Error, ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
            # of these, all but the first say that a column holds what no run wrote
            raise UsageError(
                f"{path}: cannot be read as the database of a class: {error}; if an older kit wrote it, "
                "run grade-class with --resume"
            ) from error


def remake_class_page(source: Path) -> Path:
    """class.html beside the source."""
    document = _from_database(source) if source.suffix == Path(DATABASE).suffix else read_class_document(source)
    try:
        return write_class_report(document, source.parent)
    except OSError as error:
        raise UsageError(f"{source.parent}: class.html cannot be written: {reason(error)}") from error
