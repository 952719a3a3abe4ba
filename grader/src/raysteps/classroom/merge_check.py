"""What merging looks at: the parts of a class, whether they fit together, and the order of their runs."""

import json
import sqlite3
from pathlib import Path
from typing import Any

from raysteps.common.text import listed


def rows_of(source: sqlite3.Connection, query: str, *values: Any) -> list[dict[str, Any]]:
    """As plain dictionaries."""
    return [dict(row) for row in source.execute(query, values)]


class Part:
    """The database of a shard."""

    def __init__(self, folder: Path, connection: sqlite3.Connection) -> None:
        self.folder = folder
        self.connection = connection
        self.runs = rows_of(connection, "SELECT * FROM runs ORDER BY started_at, number")
        self.submissions = rows_of(connection, "SELECT * FROM submissions ORDER BY entry")
        self.students = rows_of(connection, "SELECT * FROM students ORDER BY number")
        self.handed_in = rows_of(connection, "SELECT * FROM handed_in")

    @property
    def began(self) -> str:
        """When its last run did."""
        return str(self.runs[-1]["started_at"])

    def facts(self) -> dict[str, str]:
        """What must be alike for the results to be those of one class."""
        last = self.runs[-1]
        entries = {row["id"]: row["entry"] for row in self.submissions}
        whose = [(row["student"], entries[row["submission"]]) for row in self.handed_in]
        people = sorted(
            [row["id"], row["name"], row["email"], *sorted(entry for number, entry in whose if number == row["number"])]
            for row in self.students
        )
        return {
            "late policies": last["late_policy"],
            "settings": last["settings"],
            "kits": last["kit"],
            "rosters": json.dumps(people),
            "submissions": json.dumps(sorted(row["entry"] for row in self.submissions if row["scope"] != "gone")),
        }


def disagreements(parts: list[Part]) -> list[str]:
    """What the last runs of the shards do not have in common; the parts come in the order in which these began."""
    facts = [part.facts() for part in parts]
    last = parts[-1].folder
    warnings = []
    for what, counts in facts[-1].items():
        others = [str(part.folder) for part, one in zip(parts, facts, strict=True) if one[what] != counts]
        if others:
            warnings.append(
                f"{listed(others)}: had other {what} than {last}, which began last and counts for the class; "
                "run the shards again with --resume so that all have the same"
            )
    return warnings


def missing_shards(target: sqlite3.Connection) -> list[str]:
    """Those that no run was for, where a class was divided."""
    shards = {tuple(map(int, row["shard"].split("/"))) for row in target.execute("SELECT shard FROM runs")}
    count = max(count for _, count in shards)
    if (1, 1) in shards:
        return []
    return [f"{index}/{count}" for index in range(1, count + 1) if (index, count) not in shards]


def put_in_order(target: sqlite3.Connection) -> None:
    """The number of a run tells when it began, also when its shard was merged later than others."""
    numbers = [row["number"] for row in target.execute("SELECT number FROM runs ORDER BY started_at, number")]
    if numbers == sorted(numbers):
        return
    target.execute("PRAGMA defer_foreign_keys = ON")
    places = (("runs", "number"), ("results", "run"), ("pictures", "run"), ("reused", "run"))
    for table, column in places:  # the names are those above
        target.execute(f"UPDATE {table} SET {column} = -{column}")  # noqa: S608
        for new, old in enumerate(numbers, start=1):
            target.execute(f"UPDATE {table} SET {column} = ? WHERE {column} = ?", (new, -old))  # noqa: S608
