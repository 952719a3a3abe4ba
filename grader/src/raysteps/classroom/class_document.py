"""What is known of a class, as class.json: made from the database, and from nothing else."""

import json
import sqlite3
import statistics
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

from raysteps.classroom.database import SUBMISSIONS, ClassDatabase, has_table
from raysteps.classroom.entries import NOTHING_TAKEN, folded, read_shard, stem
from raysteps.classroom.late_policy import apply_policy, parse_late_policy, with_zone
from raysteps.classroom.resubmissions import Resubmissions
from raysteps.classroom.review import review_of_nothing, reviewed
from raysteps.common.documents import Malformed, checked, convert, parse
from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.course.manifest import Step, read_manifests
from raysteps.course.project import here
from raysteps.results.class_model import (
    ClassResults,
    ClassRun,
    ClassStatistics,
    EarlierResult,
    GradedStep,
    GradedSubmission,
    MistakeCount,
    NotedStudent,
    PointsChange,
    RunCounts,
    StepPoints,
    Student,
)
from raysteps.results.model import USED_WITHOUT_VALUE, HandIn, Settings, StepResult
from raysteps.results.store import RESULTS, stored_results

# How one submission stands.


def _mistakes(step: StepResult) -> list[str]:
    """Titles of the known mistakes in a step of a result, and of the one that every step can have."""
    titles = {found.title for found in step.diagnoses if found.kind == "mistake"}
    unset = {"a variable is used that was given no value" for one in step.diagnoses if one.id == USED_WITHOUT_VALUE}
    return sorted(titles | unset)


def _not_taken(status: str, steps: Sequence[StepResult]) -> list[str]:
    """A kit that did not keep the reasons by themselves has them among the messages, where nothing could be read."""
    if status == "unreadable":
        said = (words for step in steps[:1] for words in step.messages[:1])
        return [f"It {words.removeprefix(NOTHING_TAKEN.removesuffix('it ')).removeprefix('it ')}" for words in said]
    return [f"{step.id}: {step.not_taken}" for step in steps if step.not_taken]


def steps_of(graded: Sequence[GradedStep]) -> list[Step]:
    """The kit's steps as a run graded them: what course.toml says today does not count."""
    told = {step.id: vars(step) for step in graded}
    return [replace(step, **told.get(step.id, {})) for step in read_manifests(here()) if not step.left_out]


OTHER_FORM = "graded by a kit of another form; grade it again"


