"""What class.sqlite is told, and what it tells."""

import hashlib
import json
import os
import sqlite3
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import asdict, dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

from raysteps.classroom.jobs import JobResult
from raysteps.common.documents import plain
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.platform import quote_command
from raysteps.common.text import name_order
from raysteps.results.model import Feedback, Settings

# The tables of class.sqlite, and how the file is opened.

VERSION = 1
_APPLICATION = 0x52617973

# Nothing is ever changed in `results` and what hangs on it: a run adds its own rows, once per submission. Which result
# counts follows from the numbers of the runs. Pictures are kept by their content, because most are alike.
_TABLES = """
CREATE TABLE submissions (
    id INTEGER PRIMARY KEY,
    name TEXT NOT NULL UNIQUE,            -- safe as the name of a file
    entry TEXT NOT NULL UNIQUE,           -- what it is called in the folder that was handed in
    scope TEXT NOT NULL CHECK (scope IN ('here', 'elsewhere', 'gone')),
    submitted_at TEXT NOT NULL DEFAULT '',
    submitted_from TEXT NOT NULL DEFAULT '' CHECK (submitted_from IN ('', 'roster', 'files')),
    note TEXT NOT NULL DEFAULT ''
);
CREATE TABLE students (
    number INTEGER PRIMARY KEY,
    id TEXT NOT NULL,
    name TEXT NOT NULL,
    email TEXT NOT NULL,
    note TEXT NOT NULL DEFAULT '',
    UNIQUE (id, name, email)
);
CREATE TABLE handed_in (
    student INTEGER NOT NULL REFERENCES students (number) ON DELETE CASCADE,
    submission INTEGER NOT NULL REFERENCES submissions (id) ON DELETE CASCADE,
    PRIMARY KEY (student, submission)
);
CREATE TABLE runs (
    number INTEGER PRIMARY KEY,
    uid TEXT NOT NULL UNIQUE,
    started_at TEXT NOT NULL,
    ended_at TEXT NOT NULL DEFAULT '',
    state TEXT NOT NULL CHECK (state IN ('running', 'complete', 'interrupted')),
    kit TEXT NOT NULL,
    folder TEXT NOT NULL,
    shard TEXT NOT NULL,
    settings TEXT NOT NULL,               -- JSON
    steps TEXT NOT NULL,                  -- JSON: the steps that were graded
    late_policy TEXT NOT NULL DEFAULT '', -- the text of the file
    ignored TEXT NOT NULL DEFAULT '[]',   -- JSON: names in the folder that are no submissions
    reused INTEGER NOT NULL DEFAULT 0,
    course TEXT NOT NULL DEFAULT ''       -- its title and term
);
CREATE TABLE results (
    submission INTEGER NOT NULL REFERENCES submissions (id),
    run INTEGER NOT NULL REFERENCES runs (number),
    key TEXT NOT NULL,                    -- of everything that the result depends on
    status TEXT NOT NULL CHECK (status IN ('graded', 'unreadable', 'fault')),
    points REAL,
    document TEXT NOT NULL DEFAULT '',    -- results.json
    fault TEXT NOT NULL DEFAULT '',
    details TEXT NOT NULL DEFAULT '',
    worker TEXT NOT NULL,
    seconds REAL NOT NULL,
    finished_at TEXT NOT NULL,
    PRIMARY KEY (submission, run),
    CHECK ((status = 'fault') = (points IS NULL)),
    CHECK ((status = 'fault') = (document = ''))
);
CREATE TABLE blobs (
    sha256 TEXT PRIMARY KEY,
    data BLOB NOT NULL
);
CREATE TABLE pictures (
    submission INTEGER NOT NULL,
    run INTEGER NOT NULL,
    path TEXT NOT NULL,
    sha256 TEXT NOT NULL REFERENCES blobs (sha256),
    PRIMARY KEY (submission, run, path),
    FOREIGN KEY (submission, run) REFERENCES results (submission, run)
);
"""
_REUSED = """
CREATE TABLE IF NOT EXISTS reused (       -- earlier results that a run found to hold
    submission INTEGER NOT NULL REFERENCES submissions (id),
    run INTEGER NOT NULL REFERENCES runs (number),
    PRIMARY KEY (submission, run)
)
"""
_GIVEN = """
CREATE TABLE IF NOT EXISTS given (        -- what a run was given beside the submissions
    uid TEXT PRIMARY KEY REFERENCES runs (uid),
    roster TEXT NOT NULL,                 -- JSON: the lines of the roster
    files TEXT NOT NULL                   -- JSON: where roster and late policy lay
)
"""
_ANNOTATIONS = """
CREATE TABLE IF NOT EXISTS annotations (  -- what people did: rows are only ever added
    serial INTEGER PRIMARY KEY AUTOINCREMENT,
    uid TEXT NOT NULL UNIQUE,             -- tells it from the rows of all other databases
    submission INTEGER NOT NULL REFERENCES submissions (id),
    subject TEXT NOT NULL,                -- rows of one subject are its history; the last one holds
    kind TEXT NOT NULL CHECK (kind IN ('comment', 'points', 'request', 'read')),
    author TEXT NOT NULL,
    at TEXT NOT NULL,
    content TEXT NOT NULL                 -- JSON
)
"""
_SOURCES = """
CREATE TABLE IF NOT EXISTS sources (      -- the code that a result is of
    submission INTEGER NOT NULL REFERENCES submissions (id),
    run INTEGER NOT NULL REFERENCES runs (number),
    step TEXT NOT NULL,
    sha256 TEXT NOT NULL REFERENCES blobs (sha256),
    PRIMARY KEY (submission, run, step)
)
"""
_WRITTEN = """
CREATE TABLE IF NOT EXISTS written (      -- one row: the last annotation that results.csv and the rest were made with
    id INTEGER PRIMARY KEY CHECK (id = 1),
    serial INTEGER NOT NULL
)
"""
_ARRIVALS = """
CREATE TABLE IF NOT EXISTS arrivals (     -- of what was handed in when a result was made
    submission INTEGER NOT NULL,
    run INTEGER NOT NULL,
    digest TEXT NOT NULL,                 -- of the sources alone
    submitted_at TEXT NOT NULL,
    submitted_from TEXT NOT NULL,
    PRIMARY KEY (submission, run),
    FOREIGN KEY (submission, run) REFERENCES results (submission, run)
)
"""
_FEEDBACK_GIVEN = """
CREATE TABLE IF NOT EXISTS feedback_given ( -- what `nightly` gave to whom
    submission INTEGER NOT NULL REFERENCES submissions (id),
    run INTEGER NOT NULL REFERENCES runs (number),
    student TEXT NOT NULL,                -- the id, else the email address, else the name; without a roster the entry's
    work TEXT NOT NULL,                   -- digest of what was handed in
    counts INTEGER NOT NULL,              -- whether it took one of the day's
    given_at TEXT NOT NULL,               -- in UTC
    said TEXT NOT NULL DEFAULT '',        -- uid of the last annotation that its page tells of
    PRIMARY KEY (submission, run, student)
)
"""
_LEFT_OUT = """
CREATE TABLE IF NOT EXISTS left_out (     -- what `nightly` found changed, but does not grade yet
    submission INTEGER PRIMARY KEY REFERENCES submissions (id)
)
"""
# An earlier kit did not have them.
_LATER_TABLES = (_REUSED, _GIVEN, _ANNOTATIONS, _SOURCES, _WRITTEN, _ARRIVALS, _FEEDBACK_GIVEN, _LEFT_OUT)
_LATER_COLUMNS = (("runs", "course"), ("feedback_given", "said"))


