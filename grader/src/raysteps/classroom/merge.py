"""Brings the databases of shards together in one."""

import json
import sqlite3
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from raysteps.classroom.database import FILE, ClassDatabase, has_table, insert, open_readonly, transaction
from raysteps.classroom.entries import name_entries
from raysteps.common.errors import UsageError
from raysteps.common.text import join_and

# What merging looks at: the parts of a class, whether they fit together, and the order of their runs.


def rows_of(source: sqlite3.Connection, query: str, *values: Any) -> list[dict[str, Any]]:
    """As plain dictionaries."""
    return [dict(row) for row in source.execute(query, values)]


class ShardDatabase:
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
            "courses": last.get("course", ""),
            "rosters": json.dumps(people),
            "submissions": json.dumps(sorted(row["entry"] for row in self.submissions if row["scope"] != "gone")),
        }


def disagreements(parts: list[ShardDatabase]) -> list[str]:
    """What the last runs of the shards do not have in common; the parts come in the order in which these began."""
    facts = [part.facts() for part in parts]
    last = parts[-1].folder
    warnings = []
    for what, counts in facts[-1].items():
        others = [str(part.folder) for part, one in zip(parts, facts, strict=True) if one[what] != counts]
        if others:
            warnings.append(
                f"{join_and(others)}: had other {what} than {last}, which began last and counts for the class; "
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


# What is kept of each run and submission beside the results. An earlier kit did not have all of it.
_OF_RUNS = ("reused", "arrivals", "feedback_given")


def put_in_order(target: sqlite3.Connection) -> None:
    """The number of a run tells when it began, also when its shard was merged later than others."""
    numbers = [row["number"] for row in target.execute("SELECT number FROM runs ORDER BY started_at, number")]
    if numbers == sorted(numbers):
        return
    target.execute("PRAGMA defer_foreign_keys = ON")
    tables = ("results", "pictures", "sources", *_OF_RUNS)
    places = [("runs", "number"), *((table, "run") for table in tables if has_table(target, table))]
    for table, column in places:  # the names are those above
        target.execute(f"UPDATE {table} SET {column} = -{column}")  # noqa: S608
        for new, old in enumerate(numbers, start=1):
            target.execute(f"UPDATE {table} SET {column} = ? WHERE {column} = ?", (new, -old))  # noqa: S608


class _Merge:
    """Adds runs and results that the target does not hold yet; those that it holds stay."""

    def __init__(self, target: ClassDatabase) -> None:
        self._target = target.connection
        self._names = target.names()

    def _id(self, entry: str) -> int:
        return int(self._target.execute("SELECT id FROM submissions WHERE entry = ?", (entry,)).fetchone()["id"])

    def submissions(self, part: ShardDatabase) -> dict[int, int]:
        """Gives the target's ids by those of the part. Of an entry's files the shard that graded it knows the time."""
        for row in part.submissions:
            entry = row["entry"]
            if entry not in self._names:
                taken = {**self._names, f"{entry}\0": ""}
                free = row["name"] not in self._names.values()
                self._names[entry] = row["name"] if free else name_entries([entry], taken)[entry]
                columns = {key: value for key, value in row.items() if key != "id"}
                insert(self._target, "submissions", {**columns, "name": self._names[entry]})
            elif row["scope"] == "here" and row["submitted_from"] != "roster":
                self._target.execute(
                    "UPDATE submissions SET submitted_at = :submitted_at, submitted_from = :submitted_from "
                    "WHERE entry = :entry AND submitted_from <> 'roster'",
                    row,
                )
        return {row["id"]: self._id(row["entry"]) for row in part.submissions}

    def register(self, part: ShardDatabase) -> None:
        """Each shard knows the whole class. Who is in it, and who handed in what, is as the last one found it."""
        for row in part.submissions:
            self._target.execute(
                "UPDATE submissions SET note = :note, scope = CASE :scope WHEN 'gone' THEN 'gone' ELSE 'here' END, "
                "submitted_at = CASE WHEN :roster OR submitted_from = 'roster' THEN :submitted_at ELSE submitted_at "
                "END, submitted_from = CASE WHEN :roster OR submitted_from = 'roster' THEN :submitted_from "
                "ELSE submitted_from END WHERE entry = :entry",
                {**row, "roster": row["submitted_from"] == "roster"},
            )
        self._target.execute("DELETE FROM students")
        for row in part.students:
            insert(self._target, "students", row)
        ids = {row["id"]: self._id(row["entry"]) for row in part.submissions}
        for row in part.handed_in:
            insert(self._target, "handed_in", {**row, "submission": ids[row["submission"]]})
        self._target.execute("DELETE FROM left_out")
        if has_table(part.connection, "left_out"):
            for row in rows_of(part.connection, "SELECT submission FROM left_out"):
                insert(self._target, "left_out", {"submission": ids[row["submission"]]})

    def _run(self, row: dict[str, Any]) -> int:
        columns = {key: value for key, value in row.items() if key != "number"}
        insert(
            self._target,
            "runs",
            columns,
            "ON CONFLICT (uid) DO UPDATE SET state = excluded.state, ended_at = excluded.ended_at, "
            "reused = excluded.reused",
        )
        return int(self._target.execute("SELECT number FROM runs WHERE uid = ?", (row["uid"],)).fetchone()["number"])

    def run(self, source: sqlite3.Connection, row: dict[str, Any], ids: dict[int, int]) -> None:
        """One run with its results and pictures."""
        number = self._run(row)
        if has_table(source, "given"):
            for given in rows_of(source, "SELECT * FROM given WHERE uid = ?", row["uid"]):
                insert(self._target, "given", given, "ON CONFLICT (uid) DO NOTHING")
        for result in rows_of(source, "SELECT * FROM results WHERE run = ?", row["number"]):
            place = {"submission": ids[result["submission"]], "run": number}
            done = insert(self._target, "results", {**result, **place}, "ON CONFLICT (submission, run) DO NOTHING")
            if not done:
                continue
            query = "SELECT path, sha256, data FROM pictures JOIN blobs USING (sha256) WHERE submission = ? AND run = ?"
            for picture in rows_of(source, query, result["submission"], row["number"]):
                blob = {"sha256": picture["sha256"], "data": picture["data"]}
                insert(self._target, "blobs", blob, "ON CONFLICT (sha256) DO NOTHING")
                insert(self._target, "pictures", {**place, "path": picture["path"], "sha256": picture["sha256"]})
        self._sources(source, row["number"], number, ids)
        for table in filter(lambda name: has_table(source, name), _OF_RUNS):
            for kept in rows_of(source, f"SELECT * FROM {table} WHERE run = ?", row["number"]):  # noqa: S608
                place = {"submission": ids[kept["submission"]], "run": number}
                insert(self._target, table, {**kept, **place}, "ON CONFLICT DO NOTHING")

    def _sources(self, source: sqlite3.Connection, theirs: int, ours: int, ids: dict[int, int]) -> None:
        """The code of results, also where an earlier kit had not kept it when they were merged."""
        if not has_table(source, "sources"):
            return
        query = "SELECT submission, step, sha256, data FROM sources JOIN blobs USING (sha256) WHERE run = ?"
        for kept in rows_of(source, query, theirs):
            blob = {"sha256": kept["sha256"], "data": kept["data"]}
            insert(self._target, "blobs", blob, "ON CONFLICT (sha256) DO NOTHING")
            place = {"submission": ids[kept["submission"]], "run": ours, "step": kept["step"]}
            insert(self._target, "sources", {**place, "sha256": kept["sha256"]}, "ON CONFLICT DO NOTHING")

    def annotations(self, source: sqlite3.Connection, ids: dict[int, int]) -> None:
        """What people did stays what it is, whoever has it first."""
        if not has_table(source, "annotations"):
            return
        for row in rows_of(source, "SELECT * FROM annotations ORDER BY serial"):
            columns = {name: value for name, value in row.items() if name != "serial"}
            mine = {**columns, "submission": ids[row["submission"]]}
            insert(self._target, "annotations", mine, "ON CONFLICT (uid) DO NOTHING")


def _check(folders: list[Path], target: ClassDatabase) -> None:
    for folder in folders:
        if not (folder / FILE).is_file():
            raise UsageError(f"{folder}: holds no {FILE}; expected the --out folder of a shard")
        if (folder / FILE).samefile(target.path):
            raise UsageError(f"{folder}: is the folder that the shards are merged into; name another one with --out")


def merge(folders: list[Path], target: ClassDatabase) -> tuple[list[str], list[str]]:
    """Runs are put into the order in which they began. Returns the shards that are missing, and warnings."""
    _check(folders, target)
    with ExitStack() as stack:
        parts = [ShardDatabase(folder, stack.enter_context(open_readonly(folder / FILE))) for folder in folders]
        parts = sorted((part for part in parts if part.runs), key=lambda part: part.began)
        if not parts:
            raise UsageError("nothing has been graded in any of these folders")
        with transaction(target.connection):
            before = target.connection.execute("SELECT max(started_at) AS began FROM runs").fetchone()["began"] or ""
            merging = _Merge(target)
            for part in parts:
                ids = merging.submissions(part)
                for row in part.runs:
                    merging.run(part.connection, row, ids)
                merging.annotations(part.connection, ids)
            if parts[-1].began >= before:
                merging.register(parts[-1])
            # An entry whose shard is missing is shown as not graded.
            target.connection.execute("UPDATE submissions SET scope = 'here' WHERE scope = 'elsewhere'")
            put_in_order(target.connection)
        return missing_shards(target.connection), disagreements(parts)