class CurrentResults:
    """Of the submissions of a class, after its last runs: one, or one for each shard. What is the same for all of
    them, such as roster and late policy, is read once."""

    def __init__(self, database: ClassDatabase) -> None:
        self._database = database
        self._query = database.connection.execute
        self.all_runs = self._query("SELECT * FROM runs ORDER BY number").fetchall()
        if not self.all_runs:
            raise GraderFault(f"{database.path}: holds no run")
        self.last = self.all_runs[-1]
        # A database that is only read may be one of an earlier kit, which did not keep the course.
        self.course = self.last["course"] if "course" in self.last.keys() else ""  # noqa: SIM118
        self.steps = convert(json.loads(self.last["steps"]), list[GradedStep])
        text = self.last["late_policy"]
        self.policy = parse_late_policy(text, "the late policy of the run") if text else None
        self._runs = {row["number"]: row for row in _last_runs(self.all_runs)}
        people = self._query("SELECT id, email FROM students").fetchall()
        self.has_roster = bool(people)
        self._resubmissions = Resubmissions(database.connection)
        self._left_out = database.left_out() if has_table(database.connection, "left_out") else set()
        self._people = {folded(word) for row in people for word in (row["id"], row["email"]) if word}
        self._students: dict[int, list[Student]] = defaultdict(list)  # by submission
        for row in self._query(
            "SELECT submission, id, name, email FROM students JOIN handed_in ON handed_in.student = students.number "
            "ORDER BY name_order(id), name_order(name), email"
        ):
            self._students[row["submission"]].append(Student(row["id"], row["name"], row["email"]))

    def _before(self, submission: int, run: int | None) -> EarlierResult | None:
        """The result that counted until the last run gave another one."""
        if run not in self._runs:
            return None
        row = self._query(
            "SELECT run, status, points FROM results WHERE submission = ? AND run < ? ORDER BY run DESC LIMIT 1",
            (submission, run),
        ).fetchone()
        if row is None or run is None:
            return None
        return EarlierResult(**row, resubmitted=self._resubmissions.has_changed(submission, row["run"], run))

    def extended(self, row: sqlite3.Row, students: list[Student]) -> list[str]:
        """By what names an extension may be given: also that of the submission, unless it is what another one on the
        roster is called."""
        words = [word for student in students for word in (student.id, student.email) if word]
        names = (row["name"], stem(row["entry"]), row["entry"])
        return words + [name for name in names if folded(name) not in self._people]

    def _is_outdated(self, row: sqlite3.Row, run: int | None) -> bool:
        """Whether the last run was broken off before it came to this submission, or `nightly` saw that it has changed
        and waits, so that an earlier result stands."""
        if row["name"] in self._left_out:
            return run is not None
        mine = [number for number, last in self._runs.items() if read_shard(last["shard"]).holds(row["entry"])]
        if run is None or run in mine or (mine and self._runs[mine[-1]]["state"] == "complete"):
            return False
        marks = ", ".join("?" * len(mine))
        query = f"SELECT 1 FROM reused WHERE submission = ? AND run IN ({marks})"  # noqa: S608
        return self._query(query, (row["id"], *mine)).fetchone() is None

    @cached_property
    def manifests(self) -> list[Step]:
        return steps_of(self.steps)

    def named(self, name: str) -> GradedSubmission:
        return self.of(self._query("SELECT * FROM submissions WHERE name = ?", (name,)).fetchone())

    def of(self, row: sqlite3.Row) -> GradedSubmission:
        current = self._database.current(row["name"])
        results = stored_results(current["document"]) if current is not None else None
        is_unread = results is None and current is not None and bool(current["document"])
        steps = results.steps if results is not None else []
        automatic = current["points"] if current is not None else None
        review = review_of_nothing(self._database, row["id"], current["run"] if current is not None else None)
        if current is not None and results is not None:
            made = reviewed(self._database, row["id"], current["run"], results, self.manifests)
            results, steps, review = made.results, made.results.steps, made.review
        mistakes = {step.id: titles for step in steps if (titles := _mistakes(step))}
        students = self._students.get(row["id"], [])
        ids = self.extended(row, students)
        run = current["run"] if current is not None else None
        points = results.total.points if results is not None else automatic
        late = None
        if self.policy is not None and points is not None:
            by_file = row["submitted_from"] == "files"
            late = apply_policy(self.policy, ids, row["submitted_at"], points, by_file=by_file)
        return GradedSubmission(
            name=row["name"],
            entry=row["entry"],
            students=students,
            status=current["status"] if current is not None else "not-graded",
            points=points,
            max=results.total.max if results is not None else None,
            run=run,
            steps={step.id: StepPoints(step.points, step.max, step.status) for step in steps},
            mistakes=mistakes,
            seconds=round(current["seconds"], 2) if current is not None else None,
            final=late.points if late is not None else points,
            late=late,
            submitted_at=with_zone(self.policy, ids, row["submitted_at"]),
            submitted_from=row["submitted_from"],
            outdated=self._is_outdated(row, run),
            before=self._before(row["id"], run),
            earlier=self._resubmissions.before(row, run) if results is not None else [],
            isolation=results.isolation.name if results is not None else "",
            fault=current["fault"] if current is not None else "",
            note=" ".join(filter(None, (row["note"], OTHER_FORM if is_unread else ""))),
            not_taken=_not_taken(current["status"], steps) if current is not None else [],
            results=f"{SUBMISSIONS}/{row['name']}/{RESULTS}" if results is not None else None,
            review=review,
        )


def _last_runs(runs: Sequence[sqlite3.Row]) -> list[sqlite3.Row]:
    """The last run; of a class that was divided, the last one of each shard."""
    count = runs[-1]["shard"].split("/")[1]
    return list({row["shard"]: row for row in runs if row["shard"].split("/")[1] == count}.values())


def _count_mistakes(submissions: Iterable[GradedSubmission]) -> list[MistakeCount]:
    """What most of them did comes first."""
    amounts = Counter((step, title) for one in submissions for step, titles in one.mistakes.items() for title in titles)
    found = sorted(amounts.items(), key=lambda item: (-item[1], item[0]))
    return [MistakeCount(step, title, amount) for (step, title), amount in found]