@contextmanager
def transaction(connection: sqlite3.Connection) -> Iterator[None]:
    """All of it or nothing."""
    connection.execute("BEGIN IMMEDIATE")
    try:
        yield
        connection.execute("COMMIT")
    except BaseException:
        if connection.in_transaction:  # SQLite itself rolls back when the disk is full
            connection.execute("ROLLBACK")
        raise


def refuse_results(folder: Path) -> None:
    """A folder that grade-class wrote, or the one inside it with what became of each, holds nothing handed in."""
    place = folder.resolve()
    out = place.parent if place.name == SUBMISSIONS else place
    if (out / FILE).is_file():
        raise UsageError(
            f"{folder}: holds the results of a class, since {FILE} lies there; expected the folder of what was handed "
            "in, which grade-class was given in front of --out"
        )


def version_of(connection: sqlite3.Connection, path: Path) -> int:
    """0 for a database that is still empty."""
    (application,) = connection.execute("PRAGMA application_id").fetchone()
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    (tables,) = connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
    if application != _APPLICATION and (tables or version):
        raise UsageError(f"{path}: is a database, but not one of a class; name another folder")
    if version not in (0, VERSION):
        raise UsageError(f"{path}: has version {version}, but this kit writes {VERSION}; name another folder")
    return int(version)


