"""The command `nightly`: grades what has come in, and gives feedback at most a few times a day."""

import argparse
import re
import time
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, field
from datetime import UTC, datetime, tzinfo
from functools import partial
from pathlib import Path
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from rich.console import Console

from raysteps.classroom.annotations import is_unwritten
from raysteps.classroom.class_files import withdraw_tables, write_class
from raysteps.classroom.database import CLASS_JSON, FILE, ClassDatabase, explained_sqlite_errors
from raysteps.classroom.entries import NoSubmission
from raysteps.classroom.jobs import KIT_GRADER, Grader, make_grader
from raysteps.classroom.late_policy import parse_late_policy
from raysteps.classroom.local_pool import LocalPool
from raysteps.classroom.nightly import Allowance, EntryDecision, NightlyRound, shown, signatures
from raysteps.classroom.repositories import Remotes, fetch_all
from raysteps.classroom.run_plan import ClassOptions, Plan, make_plan, read_run_inputs
from raysteps.classroom.session import Session, terminated_as_interrupted
from raysteps.classroom.summary import ProgressMeter
from raysteps.cli import whole_number
from raysteps.cli.grade_class import add_grading_arguments, class_lock, read_options
from raysteps.common.errors import GraderFault, RaystepsError, UsageError, reason_and_place
from raysteps.common.files import usable_folder
from raysteps.common.platform import refuse_on_windows
from raysteps.common.text import count, name_order, print_plain
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.course.settings import read_course

# The words after `nightly`.

_UNITS = {"s": 1, "m": 60, "h": 3600}


def _span(text: str) -> float:
    found = re.fullmatch(r"([0-9]{1,5})([smh])", text)
    if found is None:
        raise argparse.ArgumentTypeError(f"'{text}': expected a time such as 30s, 10m or 1h")
    return float(int(found[1]) * _UNITS[found[2]])


