"""The command `grade-class`."""

import argparse
from collections.abc import Container, Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from rich.console import Console

from raysteps.classroom.arguments import add_arguments, line_to_go_on, read_order, refuse_beside_merge
from raysteps.classroom.cluster import Cluster
from raysteps.classroom.database import LOCK, ClassDatabase
from raysteps.classroom.files import withdraw_tables, write_class
from raysteps.classroom.graders import KIT_GRADER, Grader, make_grader
from raysteps.classroom.interrupts import terminated_as_interrupted
from raysteps.classroom.merge import merge
from raysteps.classroom.order import Order
from raysteps.classroom.plan import Plan, make_plan
from raysteps.classroom.pool import LocalPool
from raysteps.classroom.progress import Meter
from raysteps.classroom.report import class_document
from raysteps.classroom.session import Runner, Session
from raysteps.classroom.summary import print_summary
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import usable_folder
from raysteps.common.locks import try_lock
from raysteps.common.systems import refuse_on_windows
from raysteps.kit.project import Project

__all__ = ["add_arguments", "run"]


@contextmanager
def _only_one(out: Path) -> Iterator[None]:
    """Two runs into one folder would take each other's results for changes."""
    usable_folder(out)
    with (out / LOCK).open("a") as file:
        try:
            is_ours = try_lock(file.fileno())
        except OSError:
            is_ours = True  # a file system without locks
        if not is_ours:
            raise UsageError(f"{out}: another grade-class is writing there; wait for it, or name another --out")
        yield


def _finish(console: Console, database: ClassDatabase, out: Path, done: Container[str] = ()) -> dict[str, Any]:
    document = class_document(database)
    write_class(database, out, document, done)
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


def _again(order: Order) -> str:
    return f"To go on:\n  {line_to_go_on(order)}"


def _interrupted(console: Console, again: str) -> int:
    console.print(f"Interrupted. {again}", markup=False, highlight=False, soft_wrap=True)
    return 130


def _grade(console: Console, plan: Plan, grader: Grader, meter: Meter) -> int:
    order = plan.order
    again = _again(order)
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
                _finish(console, database, order.out, session.recorded)
            raise GraderFault(f"{fault}\n{again}") from fault
        document = _finish(console, database, order.out, session.recorded)
    if not complete:
        return _interrupted(console, again)
    return GraderFault.exit_code if document["faults"] else 0


def _merge(console: Console, folders: list[Path], out: Path) -> int:
    with _only_one(out), closing(ClassDatabase(out)) as database:
        missing, warnings = merge(folders, database)
        withdraw_tables(out)
        document = _finish(console, database, out)
    for warning in warnings:
        console.print(f"Warning: {warning}", markup=False, highlight=False, soft_wrap=True)
    if missing:
        console.print(f"Missing: {', '.join(missing)} of the shards", markup=False)
    return GraderFault.exit_code if missing or document["faults"] or document["not_graded"] else 0


def run(project: Project, arguments: argparse.Namespace, console: Console, *, grader: str = KIT_GRADER) -> int:
    """0 when all were graded, whatever their points; 4 when the grader failed with one, or when a merge leaves some
    that are not graded yet; 130 when interrupted."""
    refuse_on_windows("grade-class")
    if arguments.merge:
        refuse_beside_merge(arguments)
        return _merge(console, arguments.merge, arguments.out)
    plan = make_plan(project, read_order(arguments, grader))
    with _only_one(plan.order.out):
        meter = Meter(console, len(plan.mine()))
        for words in plan.given.said:
            meter.say(words)
        try:
            with terminated_as_interrupted():
                made = _prepare(plan.order, meter)
        except KeyboardInterrupt:
            return _interrupted(console, _again(plan.order))
        return _grade(console, plan, made, meter)
