"""One run over a class."""

import hashlib
import json
import signal
import sqlite3
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from functools import cached_property
from types import FrameType
from typing import Protocol

from raysteps.classroom.class_document import CurrentResults
from raysteps.classroom.class_files import withdraw_tables, write_submission
from raysteps.classroom.database import ClassDatabase
from raysteps.classroom.entries import ClassEntry, load_entry
from raysteps.classroom.jobs import GAVE_UP, Job, JobResult
from raysteps.classroom.resubmissions import sources_digest
from raysteps.classroom.run_plan import Plan
from raysteps.classroom.summary import ProgressMeter
from raysteps.common.errors import GraderFault
from raysteps.common.text import first_line
from raysteps.report.wording import total_words
from raysteps.results.model import Settings
from raysteps.results.store import stored_results
from raysteps.submission.load import Submission

# When two gradings are the same one.


def submission_key(submission: Submission, kit: str, settings: Settings) -> str:
    """Of everything that a result depends on: what was handed in, the kit, and how it was asked to grade."""
    sources = {step: hashlib.sha256(data).hexdigest() for step, data in submission.sources.items()}
    parts = [submission.name, sources, submission.notes, submission.remarks, kit, asdict(settings)]
    text = json.dumps(parts, sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()


def is_up_to_date(current: sqlite3.Row | None, key: str, *, require_sandbox: bool) -> bool:
    """Whether the result that counts for a submission needs no other one."""
    if current is None or current["key"] != key:
        return False
    if current["status"] == "fault":
        return str(current["fault"]).startswith(GAVE_UP)
    results = stored_results(current["document"])
    return results is not None and (results.isolation.strong or not require_sandbox)


# What Ctrl-C and SIGTERM do while a class is graded.


@contextmanager
def terminated_as_interrupted() -> Iterator[None]:
    """A batch system sends SIGTERM before it kills: there is time to leave things in order, as after Ctrl-C."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def interrupt(number: int, frame: FrameType | None) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGTERM, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


@contextmanager
def undisturbed() -> Iterator[None]:
    """A second Ctrl-C must not break off the tidying up after the first."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(number, signal.SIG_IGN) for number in numbers]
    try:
        yield
    finally:
        for which, handler in zip(numbers, before, strict=True):
            signal.signal(which, handler)


class Runner(Protocol):
    """Something that grades jobs: this machine, or many."""

    def answers(self, jobs: Iterator[Job]) -> Iterator[JobResult]: ...

    def close(self) -> None:
        """Ends what still runs."""


@dataclass
class _Pending:
    """What is known of a job until its answer comes."""

    key: str
    unreadable: bool
    sources: dict[str, bytes] = field(default_factory=dict)
    digest: str = ""  # of all that was handed in


@dataclass
class Session:
    """Grades what the plan says into the database."""

    plan: Plan
    kit: str
    database: ClassDatabase
    meter: ProgressMeter
    run: int
    names: dict[str, str]
    learn: Callable[[], None] = lambda: None  # called when the first job is due
    entries: Sequence[ClassEntry] | None = None  # those to grade, in this order; all of the plan when not said
    is_whole: Callable[[ClassEntry], bool] = lambda entry: True  # asked once an entry was read: it may be changing
    told: Callable[[JobResult], None] = lambda answer: None  # of each result that was kept
    reused: dict[str, str] = field(default_factory=dict)  # with the digests of their sources
    recorded: set[str] = field(default_factory=set)
    _pending: dict[str, _Pending] = field(default_factory=dict)

    @cached_property
    def _current_results(self) -> CurrentResults:
        """By the roster and the late policy of this run."""
        return CurrentResults(self.database)

    def _jobs(self) -> Iterator[Job]:
        """Read only when it is their turn: a whole class need not fit into memory."""
        has_learned = False
        for entry in self.plan.mine() if self.entries is None else self.entries:
            name = self.names[entry.label]
            try:
                taken = load_entry(name, entry, self.plan.steps)
            except GraderFault as fault:
                self._record(JobResult(name, "fault", fault=str(fault), worker="head"), _Pending("", False))
                continue
            if not self.is_whole(entry):
                self.meter.skip()
                continue
            key = submission_key(taken.submission, self.kit, self.plan.grading)
            require = self.plan.options.require_sandbox
            digest = sources_digest(taken.submission)
            if self.plan.options.resume and is_up_to_date(self.database.current(name), key, require_sandbox=require):
                self.database.keep_sources(name, taken.submission.sources)
                self.reused[name] = digest
                self.meter.skip()
                continue
            if not has_learned:
                self.learn()
                has_learned = True
            self._pending[name] = _Pending(key, taken.unreadable, taken.submission.sources, digest)
            options = self.plan.options
            yield Job(
                taken.submission, self.plan.grading, options.grader, self.kit, options.require_sandbox, self.plan.uid
            )

    def _record(self, answer: JobResult, pending: _Pending) -> None:
        kept = self.database.record(
            self.run,
            answer,
            pending.key,
            unreadable=pending.unreadable,
            sources=pending.sources,
            digest=pending.digest,
        )
        if kept:
            if not self.recorded:
                withdraw_tables(self.plan.options.out)
            self.recorded.add(answer.name)
            one = self._current_results.named(answer.name)
            write_submission(
                self.database, self.plan.options.out, one, self._current_results.course, self._current_results.manifests
            )
            total = answer.results.total if answer.results is not None else None
            points = total_words(total) if total else f"FAULT: {first_line(answer.fault)}"
            self.meter.count(answer.name, points)
            self.told(answer)

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