_DAMAGED = (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB)
_NO_ROOM = (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR)


def _recovery_advice(path: Path) -> str:
    recover = quote_command(["sqlite3", str(path), ".recover"])
    return (
        f"nothing was graded anew. Put back a copy of it, or what `{recover}` saves of it; to grade the "
        "whole class anew, name another --out"
    )


@contextmanager
def explained_sqlite_errors(path: Path, doing: str) -> Iterator[None]:
    """What SQLite finds wrong with a file, in words that say what to do."""
    try:
        yield
    except sqlite3.Error as error:
        kind = (getattr(error, "sqlite_errorcode", None) or 0) & 0xFF  # without what extends it
        if kind in _NO_ROOM:
            raise GraderFault(f"{path}: cannot be written: {error}; make room, then go on with --resume") from error
        advice = f"; it is damaged, and {_recovery_advice(path)}" if kind in _DAMAGED else ""
        raise UsageError(f"{path}: cannot be {doing} as the database of a class: {error}{advice}") from error


def _check_whole(connection: sqlite3.Connection) -> None:
    (found,) = connection.execute("PRAGMA quick_check(1)").fetchone()
    if found != "ok":
        damage = sqlite3.DatabaseError(str(found).replace("\n", " "))
        damage.sqlite_errorcode = sqlite3.SQLITE_CORRUPT
        raise damage


def _refuse_emptied(connection: sqlite3.Connection, path: Path) -> None:
    """A database without a run beside results of one: to grade into it would take these for never made."""
    if connection.execute("SELECT 1 FROM runs LIMIT 1").fetchone() is None:
        for name in (CLASS_JSON, SUBMISSIONS):
            if (path.parent / name).exists():
                raise UsageError(
                    f"{path}: is empty, but {name} beside it holds results of a class; {_recovery_advice(path)}"
                )


def _prepare(connection: sqlite3.Connection) -> None:
    """Lists for people are sorted where they are asked for: `ORDER BY name_order(name)`."""
    connection.row_factory = sqlite3.Row
    connection.create_function("name_order", 1, name_order, deterministic=True)


def open_database(path: Path, *, check: bool = True) -> sqlite3.Connection:
    """Opens the database of a class, and makes it when there is none. `check` reads all of it, to find damage."""
    was_there = path.exists()
    with explained_sqlite_errors(path, "opened"):
        # Whoever shares a connection among threads sees to it that one at a time uses it.
        connection = sqlite3.connect(path, isolation_level=None, timeout=30, check_same_thread=False)
        try:
            _prepare(connection)
            connection.execute("PRAGMA foreign_keys = ON")
            version_of(connection, path)
            if check:
                _check_whole(connection)
            # Where the file system has no shared memory this stays as it is; transactions hold all the same.
            connection.execute("PRAGMA journal_mode = WAL")
            connection.execute("PRAGMA synchronous = FULL")
            with transaction(connection):
                if version_of(connection, path) == 0:
                    for statement in filter(str.strip, _TABLES.split(";\n")):
                        connection.execute(statement)
                    connection.execute(f"PRAGMA application_id = {_APPLICATION}")
                    connection.execute(f"PRAGMA user_version = {VERSION}")
                for statement in _LATER_TABLES:
                    connection.execute(statement)
                for table, column in _LATER_COLUMNS:
                    if all(known["name"] != column for known in connection.execute(f"PRAGMA table_info({table})")):
                        connection.execute(f"ALTER TABLE {table} ADD COLUMN {column} TEXT NOT NULL DEFAULT ''")
            if was_there:
                _refuse_emptied(connection, path)
        except BaseException:
            connection.close()
            raise
    return connection


# What is written to a database of a class.


def now(timespec: str = "seconds") -> str:
    return datetime.now(UTC).isoformat(timespec=timespec)


def stamp(moment: datetime) -> str:
    """In a form in which the order of the texts is that of the moments."""
    return moment.astimezone(UTC).isoformat(timespec="microseconds")


