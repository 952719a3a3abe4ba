"""Feedback while a course runs: what is graded now, how often a student gets feedback, and where it is put."""

import hashlib
import os
import tempfile
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime, time, timedelta, tzinfo
from functools import cached_property
from pathlib import Path
from typing import Literal

from raysteps.classroom.annotations import annotated, last_said
from raysteps.classroom.class_document import CurrentResults, steps_of
from raysteps.classroom.class_files import write_submission
from raysteps.classroom.database import SUBMISSIONS, ClassDatabase, insert, stamp, transaction
from raysteps.classroom.entries import MAX_FILES, ClassEntry, folded, load_entry
from raysteps.classroom.jobs import JobResult
from raysteps.classroom.resubmissions import sources_digest
from raysteps.classroom.run_plan import Plan
from raysteps.classroom.session import is_up_to_date, submission_key
from raysteps.common.errors import GraderFault
from raysteps.common.files import write_if_changed
from raysteps.results.model import Feedback
from raysteps.results.store import REPORT

STATUS = "status.txt"  # beside each page: what may be expected next

# How many feedbacks a day has, and when it begins.


def shown(moment: datetime) -> str:
    return moment.isoformat(sep=" ", timespec="minutes")


@dataclass(frozen=True)
class Allowance:
    """A day is that of the course, also where the clocks change in it."""

    per_day: int
    zone: tzinfo

    def _midnight(self, now: datetime, days: int) -> datetime:
        return datetime.combine(now.astimezone(self.zone).date() + timedelta(days), time(), self.zone)

    def day_began(self, now: datetime) -> datetime:
        return self._midnight(now, 0)

    def next_day(self, now: datetime) -> datetime:
        return self._midnight(now, 1)


# What was given, in the database of the class.

_A_DAY = timedelta(days=1)


@dataclass(frozen=True)
class LastFeedback:
    """The last feedback on a submission."""

    run: int
    work: str
    at: datetime
    said: str


class FeedbackLog:
    """Who was given what."""

    def __init__(self, database: ClassDatabase) -> None:
        self._connection = database.connection

    def last(self, name: str) -> LastFeedback | None:
        row = self._connection.execute(
            "SELECT run, work, given_at, said FROM feedback_given JOIN submissions ON submissions.id = submission "
            "WHERE name = ? ORDER BY run DESC LIMIT 1",
            (name,),
        ).fetchone()
        if row is None:
            return None
        return LastFeedback(row["run"], row["work"], datetime.fromisoformat(row["given_at"]), row["said"])

    def used(self, students: Collection[str], since: datetime) -> Counter[str]:
        """How many each has had. What a clock that was set back since has dated later counts as well."""
        rows = self._connection.execute(
            "SELECT student, sum(counts) AS amount FROM feedback_given WHERE given_at >= ? GROUP BY student",
            (stamp(since),),
        )
        return Counter({row["student"]: row["amount"] for row in rows if row["student"] in students})

    def add(self, decision: "EntryDecision", run: int, said: str, now: datetime) -> None:
        with transaction(self._connection):
            query = "SELECT id FROM submissions WHERE name = ?"
            (submission,) = self._connection.execute(query, (decision.name,)).fetchone()
            row = {"submission": submission, "run": run, "work": decision.work, "counts": decision.counts, "said": said}
            for student in decision.students:
                mine = {**row, "student": student, "given_at": stamp(now)}
                insert(self._connection, "feedback_given", mine, "ON CONFLICT DO NOTHING")

    def record_rewrite(self, name: str, run: int, said: str) -> None:
        """The page of that feedback was written again: it stays one feedback."""
        self._connection.execute(
            "UPDATE feedback_given SET said = ? WHERE run = ? AND submission = "
            "(SELECT id FROM submissions WHERE name = ?)",
            (said, run, name),
        )

    def correct_clock(self, now: datetime) -> None:
        """What is dated more than a day ahead, by a clock that was wrong, counts from now: else it would count for as
        long as the clock was ahead."""
        late = (stamp(now), stamp(now + _A_DAY))
        self._connection.execute("UPDATE feedback_given SET given_at = ? WHERE given_at > ?", late)


# Whether an entry is still being uploaded.


