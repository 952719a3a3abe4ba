"""What people say, from the page or from a file, as rows of the database; and these rows as a file."""

import csv
import hashlib
import io
import json
import math
import sqlite3
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

from raysteps.classroom.annotations import (
    Annotation,
    Kind,
    add_annotation,
    all_annotations,
    annotate,
    annotations_of,
    checked,
    code_mark,
    new_annotation,
    threads,
)
from raysteps.classroom.class_document import steps_of
from raysteps.classroom.class_files import Cell, csv_bytes
from raysteps.classroom.database import ClassDatabase, Source, transaction
from raysteps.classroom.entries import folded
from raysteps.classroom.review import item_words
from raysteps.classroom.roster import HEADERS, columns_of
from raysteps.common.documents import Malformed, as_text, convert, parse
from raysteps.common.errors import UsageError, reason
from raysteps.common.files import write_out
from raysteps.common.text import delimiter_of, join_and, join_some, number, one_line, unescape_formula
from raysteps.course.manifest import Step
from raysteps.report.student import parts_of
from raysteps.results.class_model import GradedStep
from raysteps.results.model import Part
from raysteps.results.store import stored_results

_LINE = 2_000  # characters of a line that are kept


@dataclass(frozen=True)
class AnnotationDraft:
    """What somebody wants to have written. `after`: the last row about it that was known then."""

    kind: Kind
    author: str
    subject: str = ""
    after: str = ""
    step: str = ""
    part: Part = ""
    line: int = 0
    text: str = ""
    answer: str = ""
    points: float = 0.0
    withdrawn: bool = False


def manifests_of(database: ClassDatabase) -> dict[str, Step]:
    """The kit's steps as the last run graded them."""
    (text,) = database.connection.execute("SELECT steps FROM runs ORDER BY number DESC LIMIT 1").fetchone()
    return {step.id: step for step in steps_of(convert(json.loads(text), list[GradedStep]))}


class AnnotationWriter:
    """Adds to what was said what it is about: the line of the code, the points that the grader gave."""

    def __init__(self, database: ClassDatabase, name: str) -> None:
        self._database = database
        self._name = name
        self._current = database.current(name)
        self._sources: dict[str, Source] = {}
        if self._current is not None:
            self._sources = database.sources(self._current["submission"], self._current["run"])

    def write(self, said: AnnotationDraft) -> None:
        annotate(self._database, self._name, self.annotation(said), after=said.after)

    def annotation(self, said: AnnotationDraft) -> Annotation:
        """Refuses what makes no sense."""
        more: dict[str, Any] = {
            key: value for key, value in asdict(said).items() if key not in ("kind", "author", "after")
        }
        source = self._sources.get(said.step)
        before = self._last(said.subject)
        if before is not None and said.kind in ("comment", "request"):  # it stays where it is
            more |= {key: getattr(before, key) for key in ("step", "line", "line_text", "source")}
        elif said.kind == "read":
            run = self._current["run"] if self._current is not None else None
            more["source"] = code_mark(self._database, self._sources, run)
        elif said.kind == "comment" and said.line:
            more |= self._line(source, said)
        elif said.kind == "comment" and source is not None:
            more["source"] = source.sha256
        if said.kind == "points":
            more["automatic"] = self._automatic(said)
        try:
            return new_annotation(said.kind, said.author, **more)
        except Malformed as error:
            raise UsageError(str(error)) from error

    def _last(self, subject: str) -> Annotation | None:
        """What held about it until now."""
        if self._current is None or not subject:
            return None
        found = threads(annotations_of(self._database, self._current["submission"]))
        return next((thread.last for thread in found if thread.last.subject == subject), None)

    def _line(self, source: Source | None, said: AnnotationDraft) -> dict[str, str]:
        lines = source.lines if source is not None else []
        if source is None or not 0 < said.line <= len(lines):
            raise UsageError(f"line {said.line}: the code of step {said.step[:2]} has {len(lines)} lines")
        return {"source": source.sha256, "line_text": lines[said.line - 1][:_LINE]}

    def _automatic(self, said: AnnotationDraft) -> float:
        """What the grader gives for the item; also whether there is such an item."""
        results = stored_results(self._current["document"]) if self._current is not None else None
        if results is None:
            raise UsageError("points: there is no result whose points could be changed")
        if not said.step:
            return results.total.points
        step = next((step for step in results.steps if step.id == said.step), None)
        if step is None:
            raise UsageError(f"step: {said.step} was not graded")
        most, automatic = step.max, step.points
        if said.part:
            parts = parts_of(step, manifests_of(self._database).get(said.step))
            part = next((part for part in parts if part.name == said.part), None)
            if part is None:
                raise UsageError(f"part: step {said.step[:2]} has no points for {said.part}")
            most, automatic = part.most, part.earned
        if said.points < 0 and not said.withdrawn:
            raise UsageError(
                f"points: {item_words(said.step, said.part)} has 0 to {number(most)}, found {number(said.points)}; "
                "more can be taken away from the submission as a whole"
            )
        if said.points > most and not said.withdrawn:
            raise UsageError(
                f"points: {item_words(said.step, said.part)} has at most {number(most)}; "
                "more can be given for the submission as a whole"
            )
        return automatic