class _Report:
    def __init__(self, database: ClassDatabase, known: Mapping[str, GradedSubmission]) -> None:
        self._known = known
        self._query = database.connection.execute
        self._current_results = CurrentResults(database)
        self._last = self._current_results.last

    def _run(self, row: sqlite3.Row) -> ClassRun:
        query = "SELECT status, count(*) AS amount FROM results WHERE run = ? GROUP BY status"
        counts = RunCounts(**{found["status"]: found["amount"] for found in self._query(query, (row["number"],))})
        words = ("number", "started_at", "ended_at", "state", "kit", "folder", "shard", "reused")
        settings = convert(json.loads(row["settings"]), Settings)
        return ClassRun(**{word: row[word] for word in words}, settings=settings, results=counts)

    def _unknown_extensions(self, submissions: list[GradedSubmission]) -> list[str]:
        known = {folded(name) for one in submissions for name in (one.name, one.entry, stem(one.entry))}
        for row in self._query("SELECT id, email FROM students"):
            known |= {folded(row["id"]), folded(row["email"])}
        policy = self._current_results.policy
        extensions = policy.extensions if policy is not None else {}
        return sorted(student for student in extensions if student not in known)

    def _names(self, scope: str) -> list[str]:
        rows = self._query("SELECT name FROM submissions WHERE scope = ? ORDER BY name_order(name)", (scope,))
        return [row["name"] for row in rows]

    def document(self) -> ClassResults:
        rows = self._query("SELECT * FROM submissions WHERE scope = 'here' ORDER BY name_order(name)").fetchall()
        current_results = self._current_results
        submissions = [self._known.get(row["name"]) or current_results.of(row) for row in rows]
        absent = self._query(
            "SELECT id, name, email, note FROM students WHERE number NOT IN (SELECT student FROM handed_in) "
            "ORDER BY name_order(id), name_order(name), email"
        )
        several = self._query(
            "SELECT id, name, email, note FROM students WHERE number IN "
            "(SELECT student FROM handed_in GROUP BY student HAVING count(*) > 1) "
            "ORDER BY name_order(id), name_order(name), email"
        )
        finals = [one.final for one in submissions if one.status == "graded" and one.final is not None]
        return ClassResults(
            schema="raysteps/class/v1",
            course=current_results.course,
            run=self._run(self._last),
            runs=[self._run(row) for row in current_results.all_runs],
            steps=current_results.steps,
            late_policy=self._last["late_policy"] or None,
            submissions=submissions,
            students_without_submission=[NotedStudent(**row) for row in absent],
            students_with_several=[NotedStudent(**row) for row in several],
            submissions_without_student=[
                one.name for one in submissions if current_results.has_roster and not one.students
            ],
            not_graded=[one.name for one in submissions if one.status == "not-graded"],
            faults=[one.name for one in submissions if one.status == "fault"],
            unreadable=[one.name for one in submissions if one.status == "unreadable"],
            changed=[
                PointsChange(one.name, one.before.points, one.automatic_points, one.before.resubmitted)
                for one in submissions
                if one.before is not None and one.before.points != one.automatic_points
            ],
            outdated=[one.name for one in submissions if one.outdated],
            mistakes=_count_mistakes(submissions),
            gone=self._names("gone"),
            ignored=json.loads(self._last["ignored"]),
            unknown_extensions=self._unknown_extensions(submissions),
            statistics=ClassStatistics(
                len(finals),
                round(statistics.fmean(finals), 2) if finals else None,
                round(statistics.median(finals), 2) if finals else None,
            ),
        )


def hand_in(one: GradedSubmission) -> HandIn:
    """What a report says of a submission beside its steps, by the roster and the late policy of the last run."""
    names = [student.name or student.id or student.email for student in one.students]
    return HandIn(names, one.submitted_at, one.submitted_from == "files", one.late)


def class_document(
    database: ClassDatabase, known: Mapping[str, GradedSubmission] = MappingProxyType({})
) -> ClassResults:
    """Checked: what is not of its form is the kit's fault. `known` are those that need not be made anew, by name."""
    return checked(_Report(database, known).document(), "class.json")


def submissions_if_current(database: ClassDatabase, path: Path, run: int) -> dict[str, GradedSubmission]:
    """Of a class.json that the last run and what was said until then are in: the submissions, by name. Nothing where
    it is older, or of a run that was broken off."""
    try:
        document = read_class_document(path)
    except UsageError:
        return {}
    last = database.connection.execute("SELECT number, state FROM runs ORDER BY number DESC LIMIT 1").fetchone()
    is_new = (document.run.number, document.run.state) == (last["number"], last["state"]) == (run, "complete")
    return {one.name: one for one in document.submissions} if is_new else {}


def read_class_document(path: Path) -> ClassResults:
    """The class.json of a graded class."""
    try:
        return parse(path.read_bytes(), ClassResults, complete=True)
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {reason(error)}") from error
    except Malformed as error:
        raise UsageError(f"{path}: is not a class.json of this kit: {error}") from error