def _zone(text: str) -> tzinfo:
    try:
        return ZoneInfo(text)
    except (ZoneInfoNotFoundError, ValueError, OSError) as error:
        raise argparse.ArgumentTypeError(f"'{text}': expected a time zone such as Europe/Berlin") from error


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What may follow `nightly`."""
    add = parser.add_argument
    add("folder", nargs="?", type=Path, metavar="DIR", help="one folder, zip or tar per student; or --git")
    add("--out", type=Path, required=True, metavar="OUT", help="the class, as of grade-class; for you alone")
    add("--give", type=Path, metavar="DIR", help="where each student's report.html goes (OUT/feedback)")
    per_day = partial(whole_number, 1, 999)
    add("--per-day", type=per_day, default=2, metavar="N", help="feedbacks a day for each student (2)")
    add("--zone", type=_zone, metavar="NAME", help="whose days count (that of the deadline, else UTC)")
    when = parser.add_mutually_exclusive_group()
    when.add_argument("--every", type=_span, default=600.0, metavar="TIME", help="look so often, until Ctrl-C (10m)")
    when.add_argument("--once", action="store_true", help="look once and end: for cron or a timer")
    add("--settle", type=_span, default=10.0, metavar="TIME", help="what changes within that time is not ready (10s)")
    add("--git", action="store_true", help="fetch what the column `repository` of the roster names")
    add("--branch", default="", metavar="NAME", help="with --git: of this branch, not of the main one")
    add("--local", type=Path, metavar="DIR", help="with --git: the column may name repositories in this folder")
    add_grading_arguments(parser, "diagnosis")
    parser.set_defaults(resume=True, scheduler="", shard="1/1")


# One look after the other.

Clock = Callable[[], datetime]


def _now() -> datetime:
    return datetime.now(UTC)


@dataclass
class _Night:
    """What stays the same from one look to the next."""

    project: Project
    console: Console
    options: ClassOptions
    give: Path
    per_day: int
    zone: tzinfo | None
    settle: float
    remotes: Remotes | None
    clock: Clock
    wait: Callable[[float], None]
    _said: set[str] = field(default_factory=set)
    _line: str = ""

    def _say_once(self, text: str) -> None:
        if text not in self._said:
            self._said.add(text)
            self._print(text)

    def _print(self, text: str) -> None:
        print_plain(self.console, text)

    def round(self) -> int:
        """0; 4 when the grader failed with some, 130 when it was interrupted."""
        out = self.options.out
        with class_lock(out), explained_sqlite_errors(out / FILE, "used"), closing(ClassDatabase(out)) as database:
            try:
                plan = self._plan()
            except NoSubmission as nothing:
                self._say_once(str(nothing))
                return 0
            before = signatures(plan.mine())
            self.wait(self.settle)
            grader = make_grader(self.options.grader, require_sandbox=self.options.require_sandbox, say=self._say_once)
            self._say_once(grader.isolation.description)
            return self._grade(plan, grader, database, before)

    def _plan(self) -> Plan:
        given = read_run_inputs(self.options)
        for words in given.said:
            self._say_once(words)
        if self.remotes is not None:
            names = {name for step in read_steps(self.project) for name in step.files}
            given.students = fetch_all(self.remotes, given.students, names, self._print)
        return make_plan(self.project, self.options, given)

    def _zone_of(self, plan: Plan) -> tzinfo:
        if self.zone is not None:
            return self.zone
        deadline = parse_late_policy(plan.late_policy, "").deadline if plan.late_policy else None
        return (deadline.tzinfo if deadline is not None else None) or UTC

    def _grade(self, plan: Plan, grader: Grader, database: ClassDatabase, before: dict[str, str]) -> int:
        registered = plan.registered(database.names())
        names = {row.entry: row.name for row in registered}
        allowance = Allowance(self.per_day, self._zone_of(plan))
        nightly_round = NightlyRound(
            plan=plan,
            kit=grader.fingerprint,
            database=database,
            names=names,
            allowance=allowance,
            now=self.clock(),
            before=before,
            folder=self.give,
            feedback=self.options.feedback,
            say=self._print,
        )
        for one in nightly_round.decisions:
            if one.state == "give":
                nightly_round.give(one)
        due = [one for one in nightly_round.decisions if one.state == "grade"]
        complete, failed = True, [one.name for one in nightly_round.decisions if one.state == "failed"]
        if due or _is_unfinished(database, self.options.out):
            run = database.begin_run(
                plan.facts(grader.fingerprint), registered, plan.registrations(), nightly_round.left_out
            )
            meter = ProgressMeter(self.console, len(due), self.options.jobs)
            session = Session(
                plan=plan,
                kit=grader.fingerprint,
                database=database,
                meter=meter,
                run=run,
                names=names,
                learn=lambda: grader.learn([step.id for step in plan.chosen], meter.say),
                entries=[one.entry for one in due],
                is_whole=nightly_round.is_settled,
                told=nightly_round.told,
            )
            with meter:
                complete = session.grade(LocalPool(self.options.jobs))
            skipped = {one.name for one in due} - session.recorded - set(session.reused)
            database.leave_out(nightly_round.left_out | skipped, skipped)
            failed = write_class(database, self.options.out, session.recorded).faults
        else:
            self._write_what_changed(nightly_round, database)
        nightly_round.tell_again()
        nightly_round.write_statuses()
        self._tell(nightly_round, allowance, failed)
        return 130 if not complete else GraderFault.exit_code if failed else 0

    def _write_what_changed(self, nightly_round: NightlyRound, database: ClassDatabase) -> None:
        """After a look that graded nothing: who waits now, and what was said at a desk that could not write it."""
        is_new = nightly_round.left_out != database.left_out()
        if is_new:
            withdraw_tables(self.options.out)  # whoever is killed in between writes them anew
            database.leave_out(nightly_round.left_out)
        if is_new or is_unwritten(database.connection):
            write_class(database, self.options.out, database.names().values())

    def _tell(self, nightly_round: NightlyRound, allowance: Allowance, failed: list[str]) -> None:
        """One line for each look that found something else than the one before."""
        parts = [f"{count(len(nightly_round.given), 'feedback')} given"]
        later = shown(allowance.next_day(nightly_round.now))
        for what, names in (
            (f"waiting until {later}", _named(nightly_round.decisions, "waiting")),
            ("still being uploaded", _named(nightly_round.decisions, "changing")),
            ("of nobody on the roster", _named(nightly_round.decisions, "nobody")),
            ("the grader failed", failed),
            ("with new comments or points", sorted(nightly_round.told_again, key=name_order)),
        ):
            parts += [f"{what}: {', '.join(names)}"] if names else []
        line = "; ".join(parts)
        if nightly_round.given or nightly_round.told_again or line != self._line:
            self._print(f"{shown(nightly_round.now.astimezone(allowance.zone))}  {line}")
        self._line = line


def _named(decisions: list[EntryDecision], state: str) -> list[str]:
    return sorted((decision.name for decision in decisions if decision.state == state), key=name_order)


def _is_unfinished(database: ClassDatabase, out: Path) -> bool:
    """Whether the last run was killed before it wrote its tables."""
    run = database.connection.execute("SELECT state FROM runs ORDER BY number DESC LIMIT 1").fetchone()
    return run is not None and (run["state"] == "running" or not (out / CLASS_JSON).is_file())


def _night(
    project: Project,
    arguments: argparse.Namespace,
    console: Console,
    grader: str,
    clock: Clock,
    wait: Callable[[float], None],
) -> _Night:
    remotes = None
    if arguments.git:
        if arguments.folder is not None:
            raise UsageError("--git grades what the roster names; leave DIR out")
        if arguments.branch.startswith("-") or not re.fullmatch(r"[A-Za-z0-9._/-]*", arguments.branch):
            raise UsageError(f"--branch {arguments.branch!r}: expected the name of a branch, such as main")
        remotes = Remotes(arguments.out / "repositories", arguments.branch, arguments.local)
        arguments.folder = remotes.entries
    elif arguments.branch or arguments.local is not None:
        raise UsageError("--branch and --local are for --git")
    elif arguments.folder is None:
        raise UsageError("expected a folder of submissions, or --git with a roster that names repositories")
    options = read_options(arguments, grader, read_course(project))
    give = arguments.give or arguments.out / "feedback"
    if give.resolve().is_relative_to(options.folder.resolve()):
        raise UsageError(f"--give {give}: lies in the folder of the submissions; name another folder")
    usable_folder(give)
    return _Night(
        project=project,
        console=console,
        options=options,
        give=give,
        per_day=arguments.per_day,
        zone=arguments.zone,
        settle=arguments.settle,
        remotes=remotes,
        clock=clock,
        wait=wait,
    )


def run(
    project: Project,
    arguments: argparse.Namespace,
    console: Console,
    *,
    grader: str = KIT_GRADER,
    clock: Clock = _now,
    wait: Callable[[float], None] = time.sleep,
) -> int:
    """Of one look its exit code; of many 0, when they were ended while there was nothing to do."""
    refuse_on_windows("nightly")
    night = _night(project, arguments, console, grader, clock, wait)
    with terminated_as_interrupted():
        code = night.round()
        while not arguments.once and code != 130:
            try:
                wait(arguments.every)
            except KeyboardInterrupt:
                return 0
            try:
                code = night.round()
            except RaystepsError as error:  # a roster that is being edited, a grade-class beside it: the next may do
                print_plain(console, f"raysteps: {error}")
            except OSError as error:  # a disk that is full, a share that is away
                told = f"raysteps: this look did not come to its end: {reason_and_place(error)}; the next one goes on"
                print_plain(console, told)
    return code
