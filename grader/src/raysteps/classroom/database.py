"""What class.sqlite is told, and what it tells."""

import hashlib
import json
import sqlite3
from collections.abc import Collection, Iterable
from pathlib import Path
from typing import Literal

from raysteps.classroom.messages import Answer
from raysteps.classroom.records import Registered, Registration, RunFacts
from raysteps.classroom.statements import insert, now
from raysteps.classroom.tables import open_database, transaction
from raysteps.judge.feedback import Feedback

FILE = "class.sqlite"
LOCK = "class.lock"
# The run whose result of a submission counts.
LATEST = "SELECT max(run) FROM results AS later WHERE later.submission = results.submission"


class ClassDatabase:
    """One class. What a method writes is there as a whole or not at all."""

    def __init__(self, folder: Path, connection: sqlite3.Connection | None = None) -> None:
        """`connection` is one that only reads."""
        self.path = folder / FILE
        self.connection = connection or open_database(self.path)

    def close(self) -> None:
        self.connection.close()

    def names(self) -> dict[str, str]:
        """Entry -> name of all entries that were ever seen."""
        return {row["entry"]: row["name"] for row in self.connection.execute("SELECT entry, name FROM submissions")}

    def begin_run(self, facts: RunFacts, entries: Iterable[Registered], students: Iterable[Registration]) -> int:
        """Registers who and what is there now, and gives the number of the new run."""
        with transaction(self.connection):
            self.connection.execute("UPDATE runs SET state = 'interrupted' WHERE state = 'running'")
            row = {
                "uid": facts.uid,
                "started_at": now("microseconds"),  # runs of several machines are put in order by it
                "state": "running",
                "kit": facts.kit,
                "folder": facts.folder,
                "shard": facts.shard,
                "settings": json.dumps(dict(facts.settings), sort_keys=True),
                "steps": json.dumps(facts.steps),
                "late_policy": facts.late_policy,
                "ignored": json.dumps(facts.ignored),
            }
            insert(self.connection, "runs", row)
            given = {"uid": facts.uid, "roster": facts.roster, "files": json.dumps(facts.files)}
            insert(self.connection, "given", given)
            (number,) = self.connection.execute("SELECT max(number) FROM runs").fetchone()
            self.connection.execute("UPDATE submissions SET scope = 'gone'")
            self.connection.execute("DELETE FROM students")
            for entry in entries:
                self._register(entry)
            for student in students:
                self._enrol(student)
        return int(number)

    def _register(self, entry: Registered) -> None:
        row = dict(vars(entry))
        insert(self.connection, "submissions", row, "ON CONFLICT (entry) DO NOTHING")
        self.connection.execute(
            "UPDATE submissions SET scope = :scope, submitted_at = :submitted_at, submitted_from = :submitted_from, "
            "note = :note WHERE entry = :entry",
            row,
        )

    def _enrol(self, student: Registration) -> None:
        row = {"id": student.id, "name": student.name, "email": student.email, "note": student.note}
        insert(self.connection, "students", row, "ON CONFLICT (id, name, email) DO NOTHING")
        for entry in student.entries:
            self.connection.execute(
                "INSERT OR IGNORE INTO handed_in (student, submission) SELECT students.number, submissions.id "
                "FROM students, submissions WHERE students.id = :id AND students.name = :name "
                "AND students.email = :email AND entry = :entry",
                {**row, "entry": entry},
            )

    def end_run(self, run: int, state: Literal["complete", "interrupted"], reused: Collection[str]) -> None:
        """`reused` are the submissions whose earlier result was found to hold."""
        with transaction(self.connection):
            self.connection.execute(
                "UPDATE runs SET state = ?, ended_at = ?, reused = ? WHERE number = ?", (state, now(), len(reused), run)
            )
            self.connection.executemany(
                "INSERT OR IGNORE INTO reused (submission, run) SELECT id, ? FROM submissions WHERE name = ?",
                [(run, name) for name in reused],
            )

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

    def record(self, run: int, answer: Answer, key: str, *, unreadable: bool = False) -> bool:
        """Keeps an answer; False when the run already has a result of this submission, which then stays."""
        document = answer.document
        with transaction(self.connection):
            (submission,) = self.connection.execute(
                "SELECT id FROM submissions WHERE name = ?", (answer.name,)
            ).fetchone()
            row = {
                "submission": submission,
                "run": run,
                "key": key,
                "status": "unreadable" if unreadable and document is not None else answer.status,
                "points": None if document is None else document["total"]["points"],
                "document": "" if document is None else json.dumps(document, ensure_ascii=False),
                "fault": answer.fault,
                "details": answer.details,
                "worker": answer.worker,
                "seconds": answer.seconds,
                "finished_at": now(),
            }
            if insert(self.connection, "results", row, "ON CONFLICT (submission, run) DO NOTHING") == 0:
                return False
            for path, data in answer.pictures.items():
                digest = hashlib.sha256(data).hexdigest()
                insert(self.connection, "blobs", {"sha256": digest, "data": data}, "ON CONFLICT (sha256) DO NOTHING")
                picture = {"submission": submission, "run": run, "path": path, "sha256": digest}
                insert(self.connection, "pictures", picture)
        return True

    def pictures(self, submission: int, run: int) -> dict[str, bytes]:
        rows = self.connection.execute(
            "SELECT path, data FROM pictures JOIN blobs USING (sha256) WHERE submission = ? AND run = ?",
            (submission, run),
        )
        return {row["path"]: row["data"] for row in rows}