def insert(connection: sqlite3.Connection, table: str, row: Mapping[str, Any], conflict: str = "") -> int:
    """The names are the code's own, the values are bound. `conflict` is an upsert clause. Returns the rows it made."""
    columns = ", ".join(row)
    marks = ", ".join(f":{name}" for name in row)
    sql = f"INSERT INTO {table} ({columns}) VALUES ({marks}) {conflict}"  # noqa: S608
    return connection.execute(sql, row).rowcount


# What the database is told at the beginning of a run.

Scope = Literal["here", "elsewhere", "gone"]  # "elsewhere": it belongs to another shard


@dataclass(frozen=True)
class RegisteredEntry:
    """An entry of the folder as the database keeps it."""

    entry: str
    name: str
    scope: Scope
    submitted_at: str = ""
    submitted_from: str = ""
    note: str = ""


@dataclass(frozen=True)
class StudentEntries:
    """A student, and the entries that are this student's."""

    id: str
    name: str
    email: str
    entries: tuple[str, ...]
    note: str = ""


@dataclass(frozen=True)
class RunFacts:
    """How a run grades. `uid` tells it from the runs of all other databases."""

    uid: str
    kit: str
    folder: str
    shard: str
    settings: Settings
    steps: list[dict[str, Any]]
    late_policy: str
    ignored: list[str]
    roster: str = "[]"  # JSON: its lines as they were read
    files: list[str] = field(default_factory=list)  # where roster and late policy lay
    course: str = ""  # its title and term


def has_table(connection: sqlite3.Connection, name: str) -> bool:
    """A database that is only read may be one of an earlier kit."""
    query = "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?"
    return connection.execute(query, (name,)).fetchone() is not None


# What lies in the folder of a class: the database, and what is made of it.
FILE = "class.sqlite"
CLASS_JSON = "class.json"
SUBMISSIONS = "submissions"
LOCK = "class.lock"
# The run whose result of a submission counts.
LATEST = "SELECT max(run) FROM results AS later WHERE later.submission = results.submission"


@dataclass(frozen=True)
class Source:
    """The file of a step as it was graded."""

    sha256: str
    data: bytes

    @property
    def lines(self) -> list[str]:
        return self.data.decode("utf-8", "replace").split("\n")


