"""How one submission stands."""

import json
import sqlite3
from collections import Counter
from collections.abc import Sequence
from typing import Any

from raysteps.classroom.database import ClassDatabase
from raysteps.classroom.entries import read_shard
from raysteps.classroom.late_policy import LatePolicy
from raysteps.classroom.lateness import apply_policy, with_zone
from raysteps.classroom.names import folded, stem

Document = dict[str, Any]


def _step(step: Document) -> Document:
    return {"points": step["points"], "max": step["max"], "status": step["status"]}


def _mistakes(step: Document) -> list[str]:
    """Titles of the known mistakes in a step of a result."""
    return sorted({found["title"] for found in step.get("diagnoses", ()) if found["kind"] == "mistake"})


def _result(row: sqlite3.Row | None) -> Document:
    """What a submission got."""
    if row is None:
        nothing: Document = {"status": "not-graded", "points": None, "max": None, "run": None, "steps": {}}
        return {**nothing, "inconsistent": {}, "mistakes": {}, "seconds": None}
    empty: Document = {"total": {"max": None}, "steps": []}
    document = json.loads(row["document"]) if row["document"] else empty
    return {
        "status": row["status"],
        "points": row["points"],
        "max": document["total"]["max"],
        "run": row["run"],
        "steps": {step["id"]: _step(step) for step in document["steps"]},
        "inconsistent": {step["id"]: step["inconsistent"] for step in document["steps"] if step["inconsistent"]},
        "mistakes": {step["id"]: titles for step in document["steps"] if (titles := _mistakes(step))},
        "seconds": round(row["seconds"], 2),
    }


class Standings:
    """Of the submissions of a class, after these last runs: one, or one for each shard."""

    def __init__(self, database: ClassDatabase, policy: LatePolicy | None, runs: Sequence[sqlite3.Row]) -> None:
        self._database = database
        self._query = database.connection.execute
        self._policy = policy
        self._runs = {row["number"]: row for row in runs}
        people = self._query("SELECT id, email FROM students").fetchall()
        self._mistakes: Counter[tuple[str, str]] = Counter()
        self._people = {folded(word) for row in people for word in (row["id"], row["email"]) if word}

    def _students(self, submission: int) -> list[Document]:
        rows = self._query(
            "SELECT id, name, email FROM students JOIN handed_in ON handed_in.student = students.number "
            "WHERE submission = ? ORDER BY id, name, email",
            (submission,),
        )
        return [dict(row) for row in rows]

    def _before(self, submission: int, run: int | None) -> Document | None:
        """The result that counted until the last run gave another one."""
        if run not in self._runs:
            return None
        row = self._query(
            "SELECT run, status, points FROM results WHERE submission = ? AND run < ? ORDER BY run DESC LIMIT 1",
            (submission, run),
        ).fetchone()
        return dict(row) if row is not None else None

    def extended(self, row: sqlite3.Row, students: list[Document]) -> list[str]:
        """By what names an extension may be given: also that of the submission, unless it is what another one on the
        roster is called."""
        words = [word for student in students for word in (student["id"], student["email"]) if word]
        names = (row["name"], stem(row["entry"]), row["entry"])
        return words + [name for name in names if folded(name) not in self._people]

    def _is_outdated(self, row: sqlite3.Row, run: int | None) -> bool:
        """Whether the last run was broken off before it came to this submission, so that an earlier result stands."""
        mine = [number for number, last in self._runs.items() if read_shard(last["shard"]).holds(row["entry"])]
        if run is None or run in mine or (mine and self._runs[mine[-1]]["state"] == "complete"):
            return False
        marks = ", ".join("?" * len(mine))
        query = f"SELECT 1 FROM reused WHERE submission = ? AND run IN ({marks})"  # noqa: S608
        return self._query(query, (row["id"], *mine)).fetchone() is None

    def mistakes(self) -> list[Document]:
        """Of all submissions whose standing was asked for; what most of them did comes first."""
        found = sorted(self._mistakes.items(), key=lambda item: (-item[1], item[0]))
        return [{"step": step, "title": title, "submissions": amount} for (step, title), amount in found]

    def of(self, row: sqlite3.Row) -> Document:
        current = self._database.current(row["name"])
        students = self._students(row["id"])
        result = _result(current)
        self._mistakes.update((step, title) for step, titles in result["mistakes"].items() for title in titles)
        late = None
        ids = self.extended(row, students)
        if self._policy is not None and result["points"] is not None:
            by_file = row["submitted_from"] == "files"
            late = vars(apply_policy(self._policy, ids, row["submitted_at"], result["points"], by_file=by_file))
        return {
            "name": row["name"],
            "entry": row["entry"],
            "students": students,
            **result,
            "final": late["points"] if late is not None else result["points"],
            "late": late,
            "submitted_at": with_zone(self._policy, ids, row["submitted_at"]),
            "submitted_from": row["submitted_from"],
            "outdated": self._is_outdated(row, result["run"]),
            "before": self._before(row["id"], result["run"]),
            "isolation": json.loads(current["document"])["isolation"]["name"]
            if current and current["document"]
            else "",
            "fault": current["fault"] if current is not None else "",
            "note": row["note"],
            "results": f"submissions/{row['name']}/results.json" if current and current["document"] else None,
        }
