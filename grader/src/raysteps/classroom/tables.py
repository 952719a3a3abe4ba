"""The tables of class.sqlite, and how the file is opened."""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from raysteps.common.errors import UsageError

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
    reused INTEGER NOT NULL DEFAULT 0
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


def open_database(path: Path) -> sqlite3.Connection:
    """Opens the database of a class, and makes it when there is none."""
    try:
        connection = sqlite3.connect(path, isolation_level=None, timeout=30)
        try:
            connection.row_factory = sqlite3.Row
            connection.execute("PRAGMA foreign_keys = ON")
            version_of(connection, path)
            # Where the file system has no shared memory this stays as it is; transactions hold all the same.
            connection.execute("PRAGMA journal_mode = WAL")
            connection.execute("PRAGMA synchronous = FULL")
            with transaction(connection):
                if version_of(connection, path) == 0:
                    for statement in filter(str.strip, _TABLES.split(";\n")):
                        connection.execute(statement)
                    connection.execute(f"PRAGMA application_id = {_APPLICATION}")
                    connection.execute(f"PRAGMA user_version = {VERSION}")
                connection.execute(_REUSED)
                connection.execute(_GIVEN)
        except BaseException:
            connection.close()
            raise
    except sqlite3.Error as error:
        raise UsageError(f"{path}: cannot be opened as the database of a class: {error}") from error
    return connection