class ClassDatabase:
    """One class. What a method writes is there as a whole or not at all."""

    def __init__(self, folder: Path, connection: sqlite3.Connection | None = None) -> None:
        """`connection` is one that is open already, such as one that only reads."""
        self.path = folder / FILE
        self.connection = connection or open_database(self.path)

    def close(self) -> None:
        self.connection.close()

    def names(self) -> dict[str, str]:
        """Entry -> name of all entries that were ever seen."""
        return {row["entry"]: row["name"] for row in self.connection.execute("SELECT entry, name FROM submissions")}

    def begin_run(
        self,
        facts: RunFacts,
        entries: Iterable[RegisteredEntry],
        students: Iterable[StudentEntries],
        left_out: Collection[str] = (),
    ) -> int:
        """Registers who and what is there now, and gives the number of the new run. `left_out` are the names of those
        that it will not grade although they may have changed: their earlier result stands, with its time."""
        with transaction(self.connection):
            self.connection.execute("UPDATE runs SET state = 'interrupted' WHERE state = 'running'")
            row = {
                "uid": facts.uid,
                "started_at": now("microseconds"),  # runs of several machines are put in order by it
                "state": "running",
                "kit": facts.kit,
                "folder": facts.folder,
                "shard": facts.shard,
                "settings": json.dumps(asdict(facts.settings), sort_keys=True),
                "steps": json.dumps(facts.steps),
                "late_policy": facts.late_policy,
                "ignored": json.dumps(facts.ignored),
                "course": facts.course,
            }
            insert(self.connection, "runs", row)
            given = {"uid": facts.uid, "roster": facts.roster, "files": json.dumps(facts.files)}
            insert(self.connection, "given", given)
            (number,) = self.connection.execute("SELECT max(number) FROM runs").fetchone()
            self.connection.execute("UPDATE submissions SET scope = 'gone'")
            self.connection.execute("DELETE FROM students")
            for entry in entries:
                self._register(entry, with_time=entry.name not in left_out)
            for student in students:
                self._enrol(student)
            self._mark_left_out(left_out)
        return int(number)

    def _register(self, entry: RegisteredEntry, *, with_time: bool) -> None:
        row = dict(vars(entry))
        insert(self.connection, "submissions", row, "ON CONFLICT (entry) DO NOTHING")
        self.connection.execute("UPDATE submissions SET scope = :scope, note = :note WHERE entry = :entry", row)
        if with_time:
            self.connection.execute(
                "UPDATE submissions SET submitted_at = :submitted_at, submitted_from = :submitted_from "
                "WHERE entry = :entry",
                row,
            )

    def _mark_left_out(self, names: Iterable[str]) -> None:
        self.connection.execute("DELETE FROM left_out")
        self.connection.executemany(
            "INSERT INTO left_out SELECT id FROM submissions WHERE name = ? "
            "AND EXISTS (SELECT 1 FROM results WHERE results.submission = submissions.id)",
            [(name,) for name in set(names)],
        )

    def left_out(self) -> set[str]:
        """Names of those whose result is of an earlier state than the one that was seen last."""
        query = "SELECT name FROM submissions JOIN left_out ON left_out.submission = submissions.id"
        return {row["name"] for row in self.connection.execute(query)}

    def leave_out(self, names: Collection[str], skipped: Collection[str] = ()) -> None:
        """`skipped` are those among them that the run had begun with: the time of their result is put back."""
        with transaction(self.connection):
            self._mark_left_out(names)
            for current in filter(None, map(self.current, skipped)):
                kept = self.connection.execute(
                    "SELECT submission, submitted_at, submitted_from FROM arrivals WHERE submission = ? AND run = ?",
                    (current["submission"], current["run"]),
                ).fetchone()
                if kept is not None:
                    self.connection.execute(
                        "UPDATE submissions SET submitted_at = ?, submitted_from = ? WHERE id = ?",
                        (kept["submitted_at"], kept["submitted_from"], kept["submission"]),
                    )

    def _enrol(self, student: StudentEntries) -> None:
        row = {"id": student.id, "name": student.name, "email": student.email, "note": student.note}
        insert(self.connection, "students", row, "ON CONFLICT (id, name, email) DO NOTHING")
        for entry in student.entries:
            self.connection.execute(
                "INSERT OR IGNORE INTO handed_in (student, submission) SELECT students.number, submissions.id "
                "FROM students, submissions WHERE students.id = :id AND students.name = :name "
                "AND students.email = :email AND entry = :entry",
                {**row, "entry": entry},
            )

    def end_run(self, run: int, state: Literal["complete", "interrupted"], reused: Mapping[str, str]) -> None:
        """`reused` are the submissions whose earlier result was found to hold, with the digests of their sources."""
        with transaction(self.connection):
            self.connection.execute(
                "UPDATE runs SET state = ?, ended_at = ?, reused = ? WHERE number = ?", (state, now(), len(reused), run)
            )
            self.connection.executemany(
                "INSERT OR IGNORE INTO reused (submission, run) SELECT id, ? FROM submissions WHERE name = ?",
                [(run, name) for name in reused],
            )
            for name, digest in reused.items():
                current = self.current(name)
                if current is not None:
                    self._keep_arrival(current["submission"], current["run"], digest)

    def feedback(self) -> Feedback:
        """How much the last run wants students to be told."""
        row = self.connection.execute("SELECT settings FROM runs ORDER BY number DESC LIMIT 1").fetchone()
        wanted: Feedback = json.loads(row["settings"])["feedback"]
        return wanted

    def current(self, name: str) -> sqlite3.Row | None:
        """The result that counts for a submission: that of the last run that has one."""
        row: sqlite3.Row | None = self.connection.execute(
            "SELECT results.* FROM results JOIN submissions ON submissions.id = results.submission "  # noqa: S608
            f"WHERE submissions.name = ? AND run = ({LATEST})",
            (name,),
        ).fetchone()
        return row

    def record(
        self,
        run: int,
        answer: JobResult,
        key: str,
        *,
        unreadable: bool = False,
        sources: Mapping[str, bytes] = MappingProxyType({}),
        digest: str = "",
    ) -> bool:
        """Keeps an answer, the code that it is of, and the digest of all that was handed in; False when the run already
        has a result of this submission, which then stays."""
        results = answer.results
        with transaction(self.connection):
            (submission,) = self.connection.execute(
                "SELECT id FROM submissions WHERE name = ?", (answer.name,)
            ).fetchone()
            row = {
                "submission": submission,
                "run": run,
                "key": key,
                "status": "unreadable" if unreadable and results is not None else answer.status,
                "points": None if results is None else results.total.points,
                "document": "" if results is None else json.dumps(plain(results), ensure_ascii=False),
                "fault": answer.fault,
                "details": answer.details,
                "worker": answer.worker,
                "seconds": answer.seconds,
                "finished_at": now(),
            }
            if insert(self.connection, "results", row, "ON CONFLICT (submission, run) DO NOTHING") == 0:
                return False
            self._keep_arrival(submission, run, digest)
            for path, data in answer.pictures.items():
                picture = {"submission": submission, "run": run, "path": path, "sha256": self._keep_blob(data)}
                insert(self.connection, "pictures", picture)
            self._keep_sources(submission, run, sources)
        return True

    def _keep_blob(self, data: bytes) -> str:
        digest = hashlib.sha256(data).hexdigest()
        insert(self.connection, "blobs", {"sha256": digest, "data": data}, "ON CONFLICT (sha256) DO NOTHING")
        return digest

    def _keep_sources(self, submission: int, run: int, sources: Mapping[str, bytes]) -> None:
        for step, data in sources.items():
            row = {"submission": submission, "run": run, "step": step, "sha256": self._keep_blob(data)}
            insert(self.connection, "sources", row, "ON CONFLICT DO NOTHING")

    def keep_sources(self, name: str, sources: Mapping[str, bytes]) -> None:
        """The code of the result that counts, where an earlier kit did not keep it."""
        current = self.current(name)
        if current is not None and sources and not self.sources(current["submission"], current["run"]):
            with transaction(self.connection):
                self._keep_sources(current["submission"], current["run"], sources)

    def sources(self, submission: int, run: int) -> dict[str, Source]:
        """By step."""
        if not has_table(self.connection, "sources"):
            return {}
        rows = self.connection.execute(
            "SELECT step, sha256, data FROM sources JOIN blobs USING (sha256) WHERE submission = ? AND run = ? "
            "ORDER BY step",
            (submission, run),
        )
        return {row["step"]: Source(row["sha256"], row["data"]) for row in rows}

    def blob(self, digest: str) -> bytes | None:
        row = self.connection.execute("SELECT data FROM blobs WHERE sha256 = ?", (digest,)).fetchone()
        return None if row is None else bytes(row["data"])

    def _keep_arrival(self, submission: int, run: int, digest: str) -> None:
        """With the time of the hand-in as it is known now: the next run may bring another submission. What an earlier
        kit did not keep is added when its result is found to hold."""
        if digest:
            self.connection.execute(
                "INSERT OR REPLACE INTO arrivals (submission, run, digest, submitted_at, submitted_from) "
                "SELECT id, ?, ?, submitted_at, submitted_from FROM submissions WHERE id = ?",
                (run, digest, submission),
            )

    def pictures(self, submission: int, run: int) -> dict[str, bytes]:
        rows = self.connection.execute(
            "SELECT path, data FROM pictures JOIN blobs USING (sha256) WHERE submission = ? AND run = ?",
            (submission, run),
        )
        return {row["path"]: row["data"] for row in rows}


# Reads the database of a class without ever writing to it.


def _open(path: Path) -> sqlite3.Connection:
    # Where nothing can be written there is no room for what SQLite keeps beside a database that is in use.
    sealed = not os.access(path.parent, os.W_OK) and not path.with_name(f"{path.name}-wal").exists()
    place = f"{path.resolve().as_uri()}?{'immutable=1' if sealed else 'mode=ro'}"
    return sqlite3.connect(place, isolation_level=None, timeout=30, uri=True)


@contextmanager
def open_readonly(path: Path) -> Iterator[sqlite3.Connection]:
    """A class as it is at one moment, even while it is graded on."""
    try:
        connection = _open(path)
    except sqlite3.Error as error:
        raise UsageError(f"{path}: cannot be opened: {error}") from error
    with closing(connection):
        with explained_sqlite_errors(path, "read"):
            _prepare(connection)
            connection.execute("BEGIN")
            version = version_of(connection, path)
            _check_whole(connection)
        if version != VERSION:
            raise UsageError(f"{path}: nothing has been graded there")
        yield connection