# A file of all that was said, with its history: what people did in copies of a class comes together in one.


@dataclass(frozen=True, kw_only=True)
class EntryAnnotation(Annotation):
    """`entry`: what the submission is called in the folder that was handed in."""

    entry: str


@dataclass(frozen=True)
class AnnotationFile:
    schema: Literal["raysteps/annotations/v1"]
    annotations: list[EntryAnnotation] = field(default_factory=list)


def export_file(database: ClassDatabase, path: Path) -> int:
    """All rows as JSON; into a file that ends in .csv what holds now. Gives their number."""
    if path.suffix.lower() not in (".json", ".csv"):
        raise UsageError(f"{path}: expected a name that ends in .json, for all of it, or in .csv, for a table")
    rows = all_annotations(database)
    if path.suffix.lower() == ".csv":
        table = list(_csv_rows(database, rows))
        write_out(path, csv_bytes([_COLUMNS, *table]))
        return len(table)
    found = [EntryAnnotation(entry=entry, **asdict(one)) for entry, one in rows]
    write_out(path, as_text(AnnotationFile("raysteps/annotations/v1", found)).encode())
    return len(found)


def import_file(database: ClassDatabase, path: Path, author: str) -> int:
    """All of it or nothing; what is there already is left alone. Gives how many rows are new."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {reason(error)}") from error
    if path.suffix.lower() == ".csv":
        return _import_csv(database, path, data, author)
    try:
        found = parse(data, AnnotationFile).annotations
        rows = [(one.entry, checked(one)) for one in found]
    except Malformed as error:
        raise UsageError(f"{path}: is not what `desk --export` writes: {error}") from error
    ids = {row["entry"]: row["id"] for row in database.connection.execute("SELECT entry, id FROM submissions")}
    strangers = sorted({entry for entry, _ in rows if entry not in ids})
    if strangers:
        raise UsageError(f"{path}: {join_and(strangers[:5])}: no such submission in {database.path}; nothing was taken")
    with transaction(database.connection):
        return sum(add_annotation(database, ids[entry], _plain(one)) for entry, one in rows)


def _plain(one: Annotation) -> Annotation:
    return Annotation(**{name: value for name, value in asdict(one).items() if name != "entry"})


# A table, for scripts and spreadsheets: such as the answers of a form that asks for regrades.

_COLUMNS = ("submission", "kind", "step", "part", "line", "points", "text", "answer", "author", "at")
_CALLED = {  # as headers of the roster are; the first that is there counts
    **{column: (column,) for column in _COLUMNS},
    **{column: HEADERS[column] for column in ("id", "email")},
    "submission": ("submission", "entry"),
    "kind": ("kind", "type"),
    "step": ("step", "exercise", "task"),
    "line": ("line", "linenumber"),
    "points": ("points", "score"),
    "text": ("text", "message", "request", "question", "comment", "reason"),
    "answer": ("answer", "reply", "response"),
    "author": ("author", "by"),
}
_NEEDED = ("kind", "text")
_KINDS = ("comment", "points", "request")
_MAX_NAMED = 8  # columns, where one is missing


def _csv_rows(database: ClassDatabase, rows: list[tuple[str, Annotation]]) -> Iterator[list[Cell]]:
    names = database.names()
    by_entry: dict[str, list[Annotation]] = {}
    for entry, one in rows:
        by_entry.setdefault(entry, []).append(one)
    for entry, mine in by_entry.items():
        for thread in threads(mine):
            one = thread.last
            if one.kind in _KINDS and not one.withdrawn:
                points = one.points if one.kind == "points" else None
                yield [
                    *(names[entry], one.kind, one.step, one.part, one.line or None, points),
                    *(one.text, one.answer, one.author, one.at),
                ]


class _Table:
    """Finds the submission that a row is about."""

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._found: dict[str, set[str]] = {}
        for row in connection.execute("SELECT name, entry FROM submissions WHERE scope = 'here'"):
            for word in (row["name"], row["entry"]):
                self._found.setdefault(folded(word), set()).add(row["name"])
        for row in connection.execute(
            "SELECT submissions.name, students.id, email FROM students JOIN handed_in ON student = number "
            "JOIN submissions ON submissions.id = submission WHERE scope = 'here'"
        ):
            for word in filter(None, (row["id"], row["email"])):
                self._found.setdefault(folded(word), set()).add(row["name"])

    def name(self, row: dict[str, str], place: str) -> str:
        for column in ("submission", "id", "email"):
            if word := row.get(column, ""):
                names = self._found.get(folded(word), set())
                if len(names) == 1:
                    return next(iter(names))
                many = "several submissions are" if names else "no submission is"
                raise UsageError(f"{place}: {many} of {column} {word}")
        raise UsageError(f"{place}: expected a submission, an id or an email address")


def _number(text: str, column: str, place: str) -> float:
    try:
        found = float(text or 0)
    except ValueError:
        found = math.nan
    if not math.isfinite(found) or (column == "line" and not found.is_integer()):
        raise UsageError(f"{place}: {column} is '{text}', expected a {'whole ' if column == 'line' else ''}number")
    return found


def _said(row: dict[str, str], author: str, place: str, steps: dict[str, Step]) -> AnnotationDraft:
    step = next((name for name in steps if row.get("step") and name.startswith(row["step"].zfill(2))), "")
    if row.get("step") and not step:
        raise UsageError(f"{place}: step is '{row['step']}', expected one of {', '.join(steps)}")
    if row["kind"].lower() not in _KINDS:
        raise UsageError(f"{place}: kind is '{row['kind']}', expected {', '.join(_KINDS)}")
    document = {
        **{key: row.get(key, "") for key in ("text", "answer", "part")},
        "kind": row["kind"].lower(),
        "author": row.get("author") or author,
        "step": step,
        "line": int(_number(row.get("line", ""), "line", place)),
        "points": _number(row.get("points", ""), "points", place),
    }
    try:
        return convert(document, AnnotationDraft)
    except Malformed as error:
        raise UsageError(f"{place}: {error}") from error


def _import_csv(database: ClassDatabase, path: Path, data: bytes, author: str) -> int:
    try:
        text = data.decode("utf-8-sig")
        reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter_of(text))
        header, *rows = [(reader.line_num, cells) for cells in reader if cells] or [(1, [])]
    except (ValueError, csv.Error) as error:
        raise UsageError(f"{path}: is not CSV in UTF-8: {error}") from error
    columns = columns_of(header[1], _CALLED)
    missing = [name for name in _NEEDED if name not in columns]
    if missing:
        names = [repr(one_line(cell).strip()) for cell in header[1]]
        found = join_some(names, _MAX_NAMED) if names else "none"
        raise UsageError(
            f"{path}: has no column {join_and(missing)}; known are id, email, {', '.join(_COLUMNS)}, found {found}"
        )
    table, steps, new = _Table(database.connection), manifests_of(database), 0
    with transaction(database.connection):
        for line, cells in rows:
            row = {name: unescape_formula(cells[at].strip()) if at < len(cells) else "" for name, at in columns.items()}
            if not any(row.values()):
                continue
            place = f"{path}:{line}"
            name = table.name(row, place)
            new += _add_row(database, name, _said(row, author, place, steps), row.get("author", ""), place)
    return new


def _add_row(database: ClassDatabase, name: str, said: AnnotationDraft, author: str, place: str) -> bool:
    """The same row gives the same name to what it says, whoever takes it in: a file that is read twice adds nothing.
    `author` is whom the row names."""
    try:
        made = AnnotationWriter(database, name).annotation(said)
    except UsageError as error:
        raise UsageError(f"{place}: {error}") from error
    content = [name, {**asdict(said), "author": author}]
    uid = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:32]
    (submission,) = database.connection.execute("SELECT id FROM submissions WHERE name = ?", (name,)).fetchone()
    subject = made.subject if made.kind == "points" else uid
    return add_annotation(database, submission, replace(made, uid=uid, subject=subject))
