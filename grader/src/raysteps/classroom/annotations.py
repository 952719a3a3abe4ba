"""What people say of submissions and change in their points, as the database of a class keeps it: rows are added,
and never changed or deleted. Rows about one subject are its history, and the last one holds."""

import hashlib
import json
import math
import sqlite3
import uuid
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from datetime import datetime, timedelta
from typing import Literal

from raysteps.classroom.database import ClassDatabase, Source, has_table, insert, now, stamp, transaction
from raysteps.common.documents import Amount, Count, Malformed, convert
from raysteps.common.errors import UsageError
from raysteps.common.text import number
from raysteps.results.model import Part

Kind = Literal["comment", "points", "request", "read"]
MAX_TEXT = 20_000  # characters
_MAX_NAME = 200
_MAX_POINTS = 10_000


@dataclass(frozen=True, kw_only=True)
class Annotation:
    """One thing that one person did. What a kind has no use for is left as it is."""

    uid: str
    subject: str
    kind: Kind
    author: str
    at: str
    step: str = ""  # empty: about the submission as a whole
    part: Part = ""  # of the points
    line: Count = 0  # of the code; 0: about all of it
    line_text: str = ""
    source: str = ""  # SHA-256 of the file that the line is in; of a `read` the mark of the code that was read
    text: str = ""  # the comment, the reason, what the student asked
    answer: str = ""
    points: float = 0.0
    automatic: Amount = 0.0  # what the grader had given when the points were changed
    withdrawn: bool = False


class AnnotationConflict(UsageError):
    """Somebody else was faster."""


@dataclass(frozen=True)
class Thread:
    """All that was done about one subject, in its order."""

    history: Sequence[Annotation]

    @property
    def first(self) -> Annotation:
        return self.history[0]

    @property
    def last(self) -> Annotation:
        return self.history[-1]


def new_annotation(kind: Kind, author: str, **more: object) -> Annotation:
    """With a name of its own; points have one subject for each item, so that two changes of it know of each other."""
    uid = uuid.uuid4().hex
    subject = str(more.pop("subject", "") or uid)
    if kind == "points":
        subject = f"points/{more.get('step', '')}/{more.get('part', '')}"
    elif kind == "read":
        subject = "read"
    said = {"uid": uid, "subject": subject, "kind": kind, "author": author.strip(), "at": now("microseconds"), **more}
    return checked(convert(said, Annotation))


def checked(one: Annotation) -> Annotation:
    """Refuses what a person left out or mistyped."""
    try:
        when = datetime.fromisoformat(one.at)
    except ValueError as error:
        raise Malformed(f"at: expected a date and time, found '{one.at}'") from error
    if when.tzinfo is None:
        raise Malformed(f"at: expected a time zone, found '{one.at}'")
    one = replace(one, at=stamp(when))
    whole = {"author": one.author, "at": one.at, "uid": one.uid, "subject": one.subject}
    for name, text in whole.items():
        if not text.strip() or len(text) > _MAX_NAME:
            raise Malformed(f"{name}: expected 1 to {_MAX_NAME} characters")
    if len(one.text) > MAX_TEXT or len(one.answer) > MAX_TEXT or len(one.line_text) > MAX_TEXT:
        raise Malformed(f"text: expected at most {MAX_TEXT} characters")
    if one.kind != "read" and not one.text.strip():
        missing = {"comment": "a comment", "points": "a reason", "request": "what the student asks"}[one.kind]
        raise Malformed(f"text: expected {missing}")
    if one.line and not one.step:
        raise Malformed("line: expected the step whose line it is")
    for name, amount in {"points": one.points, "automatic": one.automatic}.items():
        if not math.isfinite(amount):
            raise Malformed(f"{name}: expected a number, found {amount}")
    if one.kind == "points":
        low = 0 if one.step else -_MAX_POINTS
        if not low <= one.points <= _MAX_POINTS:
            raise Malformed(f"points: expected a number from {low} to {_MAX_POINTS}, found {number(one.points)}")
        if one.part and not one.step:
            raise Malformed("part: expected the step whose part it is")
    return one


# Reading.


_COLUMNS = ("uid", "subject", "kind", "author", "at")  # of the table; the rest is its content


def _annotation(row: sqlite3.Row) -> Annotation:
    try:
        said = {**json.loads(row["content"]), **{name: row[name] for name in _COLUMNS}}
        return convert(said, Annotation, extra=True)  # a newer kit may say more
    except (ValueError, TypeError, RecursionError) as error:
        raise sqlite3.DatabaseError(f"annotation {row['serial']}: {error}") from error


def threads(annotations: Iterable[Annotation]) -> list[Thread]:
    """By when they began. Clocks of several machines put what was done there in order."""
    found: dict[str, list[Annotation]] = defaultdict(list)
    for one in sorted(annotations, key=lambda one: (one.at, one.uid)):
        found[one.subject].append(one)
    return [Thread(history) for history in found.values()]


