"""The command `grade-class`."""

import argparse
import shlex
from collections.abc import Collection, Iterator
from contextlib import closing, contextmanager
from decimal import Decimal
from pathlib import Path

from rich.console import Console

from raysteps.classroom.class_files import withdraw_tables, write_class
from raysteps.classroom.cluster import Cluster
from raysteps.classroom.database import FILE, LOCK, ClassDatabase, explained_sqlite_errors
from raysteps.classroom.entries import Shard, read_shard
from raysteps.classroom.jobs import KIT_GRADER, Grader, make_grader
from raysteps.classroom.local_pool import LocalPool
from raysteps.classroom.merge import merge
from raysteps.classroom.run_plan import ClassOptions, Plan, make_plan
from raysteps.classroom.session import Runner, Session, terminated_as_interrupted
from raysteps.classroom.summary import ProgressMeter, print_summary
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import try_lock, usable_folder, wait_for_lock
from raysteps.common.platform import processor_count, refuse_on_windows
from raysteps.common.text import print_plain
from raysteps.course.manifest import STEPS_HELP
from raysteps.course.project import Project
from raysteps.course.settings import Course, read_course
from raysteps.results.class_model import ClassResults
from raysteps.results.model import Feedback
from raysteps.toolchain.limits import LIMIT_HELP, parse_limits

# The words after `grade-class`.

_NO_COURSE = Course()
_NONE = "none"  # instead of a file: without one, also where the last run had one


def add_grading_arguments(parser: argparse.ArgumentParser, feedback: Feedback) -> None:
    """How each submission is graded, and whose it is: `nightly` takes these, too. `feedback` is the usual amount."""
    add = parser.add_argument
    add("--roster", metavar="CSV", help="the students: id, name, email, submission, submitted_at; or `none`")
    add("--jobs", type=int, metavar="N", help="submissions at a time (as many as there are processors)")
    add("--only", "--steps", nargs="+", default=[], metavar="STEP", help=f"grade these steps only, {STEPS_HELP}")
    add(
        "--late-policy",
        metavar="TOML",
        help="deadline, grace, percent per day, extensions; or `none`",
    )
    add("--seed", type=int, metavar="N", help="of the hidden cases (that of course.toml, else 1)")
    add(
        "--feedback",
        choices=["full", "diagnosis", "score"],
        default=feedback,
        help=f"how much results.json tells ({feedback})",
    )
    add("--limit", action="append", default=[], metavar="NAME=VALUE", help=LIMIT_HELP)
    add("--require-sandbox", action="store_true", help="refuse to grade without a strong sandbox")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What may follow `grade-class`."""
    add = parser.add_argument
    add("folder", nargs="?", type=Path, metavar="DIR", help="one folder, zip or tar per submission")
    add("--out", type=Path, required=True, metavar="OUT", help="where class.sqlite, results.csv and the rest go")
    add("--resume", action="store_true", help="grade only what is new or has changed, and what had a fault")
    add_grading_arguments(parser, "full")
    add("--scheduler", default="", metavar="ADDRESS", help="grade on a Dask cluster, such as tcp://head:8786")
    add("--shard", default="1/1", metavar="i/n", help="grade only the i-th of n parts of the class")
    add(
        "--merge", nargs="+", type=Path, default=[], metavar="OUT", help="bring the results of shards together in --out"
    )


def refuse_beside_merge(arguments: argparse.Namespace) -> None:
    """All other options say how to grade; to ignore them without a word would be worse."""
    if arguments.folder is not None:
        raise UsageError("--merge brings together what is graded already; leave DIR out")
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    for name, value in vars(arguments).items():
        option = f"--{name.replace('_', '-')}"
        if name not in ("merge", "out") and option in parser.format_help() and value != parser.get_default(name):
            raise UsageError(f"--merge brings together what is graded already; {option} is for the shards")


def _file(word: str | None) -> Path | None:
    return None if word is None or word == _NONE else Path(word)


def read_options(arguments: argparse.Namespace, grader: str, course: Course = _NO_COURSE) -> ClassOptions:
    """What is not said is as course.toml says."""
    if arguments.folder is None:
        raise UsageError("grade-class: expected a folder of submissions, DIR, in front of --out (or --merge)")
    if arguments.jobs is not None and arguments.scheduler:
        raise UsageError("--jobs is for this machine; with --scheduler the workers say how much they do at a time")
    jobs = arguments.jobs
    if jobs is None:
        jobs = processor_count()
    if not 1 <= jobs <= 1024:
        raise UsageError(f"--jobs {jobs}: expected a number from 1 to 1024")
    return ClassOptions(
        arguments.folder,
        arguments.out,
        _file(arguments.roster),
        jobs,
        arguments.resume,
        tuple(arguments.only),
        course.late_policy if arguments.late_policy is None else _file(arguments.late_policy),
        course.seed_or(arguments.seed),
        arguments.feedback,
        parse_limits(arguments.limit),
        arguments.require_sandbox,
        arguments.scheduler,
        read_shard(arguments.shard),
        grader,
        no_roster=arguments.roster == _NONE,
        no_late_policy=arguments.late_policy == _NONE,
        course=course,
    )


def _plain(value: float) -> str:
    """All digits, and no exponent: it must give the same number again."""
    return format(Decimal(repr(value)), "f").removesuffix(".0")


def resume_command(options: ClassOptions) -> str:
    """The line that goes on with the same run."""
    words: list[str] = ["./raysteps", "grade-class", str(options.folder), "--out", str(options.out)]
    for option, path, dropped in (
        ("--roster", options.roster, options.no_roster),
        ("--late-policy", options.late_policy, options.no_late_policy),
    ):
        named = f"./{path}" if str(path) == _NONE else str(path)
        words += [option, named] if path is not None else [option, _NONE] if dropped else []
    if options.scheduler:
        words += ["--scheduler", options.scheduler]
    else:
        words += ["--jobs", str(options.jobs)]
    if options.seed != options.course.seed_or(None):  # else it is taken anyway
        words += ["--seed", str(options.seed)]
    if options.feedback != "full":
        words += ["--feedback", options.feedback]
    for name, value in options.limits.items():
        words += ["--limit", f"{name}={_plain(value)}"]
    words += ["--require-sandbox"] if options.require_sandbox else []
    words += ["--shard", str(options.shard)] if options.shard != Shard() else []
    words += ["--only", *options.only] if options.only else []
    return shlex.join([*words, "--resume"])


@contextmanager
def class_lock(out: Path) -> Iterator[None]:
    """Two runs into one folder would take each other's results for changes."""
    usable_folder(out)
    with (out / LOCK).open("a") as file:
        try:
            is_ours = try_lock(file.fileno())
            if not is_ours and try_lock(file.fileno(), shared=True):  # only a desk writes, which soon is done
                wait_for_lock(file.fileno())
                is_ours = True
        except OSError:
            is_ours = True  # a file system without locks
        if not is_ours:
            raise UsageError(
                f"{out}: another grade-class or a look of `nightly` is writing there, or `export mail` sends from "
                "there; wait for it, or name another --out"
            )
        yield


