"""Brings the databases of shards together in one."""

import sqlite3
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from raysteps.classroom.database import FILE, ClassDatabase
from raysteps.classroom.merge_check import Part, disagreements, missing_shards, put_in_order, rows_of
from raysteps.classroom.names import name_entries
from raysteps.classroom.reading import reading
from raysteps.classroom.statements import insert
from raysteps.classroom.tables import transaction
from raysteps.common.errors import UsageError


class _Merge:
    """Adds runs and results that the target does not hold yet; those that it holds stay."""

    def __init__(self, target: ClassDatabase) -> None:
        self._target = target.connection
        self._names = target.names()

    def _id(self, entry: str) -> int:
        return int(self._target.execute("SELECT id FROM submissions WHERE entry = ?", (entry,)).fetchone()["id"])

    def submissions(self, part: Part) -> dict[int, int]:
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

    def register(self, part: Part) -> None:
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
        entries = {row["id"]: row["entry"] for row in part.submissions}
        for row in part.handed_in:
            insert(self._target, "handed_in", {**row, "submission": self._id(entries[row["submission"]])})

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
        if source.execute("SELECT 1 FROM sqlite_master WHERE name = 'given'").fetchone():
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
        if source.execute("SELECT 1 FROM sqlite_master WHERE name = 'reused'").fetchone():
            for kept in rows_of(source, "SELECT submission FROM reused WHERE run = ?", row["number"]):
                place = {"submission": ids[kept["submission"]], "run": number}
                insert(self._target, "reused", place, "ON CONFLICT DO NOTHING")


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
        parts = [Part(folder, stack.enter_context(reading(folder / FILE))) for folder in folders]
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
            if parts[-1].began >= before:
                merging.register(parts[-1])
            # An entry whose shard is missing is shown as not graded.
            target.connection.execute("UPDATE submissions SET scope = 'here' WHERE scope = 'elsewhere'")
            put_in_order(target.connection)
        return missing_shards(target.connection), disagreements(parts)