def annotations_of(database: ClassDatabase, submission: int) -> list[Annotation]:
    if not has_table(database.connection, "annotations"):
        return []
    rows = database.connection.execute("SELECT * FROM annotations WHERE submission = ? ORDER BY serial", (submission,))
    return [_annotation(row) for row in rows]


def all_annotations(database: ClassDatabase) -> list[tuple[str, Annotation]]:
    """With the entry that each is about."""
    rows = database.connection.execute(
        "SELECT entry, annotations.* FROM annotations JOIN submissions ON submissions.id = submission ORDER BY serial"
    )
    return [(row["entry"], _annotation(row)) for row in rows]


def annotated(database: ClassDatabase, since: int = 0) -> set[str]:
    """Names of submissions about which anything was said after that row."""
    rows = database.connection.execute(
        "SELECT DISTINCT name FROM annotations JOIN submissions ON submissions.id = annotations.submission "
        "WHERE serial > ?",
        (since,),
    )
    return {row["name"] for row in rows}


def last_said(database: ClassDatabase, name: str) -> str:
    """Which was the last one that a student is told; empty where nothing was said of a submission."""
    row = database.connection.execute(
        "SELECT uid FROM annotations JOIN submissions ON submissions.id = annotations.submission "
        "WHERE name = ? AND kind <> 'read' ORDER BY serial DESC LIMIT 1",
        (name,),
    ).fetchone()
    return str(row["uid"]) if row is not None else ""


def code_mark(database: ClassDatabase, sources: Mapping[str, Source], run: int | None) -> str:
    """Tells one state of a submission's code from another; where no code is kept, one result from another, also after
    a merge has given its run another number."""
    if not sources:
        row = database.connection.execute("SELECT uid FROM runs WHERE number = ?", (run,)).fetchone()
        return f"run {row['uid'] if row is not None else None}"
    return hashlib.sha256(json.dumps({step: one.sha256 for step, one in sources.items()}).encode()).hexdigest()


# Writing.


def add_annotation(database: ClassDatabase, submission: int, one: Annotation) -> bool:
    """False where it is there already. Only within a transaction."""
    content = {
        name: value for name, value in asdict(one).items() if name not in _COLUMNS and value != getattr(_EMPTY, name)
    }
    row = {
        **{name: getattr(one, name) for name in _COLUMNS},
        "submission": submission,
        "content": json.dumps(content, ensure_ascii=False),
    }
    return insert(database.connection, "annotations", row, "ON CONFLICT (uid) DO NOTHING") > 0


_EMPTY = Annotation(uid="", subject="", kind="read", author="", at="")


def annotate(database: ClassDatabase, name: str, one: Annotation, *, after: str) -> None:
    """`after` is the last row about the subject that its author knew of; where there is a later one by now, nothing is
    written."""
    with transaction(database.connection):
        row = database.connection.execute("SELECT id FROM submissions WHERE name = ?", (name,)).fetchone()
        if row is None:
            raise UsageError(f"{name}: there is no such submission in {database.path}")
        found = [
            thread for thread in threads(annotations_of(database, row["id"])) if thread.last.subject == one.subject
        ]
        last = found[0].last if found else None
        if last is not None and one.kind != "read" and last.uid != after:
            raise AnnotationConflict(
                f"{name}: {last.author} has changed this meanwhile; look at it as it is now, then change it again"
            )
        if last is not None and last.at >= one.at:  # a clock that is behind must not put the new one before it
            one = replace(one, at=stamp(datetime.fromisoformat(last.at) + timedelta(microseconds=1)))
        add_annotation(database, row["id"], one)


# Whether the files of the class were made with all of them.


def latest_serial(connection: sqlite3.Connection) -> int:
    """0 before the first annotation."""
    if not has_table(connection, "annotations"):
        return 0
    return int(connection.execute("SELECT coalesce(max(serial), 0) FROM annotations").fetchone()[0])


def written_serial(connection: sqlite3.Connection) -> int:
    if not has_table(connection, "written"):
        return 0
    return int(connection.execute("SELECT coalesce(max(serial), 0) FROM written").fetchone()[0])


def is_unwritten(connection: sqlite3.Connection) -> bool:
    """Whether anything was said since results.csv and the rest were made."""
    return written_serial(connection) < latest_serial(connection)


def note_written(database: ClassDatabase, serial: int) -> None:
    """Says that results.csv and the rest hold everything up to this one."""
    with transaction(database.connection):
        row = {"id": 1, "serial": serial}
        insert(database.connection, "written", row, "ON CONFLICT (id) DO UPDATE SET serial = excluded.serial")