def _finish(console: Console, database: ClassDatabase, out: Path, done: Collection[str] = ()) -> ClassResults:
    document = write_class(database, out, done)
    print_summary(console, document, out)
    return document


def _runner(plan: Plan, kit: str, meter: ProgressMeter) -> Runner:
    options = plan.options
    if not options.scheduler:
        return LocalPool(options.jobs)
    sandbox = options.require_sandbox
    return Cluster(options.scheduler, plan.uid, kit, options.grader, require_sandbox=sandbox, say=meter.say)


def _prepare(plan: Plan, meter: ProgressMeter) -> Grader:
    """The kit of this machine: its fingerprint is what every result is held against."""
    options = plan.options
    sandbox = options.require_sandbox and not options.scheduler
    grader = make_grader(options.grader, require_sandbox=sandbox, say=meter.say)
    if not options.scheduler:
        meter.say(grader.isolation.description)
    return grader


def _again(options: ClassOptions) -> str:
    return f"To go on:\n  {resume_command(options)}"


def _interrupted(console: Console, again: str) -> int:
    print_plain(console, f"Interrupted. {again}")
    return 130


def _grade(console: Console, plan: Plan, grader: Grader, meter: ProgressMeter) -> int:
    options = plan.options
    again = _again(options)
    runner = _runner(plan, grader.fingerprint, meter)
    with explained_sqlite_errors(options.out / FILE, "used"), closing(ClassDatabase(options.out)) as database:
        registered = plan.registered(database.names())
        run = database.begin_run(plan.facts(grader.fingerprint), registered, plan.registrations())
        names = {row.entry: row.name for row in registered}

        def learn() -> None:
            if not options.scheduler:  # else the workers do
                grader.learn([step.id for step in plan.chosen], meter.say)

        session = Session(plan, grader.fingerprint, database, meter, run, names, learn)
        try:
            with meter:
                complete = session.grade(runner)
        except GraderFault as fault:
            if session.recorded:
                _finish(console, database, options.out, session.recorded)
            raise GraderFault(f"{fault}\n{again}") from fault
        document = _finish(console, database, options.out, session.recorded)
    if not complete:
        return _interrupted(console, again)
    return GraderFault.exit_code if document.faults else 0


def _merge(console: Console, folders: list[Path], out: Path) -> int:
    with class_lock(out), explained_sqlite_errors(out / FILE, "used"), closing(ClassDatabase(out)) as database:
        missing, warnings = merge(folders, database)
        withdraw_tables(out)
        document = _finish(console, database, out)
    for warning in warnings:
        print_plain(console, f"Warning: {warning}")
    if missing:
        console.print(f"Missing: {', '.join(missing)} of the shards", markup=False)
    return GraderFault.exit_code if missing or document.faults or document.not_graded else 0


def run(project: Project, arguments: argparse.Namespace, console: Console, *, grader: str = KIT_GRADER) -> int:
    """0 when all were graded, whatever their points; 4 when the grader failed with one, or when a merge leaves some
    that are not graded yet; 130 when interrupted."""
    refuse_on_windows("grade-class")
    if arguments.merge:
        refuse_beside_merge(arguments)
        return _merge(console, arguments.merge, arguments.out)
    plan = make_plan(project, read_options(arguments, grader, read_course(project)))
    with class_lock(plan.options.out):
        meter = ProgressMeter(console, len(plan.mine()), plan.options.jobs)
        for words in plan.given.said:
            meter.say(words)
        try:
            with terminated_as_interrupted():
                made = _prepare(plan, meter)
        except KeyboardInterrupt:
            return _interrupted(console, _again(plan.options))
        return _grade(console, plan, made, meter)
