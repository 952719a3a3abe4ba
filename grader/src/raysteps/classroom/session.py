"""One run over a class."""

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Protocol

from raysteps.classroom.database import ClassDatabase
from raysteps.classroom.files import withdraw_tables, write_submission
from raysteps.classroom.interrupts import terminated_as_interrupted, undisturbed
from raysteps.classroom.keys import submission_key
from raysteps.classroom.messages import Answer, Job
from raysteps.classroom.plan import Plan
from raysteps.classroom.progress import Meter, first_line
from raysteps.classroom.taking_in import take_in_as
from raysteps.common.errors import GraderFault
from raysteps.common.text import number
from raysteps.results.document import validate


class Runner(Protocol):
    """Something that grades jobs: this machine, or many."""

    def answers(self, jobs: Iterator[Job]) -> Iterator[Answer]: ...

    def close(self) -> None:
        """Ends what still runs."""


@dataclass
class _Pending:
    """What is known of a job until its answer comes."""

    key: str
    unreadable: bool


@dataclass
class Session:
    """Grades what the plan says into the database."""

    plan: Plan
    kit: str
    database: ClassDatabase
    meter: Meter
    run: int
    names: dict[str, str]
    reused: list[str] = field(default_factory=list)
    recorded: set[str] = field(default_factory=set)
    _pending: dict[str, _Pending] = field(default_factory=dict)

    def _jobs(self) -> Iterator[Job]:
        """Read only when it is their turn: a whole class need not fit into memory."""
        for entry in self.plan.mine():
            name = self.names[entry.label]
            try:
                taken = take_in_as(name, entry.path, self.plan.steps)
            except GraderFault as fault:
                self._record(Answer(name, "fault", fault=str(fault), worker="head"), _Pending("", False))
                continue
            key = submission_key(taken.submission, self.kit, self.plan.grading)
            if self.plan.order.resume and self._is_done(name, key):
                self.reused.append(name)
                self.meter.skip()
                continue
            self._pending[name] = _Pending(key, taken.unreadable)
            order = self.plan.order
            yield Job(taken.submission, self.plan.grading, order.grader, self.kit, order.require_sandbox, self.plan.uid)

    def _is_done(self, name: str, key: str) -> bool:
        current = self.database.current(name)
        if current is None or current["status"] == "fault" or current["key"] != key:
            return False
        return not self.plan.order.require_sandbox or bool(json.loads(current["document"])["isolation"]["strong"])

    def _record(self, answer: Answer, pending: _Pending) -> None:
        if answer.document is not None:
            try:
                validate(answer.document)
            except GraderFault as fault:
                answer = Answer(answer.name, "fault", fault=str(fault), seconds=answer.seconds, worker=answer.worker)
        if self.database.record(self.run, answer, pending.key, unreadable=pending.unreadable):
            if not self.recorded:
                withdraw_tables(self.plan.order.out)
            self.recorded.add(answer.name)
            write_submission(self.database, self.plan.order.out, answer.name)
            total = answer.document["total"] if answer.document is not None else None
            points = (
                f"{number(total['points'])} of {number(total['max'])} points"
                if total
                else f"FAULT: {first_line(answer.fault)}"
            )
            self.meter.count(answer.name, points)

    def grade(self, runner: Runner) -> bool:
        """Whether it came to its end; what was graded until then is kept either way."""
        complete = False
        try:
            with terminated_as_interrupted():
                for answer in runner.answers(self._jobs()):
                    pending = self._pending.pop(answer.name, None)
                    if pending is not None:  # else it came twice
                        self._record(answer, pending)
                complete = True
        except KeyboardInterrupt:
            self.meter.say("interrupted; ending what still runs")
        finally:
            with undisturbed():
                runner.close()
                self.database.end_run(self.run, "complete" if complete else "interrupted", self.reused)
        return complete
