"""What a run is to do, worked out before anything is built or graded."""

import json
import os
import uuid
from collections import defaultdict
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path

from raysteps.classroom.database import (
    FILE,
    LOCK,
    SUBMISSIONS,
    ClassDatabase,
    RegisteredEntry,
    RunFacts,
    Scope,
    StudentEntries,
    refuse_results,
)
from raysteps.classroom.entries import ClassEntry, Listing, Shard, list_entries, name_entries, newest_time
from raysteps.classroom.jobs import KIT_GRADER
from raysteps.classroom.late_policy import late_policy_text, parse_late_policy
from raysteps.classroom.roster import Matches, Student, match, read_roster
from raysteps.common.documents import Amount
from raysteps.common.errors import UsageError, reason
from raysteps.common.platform import kit_command
from raysteps.common.text import count, join_some
from raysteps.course.manifest import Step, chosen_steps, read_steps
from raysteps.course.project import Project
from raysteps.course.settings import Course
from raysteps.results.model import Feedback, Settings
from raysteps.submission.load import is_submission, like

# What was asked for.


@dataclass(frozen=True)
class ClassOptions:
    """What was asked for on the command line."""

    folder: Path
    out: Path
    roster: Path | None = None
    jobs: int = 1
    resume: bool = False
    only: tuple[str, ...] = ()
    late_policy: Path | None = None
    seed: int = 1
    feedback: Feedback = "full"
    limits: dict[str, Amount] = field(default_factory=dict)
    require_sandbox: bool = False
    scheduler: str = ""
    shard: Shard = field(default_factory=Shard)
    grader: str = KIT_GRADER
    no_roster: bool = False  # nor that of the last run
    no_late_policy: bool = False
    course: Course = field(default_factory=Course)


# The folders and files that a class is graded from, and into.


def _inside(path: Path, folder: Path) -> bool:
    return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def check_places(folder: Path, out: Path, *, resume: bool) -> None:
    """Results must not come to lie among the submissions."""
    if not folder.is_dir():
        found, meant = ("is no folder", "") if folder.exists() else ("is not there", like(folder))
        raise UsageError(f"{folder}: {found}; expected a folder with one entry per submission{meant}")
    refuse_results(folder)
    if _inside(out, folder):
        raise UsageError(f"--out {out}: lies in the folder of the submissions; name another folder")
    if _inside(folder, out / SUBMISSIONS):
        raise UsageError(f"--out {out}: its results would go into the folder of the submissions")
    # A run that was ended while the kit was built has left nothing but its lock.
    others = [path for path in out.iterdir() if path.name != LOCK] if out.is_dir() else []
    if resume and others and not (out / FILE).is_file():
        raise UsageError(f"--resume: {out} holds no {FILE} to go on from")