def signature(path: Path) -> str:
    """Changes with everything that is written into an entry; nothing where it is gone."""
    facts = _facts(path)
    if not facts:
        return ""
    digest = hashlib.sha256(repr(facts).encode())
    seen = 0
    for folder, folders, files in os.walk(path):
        folders.sort()
        for name in sorted(files) + folders:
            digest.update(f"{os.fsencode(os.path.join(folder, name))!r} {_facts(Path(folder, name))}".encode())  # noqa: PTH118
            seen += 1
        if seen > MAX_FILES:
            break
    return digest.hexdigest()


def _facts(path: Path) -> tuple[int, ...]:
    """Nothing where it cannot be looked at, such as in a folder that is closed."""
    try:
        found = path.lstat()
    except OSError:
        return ()
    return (found.st_mode, found.st_ino, found.st_size, found.st_mtime_ns, found.st_ctime_ns)


def signatures(entries: Sequence[ClassEntry]) -> dict[str, str]:
    return {entry.label: signature(entry.path) for entry in entries}


# What becomes of each entry in one round.

EntryState = Literal["grade", "give", "given", "waiting", "changing", "nobody", "failed"]
_MAX_FAULTS = 3  # of the grader with one state of a submission, on one day


@dataclass(frozen=True)
class EntryDecision:
    """What is to be done with an entry. `counts`: whether that takes one of the day's feedbacks."""

    entry: ClassEntry
    name: str
    state: EntryState
    students: tuple[str, ...] = ()
    work: str = ""
    counts: bool = False
    is_graded: bool = False  # as it is now, although it waits
    seconds: float = 0.0  # that it took the last time


