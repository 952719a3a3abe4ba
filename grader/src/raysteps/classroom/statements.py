"""What is written to a database of a class."""

import sqlite3
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any


def now(timespec: str = "seconds") -> str:
    return datetime.now(UTC).isoformat(timespec=timespec)


def insert(connection: sqlite3.Connection, table: str, row: Mapping[str, Any], conflict: str = "") -> int:
    """The names are the code's own, the values are bound. `conflict` is an upsert clause. Returns the rows it made."""
    columns = ", ".join(row)
    marks = ", ".join(f":{name}" for name in row)
    sql = f"INSERT INTO {table} ({columns}) VALUES ({marks}) {conflict}"  # noqa: S608
    return connection.execute(sql, row).rowcount
