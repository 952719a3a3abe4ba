"""What is known of a class, as class.json: made from the database, and from nothing else."""

import json
import sqlite3
import statistics
from collections.abc import Sequence
from typing import Any

from raysteps.classroom.database import ClassDatabase
from raysteps.classroom.late_policy import parse_late_policy
from raysteps.classroom.names import folded, stem
from raysteps.classroom.standing import Standings
from raysteps.common.errors import GraderFault
from raysteps.common.schemas import complaint, read_schema

Document = dict[str, Any]


def _last_runs(runs: Sequence[sqlite3.Row]) -> list[sqlite3.Row]:
    """The last run; of a class that was divided, the last one of each shard."""
    count = runs[-1]["shard"].split("/")[1]
    return list({row["shard"]: row for row in runs if row["shard"].split("/")[1] == count}.values())


class _Report:
    def __init__(self, database: ClassDatabase) -> None:
        self._database = database
        self._query = database.connection.execute
        self._runs = self._query("SELECT * FROM runs ORDER BY number").fetchall()
        if not self._runs:
            raise GraderFault(f"{database.path}: holds no run")
        self._last = self._runs[-1]
        text = self._last["late_policy"]
        self._policy = parse_late_policy(text, "the late policy of the run") if text else None

    def _run(self, row: sqlite3.Row) -> Document:
        counts = {"graded": 0, "unreadable": 0, "fault": 0}
        query = "SELECT status, count(*) AS amount FROM results WHERE run = ? GROUP BY status"
        counts |= {found["status"]: found["amount"] for found in self._query(query, (row["number"],))}
        words = ("number", "started_at", "ended_at", "state", "kit", "folder", "shard", "reused")
        return {**{word: row[word] for word in words}, "settings": json.loads(row["settings"]), "results": counts}

    def _unknown_extensions(self, submissions: list[Document]) -> list[str]:
        known = {folded(name) for one in submissions for name in (one["name"], one["entry"], stem(one["entry"]))}
        for row in self._query("SELECT id, email FROM students"):
            known |= {folded(row["id"]), folded(row["email"])}
        extensions = self._policy.extensions if self._policy is not None else {}
        return sorted(student for student in extensions if student not in known)

    def _names(self, scope: str) -> list[str]:
        rows = self._query("SELECT name FROM submissions WHERE scope = ? ORDER BY entry", (scope,))
        return [row["name"] for row in rows]

    def document(self) -> Document:
        rows = self._query("SELECT * FROM submissions WHERE scope = 'here' ORDER BY entry").fetchall()
        standings = Standings(self._database, self._policy, _last_runs(self._runs))
        submissions = [standings.of(row) for row in rows]
        absent = self._query(
            "SELECT id, name, email, note FROM students WHERE number NOT IN (SELECT student FROM handed_in) "
            "ORDER BY id, name, email"
        )
        several = self._query(
            "SELECT id, name, email, note FROM students WHERE number IN "
            "(SELECT student FROM handed_in GROUP BY student HAVING count(*) > 1) ORDER BY id, name, email"
        )
        students = self._query("SELECT count(*) AS amount FROM students").fetchone()["amount"]
        finals = [one["final"] for one in submissions if one["status"] == "graded"]
        return {
            "schema": "raysteps/class/v1",
            "run": self._run(self._last),
            "runs": [self._run(row) for row in self._runs],
            "steps": json.loads(self._last["steps"]),
            "late_policy": self._last["late_policy"] or None,
            "submissions": submissions,
            "students_without_submission": [dict(row) for row in absent],
            "students_with_several": [dict(row) for row in several],
            "submissions_without_student": [one["name"] for one in submissions if students and not one["students"]],
            "not_graded": [one["name"] for one in submissions if one["status"] == "not-graded"],
            "faults": [one["name"] for one in submissions if one["status"] == "fault"],
            "unreadable": [one["name"] for one in submissions if one["status"] == "unreadable"],
            "inconsistent": [one["name"] for one in submissions if one["inconsistent"]],
            "changed": [
                {"name": one["name"], "before": one["before"]["points"], "after": one["points"]}
                for one in submissions
                if one["before"] is not None and one["before"]["points"] != one["points"]
            ],
            "outdated": [one["name"] for one in submissions if one["outdated"]],
            "mistakes": standings.mistakes(),
            "gone": self._names("gone"),
            "ignored": json.loads(self._last["ignored"]),
            "unknown_extensions": self._unknown_extensions(submissions),
            "statistics": {
                "graded": len(finals),
                "mean": round(statistics.fmean(finals), 2) if finals else None,
                "median": round(statistics.median(finals), 2) if finals else None,
            },
        }


def class_document(database: ClassDatabase) -> Document:
    """Checked against its schema."""
    document = _Report(database).document()
    problem = complaint(document, read_schema("raysteps.classroom", "class.schema.json"))
    if problem:
        raise GraderFault(f"class.json would break its schema: {problem}")
    return document
