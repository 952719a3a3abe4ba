"""Reads the database of a class without ever writing to it."""

import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path

from raysteps.classroom.tables import VERSION, version_of
from raysteps.common.errors import UsageError


def _open(path: Path) -> sqlite3.Connection:
    # Where nothing can be written there is no room for what SQLite keeps beside a database that is in use.
    sealed = not os.access(path.parent, os.W_OK) and not path.with_name(f"{path.name}-wal").exists()
    place = f"{path.resolve().as_uri()}?{'immutable=1' if sealed else 'mode=ro'}"
    return sqlite3.connect(place, isolation_level=None, timeout=30, uri=True)


@contextmanager
def reading(path: Path) -> Iterator[sqlite3.Connection]:
    """A class as it is at one moment, even while it is graded on."""
    try:
        connection = _open(path)
    except sqlite3.Error as error:
        raise UsageError(f"{path}: cannot be opened: {error}") from error
    with closing(connection):
        try:
            connection.row_factory = sqlite3.Row
            connection.execute("BEGIN")
            version = version_of(connection, path)
        except sqlite3.Error as error:
            raise UsageError(f"{path}: cannot be read as the database of a class: {error}") from error
        if version != VERSION:
            raise UsageError(f"{path}: nothing has been graded there")
        yield connection