def _read_late_policy(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        expected = "expected a TOML file with a deadline and percent_per_day"
        raise UsageError(f"{path}: the late policy cannot be read: {reason(error)}; {expected}{like(path)}") from error


# What the last run was given beside the submissions: a run that does not name it anew uses it again.

_NOBODY = Student(0, "", "", "")


@dataclass
class RunInputs:
    """`files` are no submissions, wherever they lie; `said` tells what comes from the last run."""

    students: list[Student] = field(default_factory=list)
    late_policy: str = ""  # the text of the file
    files: list[Path] = field(default_factory=list)
    said: list[str] = field(default_factory=list)


def roster_text(students: Sequence[Student]) -> str:
    """As the database keeps it."""
    return json.dumps([vars(student) for student in students], ensure_ascii=False)


@dataclass
class _Last(RunInputs):
    is_lost: bool = False  # a version of the kit that did not keep everything wrote the database


def _last(out: Path) -> _Last:
    """What the database knows; nothing where no run has begun yet."""
    if not (out / FILE).is_file():
        return _Last()
    with closing(ClassDatabase(out)) as database:
        run = database.connection.execute(
            "SELECT late_policy, given.roster, given.files, EXISTS (SELECT 1 FROM students) AS had_roster "
            "FROM runs LEFT JOIN given USING (uid) ORDER BY number DESC LIMIT 1"
        ).fetchone()
    if run is None:
        return _Last()
    if run["roster"] is None:
        return _Last([_NOBODY] if run["had_roster"] else [], run["late_policy"], is_lost=True)
    students = [Student(**row) for row in json.loads(run["roster"])]
    return _Last(students, run["late_policy"], [Path(path) for path in json.loads(run["files"])])


def _used_again(last: _Last, out: Path, option: str, what: str) -> str:
    """The line that says so."""
    if last.is_lost:
        raise UsageError(
            f"{out}: the last run there had a {option[2:].replace('-', ' ')}, but an earlier version of the kit "
            f"did not keep all of it; give it again with {option} FILE, or drop it with {option} none"
        )
    return f"{what} of the last run in {out} is used again; {option} FILE takes another one, {option} none drops it"


def read_run_inputs(options: ClassOptions) -> RunInputs:
    """The roster and the late policy that were named, else those of the last run."""
    last = _last(options.out)
    given = RunInputs(files=[path for path in (options.roster, options.late_policy) if path is not None] + last.files)
    if options.late_policy is not None:
        given.late_policy = _read_late_policy(options.late_policy)
        parse_late_policy(given.late_policy, str(options.late_policy))
    elif options.course.late_table and not options.no_late_policy:
        parse_late_policy(options.course.text, str(options.course.path), ["late_policy"])
        given.late_policy = late_policy_text(options.course.late_table)
    elif last.late_policy and not options.no_late_policy:
        given.late_policy = last.late_policy
        given.said.append(_used_again(last, options.out, "--late-policy", "the late policy"))
    if options.roster is not None:
        given.students = read_roster(options.roster, given.said.append)
    elif last.students and not options.no_roster:
        given.students = last.students
        what = f"the roster ({count(len(last.students), 'student')})"
        given.said.append(_used_again(last, options.out, "--roster", what))
    return given


_MAX_NAMED = 3


def _leads_to(entry: ClassEntry) -> str:
    others = join_some(entry.leads_to, _MAX_NAMED)
    return (
        f"{entry.label} leads to the same files as {others}. Put what was handed in in place of the link; "
        'for a team, name one submission for all in the roster\'s column "submission" and delete the link.'
    )


@dataclass(frozen=True)
class Plan:
    """All that a run is to do; `listing` has the entries of other shards, too."""

    options: ClassOptions
    steps: list[Step]
    chosen: list[Step]
    listing: Listing
    given: RunInputs
    matches: Matches
    uid: str = field(default_factory=lambda: uuid.uuid4().hex)

    @property
    def students(self) -> list[Student]:
        return self.given.students

    @property
    def late_policy(self) -> str:
        return self.given.late_policy

    @property
    def grading(self) -> Settings:
        """Beside the kit and the submission, all that a grade depends on. The database keeps everything that is known;
        what a student is not to see is left out when results.json is made from it."""
        only = tuple(step.id for step in self.chosen) if self.chosen != self.steps else ()
        return Settings("full", self.options.limits, only, self.options.seed)

    @property
    def settings(self) -> Settings:
        """As the instructor gave them."""
        return replace(self.grading, feedback=self.options.feedback)

    def facts(self, kit: str) -> RunFacts:
        columns = [
            {"id": step.id, "title": step.title, "points": step.points, "bonus": step.bonus} for step in self.chosen
        ]
        folder = str(self.options.folder.resolve()).encode("utf-8", "backslashreplace").decode()
        files = dict.fromkeys(os.path.realpath(path) for path in self.given.files)  # each once
        return RunFacts(
            uid=self.uid,
            kit=kit,
            folder=folder,
            shard=str(self.options.shard),
            settings=self.settings,
            steps=columns,
            late_policy=self.late_policy,
            ignored=self.listing.ignored,
            roster=roster_text(self.students),
            files=[file.encode("utf-8", "backslashreplace").decode() for file in files],
            course=self.options.course.name,
        )

    def registered(self, known: dict[str, str]) -> list[RegisteredEntry]:
        """All entries, also those of other shards, so that merging shards shows what is missing."""
        names = name_entries([entry.label for entry in self.listing.entries], known)
        times = self._times()
        rows = []
        for at, entry in enumerate(self.listing.entries):
            said = times.get(at, [])
            when = said[-1][0] if said else newest_time(entry.path)
            source = "roster" if said else "files" if when else ""
            scope: Scope = "here" if self.options.shard.holds(entry.label) else "elsewhere"
            note = self.matches.entry_notes.get(at, "")
            if len(said) > 1:
                times_said = ", ".join(time for _, time in said)
                note = f"Its students have different times in the roster ({times_said}); the latest counts."
            if entry.leads_to:
                note = " ".join(filter(None, (_leads_to(entry), note)))
            rows.append(RegisteredEntry(entry.label, names[entry.label], scope, when, source, note))
        return rows

    def _times(self) -> dict[int, list[tuple[str, str]]]:
        """What the roster says of when an entry was handed in, and that with a zone: of a team perhaps several times,
        the latest last."""
        zone = parse_late_policy(self.late_policy, "").deadline.tzinfo if self.late_policy else UTC

        def moment(text: str) -> datetime:
            when = datetime.fromisoformat(text)
            return when if when.tzinfo is not None else when.replace(tzinfo=zone)

        times: dict[int, dict[datetime, str]] = defaultdict(dict)
        for at, number in self.matches.pairs:
            text = self.students[number].submitted_at
            if text:
                times[at][moment(text)] = text
        return {at: [(said[when], when.isoformat()) for when in sorted(said)] for at, said in times.items()}

    def registrations(self) -> list[StudentEntries]:
        entries: dict[int, list[str]] = defaultdict(list)
        for at, number in self.matches.pairs:
            entries[number].append(self.listing.entries[at].label)
        rows = []
        for number, student in enumerate(self.students):
            note = self.matches.student_notes.get(number, "")
            if len(entries[number]) > 1:
                note = f"Handed in more than once: {', '.join(entries[number])}. Say which one counts in the roster."
            rows.append(StudentEntries(student.id, student.name, student.email, tuple(entries[number]), note))
        return rows

    def mine(self) -> list[ClassEntry]:
        return [entry for entry in self.listing.entries if self.options.shard.holds(entry.label)]


def make_plan(project: Project, options: ClassOptions, given: RunInputs | None = None) -> Plan:
    """Everything that can be wrong with the inputs is found here. `given`: what was read already."""
    check_places(options.folder, options.out, resume=options.resume)
    steps = read_steps(project)
    if is_submission(options.folder, steps):
        one = kit_command("grade", options.folder)
        raise UsageError(f"{options.folder}: is one submission. Grade it with `{one}`, or name the folder around it")
    chosen = chosen_steps(project, options.only)
    given = read_run_inputs(options) if given is None else given
    listing = list_entries(options.folder, given.files)
    matches = match([entry.label for entry in listing.entries], given.students)
    return Plan(options, steps, chosen, listing, given, matches)
