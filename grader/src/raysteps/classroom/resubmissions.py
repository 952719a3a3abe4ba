"""What a student handed in before, by what earlier runs kept: a run with another kit or seed is no resubmission."""

import hashlib
import json
import sqlite3
from collections import defaultdict
from collections.abc import Sequence
from itertools import groupby

from raysteps.classroom.database import has_table
from raysteps.classroom.entries import folded, platform_identity, stem
from raysteps.results.model import EarlierStep, EarlierSubmission
from raysteps.results.store import stored_results
from raysteps.submission.load import Submission

_MAX = 20  # that are told, the last ones


def sources_digest(submission: Submission) -> str:
    """Of what was handed in and nothing else: neither names nor the kit."""
    sources = {step: hashlib.sha256(data).hexdigest() for step, data in submission.sources.items()}
    text = json.dumps([sources, submission.notes], sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()


def _whose(entry: str) -> tuple[str, ...]:
    """Alike for the entries that a platform made of one student's uploads (Canvas gives each upload a number of its
    own), and for `ann.zip` and `ann.tar`."""
    name, number = platform_identity(entry)
    return (folded(name), number) if number else (folded(stem(entry)),)


def _grading(row: sqlite3.Row) -> tuple[str, str]:
    """What a result depends on beside the submission. How much students are told changes no points."""
    settings = {key: value for key, value in json.loads(row["settings"]).items() if key != "feedback"}
    return row["kit"], json.dumps(settings, sort_keys=True)


_ROWS = """
SELECT results.submission, results.run, results.finished_at, arrivals.digest, arrivals.submitted_at,
    arrivals.submitted_from, runs.kit, runs.settings
FROM results JOIN arrivals USING (submission, run) JOIN runs ON runs.number = results.run
WHERE results.status <> 'fault' AND results.submission IN ({marks}) ORDER BY results.run
"""


class Resubmissions:
    """Of a class, after its last run. A database that an earlier kit wrote tells nothing."""

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._query = connection.execute
        self._is_known = has_table(connection, "arrivals")
        self._gone: dict[tuple[str, ...], list[int]] = defaultdict(list)
        for row in self._query("SELECT id, entry FROM submissions WHERE scope = 'gone'"):
            self._gone[_whose(row["entry"])].append(row["id"])

    def _digest(self, submission: int, run: int) -> str | None:
        query = "SELECT digest FROM arrivals WHERE submission = ? AND run = ?"
        row = self._query(query, (submission, run)).fetchone() if self._is_known else None
        return str(row["digest"]) if row is not None else None

    def has_changed(self, submission: int, before: int, now: int) -> bool | None:
        """Whether something else was handed in between two runs; None where that was not kept."""
        digests = self._digest(submission, before), self._digest(submission, now)
        return digests[0] != digests[1] if None not in digests else None

    def _versions(self, row: sqlite3.Row, run: int) -> list[sqlite3.Row]:
        """Of each thing that was handed in, the last result; the present one comes last."""
        ids = [row["id"], *(one for one in self._gone[_whose(row["entry"])] if one != row["id"])]
        rows = self._query(_ROWS.format(marks=", ".join("?" * len(ids))), ids).fetchall()
        rows = [one for one in rows if one["run"] < run or (one["run"] == run and one["submission"] == row["id"])]
        if not rows or rows[-1]["run"] != run:
            return []
        return [list(same)[-1] for _, same in groupby(rows, key=lambda one: str(one["digest"]))]

    def before(self, row: sqlite3.Row, run: int | None) -> list[EarlierSubmission]:
        """What was handed in before the result of this run, the oldest first. `row` is that of the submission."""
        versions = self._versions(row, run) if self._is_known and run is not None else []
        told = [self._told(number, versions) for number in range(max(1, len(versions) - _MAX), len(versions))]
        return [one for one in told if one is not None]

    def _told(self, number: int, versions: Sequence[sqlite3.Row]) -> EarlierSubmission | None:
        one = versions[number - 1]
        query = "SELECT document FROM results WHERE submission = ? AND run = ?"
        results = stored_results(self._query(query, (one["submission"], one["run"])).fetchone()["document"])
        if results is None:
            return None
        return EarlierSubmission(
            submitted_at=one["submitted_at"],
            by_file=one["submitted_from"] == "files",
            graded_at=one["finished_at"],
            points=results.total.points,
            steps={step.id: EarlierStep(step.points, step.status) for step in results.steps},
            same_grading=_grading(one) == _grading(versions[-1]),
            number=number,
        )
