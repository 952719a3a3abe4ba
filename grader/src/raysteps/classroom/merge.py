"""Brings the databases of shards together in one."""

import sqlite3
from pathlib import Path
from typing import Any

from raysteps.classroom.database import FILE, ClassDatabase, insert
from raysteps.classroom.names import name_entries
from raysteps.classroom.tables import transaction
from raysteps.common.errors import UsageError

_RANK = {"gone": 0, "elsewhere": 1, "here": 2}


def _rows(source: sqlite3.Connection, query: str, *values: Any) -> list[dict[str, Any]]:
    return [dict(row) for row in source.execute(query, values)]


class _Merge:
    """Copies what the target does not hold yet; what it holds stays."""

    def __init__(self, target: ClassDatabase) -> None:
        self._target = target.connection
        self._names = target.names()

    def _submission(self, row: dict[str, Any]) -> int:
        """The target's id of the entry. Of what two shards say about it, that of the shard that graded it counts."""
        entry = row["entry"]
        known = self._target.execute("SELECT id, scope FROM submissions WHERE entry = ?", (entry,)).fetchone()
        if known is None:
            taken = {**self._names, f"{entry}\0": ""}
            free = row["name"] not in self._names.values()
            self._names[entry] = row["name"] if free else name_entries([entry], taken)[entry]
            columns = {key: value for key, value in row.items() if key != "id"}
            insert(self._target, "submissions", {**columns, "name": self._names[entry]})
        elif _RANK[row["scope"]] >= _RANK[known["scope"]]:
            self._target.execute(
                "UPDATE submissions SET scope = :scope, submitted_at = :submitted_at, "
                "submitted_from = :submitted_from, note = :note WHERE entry = :entry",
                row,
            )
        return int(self._target.execute("SELECT id FROM submissions WHERE entry = ?", (entry,)).fetchone()["id"])

    def _student(self, row: dict[str, Any]) -> int:
        columns = {key: value for key, value in row.items() if key != "number"}
        insert(self._target, "students", columns, "ON CONFLICT (id, name, email) DO UPDATE SET note = excluded.note")
        query = "SELECT number FROM students WHERE id = :id AND name = :name AND email = :email"
        return int(self._target.execute(query, columns).fetchone()["number"])

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

    def people(self, source: sqlite3.Connection) -> dict[int, int]:
        """Submissions and students. Gives the target's ids of the submissions."""
        ids = {row["id"]: self._submission(row) for row in _rows(source, "SELECT * FROM submissions ORDER BY entry")}
        students = {row["number"]: self._student(row) for row in _rows(source, "SELECT * FROM students")}
        for row in _rows(source, "SELECT * FROM handed_in"):
            pair = {"student": students[row["student"]], "submission": ids[row["submission"]]}
            insert(self._target, "handed_in", pair, "ON CONFLICT DO NOTHING")
        return ids

    def run(self, source: sqlite3.Connection, row: dict[str, Any], ids: dict[int, int]) -> None:
        """One run with its results and pictures."""
        number = self._run(row)
        for result in _rows(source, "SELECT * FROM results WHERE run = ?", row["number"]):
            place = {"submission": ids[result["submission"]], "run": number}
            done = insert(self._target, "results", {**result, **place}, "ON CONFLICT (submission, run) DO NOTHING")
            if not done:
                continue
            query = "SELECT path, sha256, data FROM pictures JOIN blobs USING (sha256) WHERE submission = ? AND run = ?"
            for picture in _rows(source, query, result["submission"], row["number"]):
                blob = {"sha256": picture["sha256"], "data": picture["data"]}
                insert(self._target, "blobs", blob, "ON CONFLICT (sha256) DO NOTHING")
                insert(self._target, "pictures", {**place, "path": picture["path"], "sha256": picture["sha256"]})

    def close_gaps(self) -> None:
        """An entry whose shard is missing is shown as not graded."""
        self._target.execute("UPDATE submissions SET scope = 'here' WHERE scope = 'elsewhere'")


def _missing_shards(target: sqlite3.Connection) -> list[str]:
    """Those that no run was for, where a class was divided."""
    shards = {tuple(map(int, row["shard"].split("/"))) for row in target.execute("SELECT shard FROM runs")}
    count = max(count for _, count in shards)
    if (1, 1) in shards:
        return []
    return [f"{index}/{count}" for index in range(1, count + 1) if (index, count) not in shards]


def merge(folders: list[Path], target: ClassDatabase) -> list[str]:
    """Runs keep the order in which they began. Returns the shards that are missing."""
    for folder in folders:
        if not (folder / FILE).is_file():
            raise UsageError(f"{folder}: holds no {FILE}; expected the --out folder of a shard")
        if (folder / FILE).samefile(target.path):
            raise UsageError(f"{folder}: is the folder that the shards are merged into; name another one with --out")
    sources = [ClassDatabase(folder) for folder in folders]
    try:
        with transaction(target.connection):
            merging = _Merge(target)
            ids = [merging.people(source.connection) for source in sources]
            runs = [
                (row["started_at"], at, row)
                for at, source in enumerate(sources)
                for row in _rows(source.connection, "SELECT * FROM runs ORDER BY number")
            ]
            if not runs:
                raise UsageError("nothing has been graded in any of these folders")
            for _, at, row in sorted(runs, key=lambda run: (run[0], run[1], run[2]["number"])):
                merging.run(sources[at].connection, row, ids[at])
            merging.close_gaps()
    finally:
        for source in sources:
            source.close()
    return _missing_shards(target.connection)
