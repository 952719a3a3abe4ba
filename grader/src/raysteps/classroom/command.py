"""The command `grade-class`."""

import argparse
import fcntl
import os
import shlex
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console

from raysteps.classroom.cluster import Cluster
from raysteps.classroom.database import ClassDatabase
from raysteps.classroom.entries import Shard, read_shard
from raysteps.classroom.files import write_class
from raysteps.classroom.graders import KIT_GRADER, Grader, make_grader
from raysteps.classroom.merge import merge
from raysteps.classroom.plan import Order, Plan, make_plan
from raysteps.classroom.pool import LocalPool
from raysteps.classroom.progress import Meter
from raysteps.classroom.report import class_document
from raysteps.classroom.session import Runner, Session
from raysteps.classroom.summary import print_summary
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import usable_folder
from raysteps.common.text import number
from raysteps.grading.limits import parse_limits
from raysteps.kit.project import Project


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What may follow `grade-class`."""
    add = parser.add_argument
    add("folder", nargs="?", type=Path, metavar="DIR", help="one folder, zip or tar per submission")
    add("--out", type=Path, required=True, metavar="OUT", help="where class.sqlite, results.csv and the rest go")
    add("--roster", type=Path, metavar="CSV", help="the students: id, name, email, submission, submitted_at")
    add("--jobs", type=int, metavar="N", help="submissions at a time (as many as there are processors)")
    add("--resume", action="store_true", help="grade only what is new or has changed, and what had a fault")
    add("--only", nargs="+", default=[], metavar="STEP", help="grade these steps only: 02, 2 or 02-intersection")
    add("--late-policy", type=Path, metavar="TOML", help="deadline, grace, percent per day, extensions")
    add("--seed", type=int, default=1, help="of the hidden cases (1)")
    add("--feedback", choices=["full", "diagnosis", "score"], default="full", help="how much results.json tells")
    add("--limit", action="append", default=[], metavar="NAME=VALUE", help="such as seconds=40")
    add("--require-sandbox", action="store_true", help="refuse to grade without a strong sandbox")
    add("--scheduler", default="", metavar="ADDRESS", help="grade on a Dask cluster, such as tcp://head:8786")
    add("--shard", default="1/1", metavar="i/n", help="grade only the i-th of n parts of the class")
    add(
        "--merge", nargs="+", type=Path, default=[], metavar="OUT", help="bring the results of shards together in --out"
    )


def _order(arguments: argparse.Namespace, grader: str) -> Order:
    if arguments.folder is None:
        raise UsageError("grade-class: expected a folder of submissions (or --merge)")
    if arguments.jobs is not None and arguments.scheduler:
        raise UsageError("--jobs is for this machine; with --scheduler the workers say how much they do at a time")
    jobs = arguments.jobs
    if jobs is None:
        jobs = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if not 1 <= jobs <= 1024:
        raise UsageError(f"--jobs {jobs}: expected a number from 1 to 1024")
    return Order(
        arguments.folder,
        arguments.out,
        arguments.roster,
        jobs,
        arguments.resume,
        tuple(arguments.only),
        arguments.late_policy,
        arguments.seed,
        arguments.feedback,
        parse_limits(arguments.limit),
        arguments.require_sandbox,
        arguments.scheduler,
        read_shard(arguments.shard),
        grader,
    )


def _again(order: Order) -> str:
    """The line that goes on with the same run."""
    words: list[str] = ["./raysteps", "grade-class", str(order.folder), "--out", str(order.out)]
    for option, value in (("--roster", order.roster), ("--late-policy", order.late_policy)):
        words += [option, str(value)] if value is not None else []
    if order.scheduler:
        words += ["--scheduler", order.scheduler]
    else:
        words += ["--jobs", str(order.jobs)]
    if order.seed != 1:
        words += ["--seed", str(order.seed)]
    if order.feedback != "full":
        words += ["--feedback", order.feedback]
    for name, value in order.limits.items():
        words += ["--limit", f"{name}={number(value)}"]
    words += ["--require-sandbox"] if order.require_sandbox else []
    words += ["--shard", str(order.shard)] if order.shard != Shard() else []
    words += ["--only", *order.only] if order.only else []
    return shlex.join([*words, "--resume"])


@contextmanager
def _only_one(out: Path) -> Iterator[None]:
    """Two runs into one folder would take each other's results for changes."""
    usable_folder(out)
    with (out / "class.lock").open("a") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise UsageError(
                f"{out}: another grade-class is writing there; wait for it, or name another --out"
            ) from error
        except OSError:
            pass  # a file system without locks
        yield


def _finish(console: Console, database: ClassDatabase, out: Path) -> dict[str, Any]:
    document = class_document(database)
    write_class(database, out, document)
    print_summary(console, document, out)
    return document


def _runner(plan: Plan, kit: str, meter: Meter) -> Runner:
    order = plan.order
    if not order.scheduler:
        return LocalPool(order.jobs)
    sandbox = order.require_sandbox
    return Cluster(order.scheduler, plan.uid, kit, order.grader, require_sandbox=sandbox, say=meter.say)


def _prepare(order: Order, meter: Meter) -> Grader:
    """The kit of this machine: its fingerprint is what every result is held against."""
    sandbox = order.require_sandbox and not order.scheduler
    grader = make_grader(order.grader, require_sandbox=sandbox, say=meter.say)
    if not order.scheduler:
        meter.say(grader.isolation.description)
    return grader


def _grade(console: Console, plan: Plan, grader: Grader, meter: Meter) -> int:
    order = plan.order
    again = f"To go on:\n  {_again(order)}"
    runner = _runner(plan, grader.fingerprint, meter)
    with closing(ClassDatabase(order.out)) as database:
        registered = plan.registered(database.names())
        run = database.begin_run(plan.facts(grader.fingerprint), registered, plan.registrations())
        names = {row.entry: row.name for row in registered}
        session = Session(plan, grader.fingerprint, database, meter, run, names)
        try:
            with meter:
                complete = session.grade(runner)
        except GraderFault as fault:
            if session.recorded:
                _finish(console, database, order.out)
            raise GraderFault(f"{fault}\n{again}") from fault
        document = _finish(console, database, order.out)
    if not complete:
        console.print(f"Interrupted. {again}", markup=False, highlight=False, soft_wrap=True)
        return 130
    return GraderFault.exit_code if document["faults"] else 0


def _merge(console: Console, folders: list[Path], out: Path) -> int:
    with _only_one(out), closing(ClassDatabase(out)) as database:
        missing = merge(folders, database)
        document = _finish(console, database, out)
    if missing:
        console.print(f"Missing: {', '.join(missing)} of the shards", markup=False)
    return GraderFault.exit_code if missing or document["faults"] or document["not_graded"] else 0


def run(project: Project, arguments: argparse.Namespace, console: Console, *, grader: str = KIT_GRADER) -> int:
    """0 when all were graded, whatever their points; 4 when the grader failed with one; 130 when interrupted."""
    if arguments.merge:
        if arguments.folder is not None:
            raise UsageError("--merge brings together what is graded already; leave DIR out")
        return _merge(console, arguments.merge, arguments.out)
    plan = make_plan(project, _order(arguments, grader))
    with _only_one(plan.order.out):
        meter = Meter(console, len(plan.mine()))
        return _grade(console, plan, _prepare(plan.order, meter), meter)