@dataclass
class NightlyRound:
    """One look at the class, and what follows from it. `before` are the signatures of an earlier look."""

    plan: Plan
    kit: str
    database: ClassDatabase
    names: dict[str, str]
    allowance: Allowance
    now: datetime
    before: dict[str, str]
    folder: Path  # of what is given
    feedback: Feedback
    say: Callable[[str], None]
    given: list[str] = field(default_factory=list)
    told_again: list[str] = field(default_factory=list)
    _reserved: Counter[str] = field(default_factory=Counter)

    def __post_init__(self) -> None:
        self.log = FeedbackLog(self.database)
        self.log.correct_clock(self.now)

    @cached_property
    def _owners(self) -> dict[str, tuple[str, ...]]:
        """The students of an entry, by its label."""
        owners: dict[str, list[str]] = defaultdict(list)
        for at, number in self.plan.matches.pairs:
            student = self.plan.students[number]
            owners[self.plan.listing.entries[at].label].append(folded(student.id or student.email or student.name))
        return {label: tuple(dict.fromkeys(students)) for label, students in owners.items()}

    def is_settled(self, entry: ClassEntry) -> bool:
        """Whether nothing was written into it since the earlier look."""
        now = signature(entry.path)
        return now != "" and now == self.before.get(entry.label)

    @cached_property
    def decisions(self) -> list[EntryDecision]:
        """Those to be graded that took long the last time come last: nobody else waits for them."""
        return sorted(map(self._look, self.plan.mine()), key=lambda decision: decision.seconds)

    @cached_property
    def left_out(self) -> set[str]:
        """Names of those that have an earlier result than what is there now."""
        return {
            decision.name
            for decision in self.decisions
            if decision.state in ("waiting", "changing")
            and not decision.is_graded
            and self.database.current(decision.name) is not None
        }

    def _look(self, entry: ClassEntry) -> EntryDecision:
        name = self.names[entry.label]
        students = self._owners.get(entry.label, () if self.plan.students else (name,))
        if not students:
            return EntryDecision(entry, name, "nobody")
        if not self.is_settled(entry):
            return EntryDecision(entry, name, "changing", students)
        work = key = ""
        unreadable = False
        try:
            taken = load_entry(name, entry, self.plan.steps)
            key = submission_key(taken.submission, self.kit, self.plan.grading)
            work = sources_digest(taken.submission)
            unreadable = taken.unreadable
        except GraderFault:
            pass  # the session meets it again, and keeps it as a fault
        if not self.is_settled(entry):
            return EntryDecision(entry, name, "changing", students)
        return self._judged(entry, name, students, key, work, unreadable=unreadable)

    def _judged(
        self, entry: ClassEntry, name: str, students: tuple[str, ...], key: str, work: str, *, unreadable: bool
    ) -> EntryDecision:
        current, last = self.database.current(name), self.log.last(name)
        done = is_up_to_date(current, key, require_sandbox=self.plan.options.require_sandbox)
        seconds = current["seconds"] if current is not None else 0.0
        state: EntryState = "give" if done else "grade"
        if current is not None and done and last is not None and last.run == current["run"]:
            return EntryDecision(entry, name, "given", students, work)
        is_fault = current is not None and current["status"] == "fault"
        if is_fault and (done or self._faults(name, key) >= _MAX_FAULTS):
            return EntryDecision(entry, name, "failed", students, work)
        # What a student has not changed, or what told nothing, takes no feedback.
        counts = not unreadable and (last is None or last.work != work)
        if counts:
            had = self.log.used(students, self.allowance.day_began(self.now)) + self._reserved
            if any(had[student] >= self.allowance.per_day for student in students):
                return EntryDecision(entry, name, "waiting", students, work, is_graded=done)
            self._reserved.update(students)
        return EntryDecision(entry, name, state, students, work, counts, seconds=seconds)

    def _faults(self, name: str, key: str) -> int:
        since = self.allowance.day_began(self.now).astimezone(UTC).isoformat(timespec="seconds")
        (amount,) = self.database.connection.execute(
            "SELECT count(*) FROM results JOIN submissions ON submissions.id = submission "
            "WHERE name = ? AND key = ? AND status = 'fault' AND finished_at >= ?",
            (name, key, since),
        ).fetchone()
        return int(amount)

    def told(self, answer: JobResult) -> None:
        """A result is there: it is given at once."""
        decision = next(decision for decision in self.decisions if decision.name == answer.name)
        if answer.status == "graded" and decision.state == "grade":
            self.give(decision)

    def give(self, decision: EntryDecision) -> None:
        """The page is there before it counts: whoever is killed in between gives it again."""
        said = last_said(self.database, decision.name)
        run = self._write_page(decision.name)
        if run is None:
            self.say(f"{decision.name}: there is no page to give")
            return
        self.log.add(decision, run, said, self.now)
        self.given.append(decision.name)

    def tell_again(self) -> None:
        """What people said of a result since its page was given takes no feedback. A result that is not given yet
        stays untold."""
        for name in sorted(annotated(self.database) & {one.name for one in self.decisions if one.students}):
            current, last, said = self.database.current(name), self.log.last(name), last_said(self.database, name)
            if current is None or last is None or last.run != current["run"] or last.said == said:
                continue
            if self._write_page(name) is not None:
                self.log.record_rewrite(name, last.run, said)
                self.told_again.append(name)

    def _write_page(self, name: str) -> int | None:
        """As the result that counts is now, with all that people said of it. Gives its run."""
        current_results = CurrentResults(self.database)
        one = current_results.named(name)
        with tempfile.TemporaryDirectory(prefix="raysteps-class-") as place:
            steps = steps_of(current_results.steps)
            write_submission(self.database, Path(place), one, current_results.course, steps, self.feedback)
            page = Path(place) / SUBMISSIONS / name / REPORT
            if not page.is_file():
                return None
            write_if_changed(self.folder / name / REPORT, page.read_bytes())
        return one.run

    def write_statuses(self) -> None:
        """Beside each page what may be expected next."""
        for decision in self.decisions:
            if decision.students:
                write_if_changed(self.folder / decision.name / STATUS, self._words(decision).encode())

    def _words(self, decision: EntryDecision) -> str:
        last = self.log.last(decision.name)
        used = max(self.log.used(decision.students, self.allowance.day_began(self.now)).values(), default=0)
        most, later = self.allowance.per_day, shown(self.allowance.next_day(self.now))
        lines = []
        if last is not None:
            lines.append(f"{REPORT} tells of what was there on {shown(last.at.astimezone(self.allowance.zone))}.")
        lines.append(f"Feedback today: {used} of {most}.")
        current = self.database.current(decision.name)
        failed = decision.state == "failed" or (
            decision.state == "grade"
            and decision.name not in self.given
            and current is not None
            and current["status"] == "fault"
        )
        if decision.state == "waiting":
            lines.append(
                f"Something was changed since. It is graded from {later} on, as it is then: what lies between is not "
                "looked at."
            )
        elif decision.state == "changing":
            lines.append("Something is being uploaded. It is graded when it stays the same from one look to the next.")
        elif failed:
            lines.append(
                "The grader itself failed with what is there now. That takes no feedback and no points; your "
                "instructors see it."
            )
        elif used >= most:
            lines.append(f"The next feedback is possible from {later} on.")
        return "\n".join(lines) + "\n"
