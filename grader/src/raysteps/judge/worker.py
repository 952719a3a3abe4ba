"""Asks a worker all cases of a function. A crash costs the case that was running, and the rest goes on."""

import hashlib
from collections import Counter
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.common.process import Outcome
from raysteps.judge.answers import Verdict
from raysteps.judge.functions import Case, Function
from raysteps.results.model import Termination
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Limits, Sandbox, Task, TaskResult
from raysteps.toolchain.compile import Program
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import LEAST_SECONDS, PATIENT_STOPS, StepLimits

# How long the functions of a step may run.

_STEP_FACTOR = 4  # all functions of a step together may take this many times the limit of one run
_AFTER_HANGS = 0.25  # of the limit


class TimeBudget:
    """Each function is asked once at least, whatever those before it took: a function that hangs silences nobody.
    Who ran into a limit twice, on time or on memory, may do so in all that follows, and gets less time from then
    on. Who is known to hang gets less from the beginning, and takes nobody's patience."""

    def __init__(self, seconds: float, functions: int) -> None:
        self._limit = seconds
        self._short = min(seconds, max(LEAST_SECONDS, _AFTER_HANGS * seconds))
        self._left = _STEP_FACTOR * seconds
        self._to_come = functions
        self._stops = 0
        self.known_to_hang = False  # the function that is asked next

    def next_function(self) -> float:
        """Seconds of its first run."""
        self._to_come -= 1
        return max(self._short, self.next_run())

    def next_run(self) -> float:
        """Seconds of one more run of the same function; 0 when there is no time left for it."""
        free = self._left - self._to_come * self._short
        most = min(free, self._short if self.known_to_hang or self._stops >= PATIENT_STOPS else self._limit)
        return most if most >= self._short else 0.0

    def spend(self, seconds: float, *, stopped: bool) -> None:
        self._left -= seconds
        self._stops += stopped and not self.known_to_hang


Ask: TypeAlias = Callable[[bytes, float], TaskResult]  # the worker's stdin, and how many seconds it may take

NO_END = "it did not come to an end in the time that it has"
_MAX_ENDINGS = 3  # in one kind of cases; what else is of that kind is not asked, and counts like what was
_MAX_RESTARTS = 24
_MAX_CUTS = 30  # a long answer may be cut off at the limit of a sandbox; what came before counts


@dataclass(frozen=True)
class Reply:
    """What came back for one case: the words after `done <id>`, or why there are none. `asked` is false where the
    worker never came to it, so that nobody knows what it would have said."""

    line: str = ""
    outcome: Termination = "ok"
    note: str = ""
    asked: bool = True


@dataclass(frozen=True)
class Replies:
    """One for each case, and the seconds that the worker ran."""

    replies: list[Reply]
    seconds: float


@dataclass(frozen=True)
class WorkerRun:
    """The replies of a single run, and what it took; who was stopped took all the time that was given."""

    replies: list[Reply]
    cpu_seconds: float
    wall_seconds: float


def _read(lines: Sequence[str], first: int, last: int) -> list[Reply]:
    """The answers, in order. Lines that do not fit are no answers."""
    answers: list[Reply] = []
    announced = False
    for line in lines:
        due = first + len(answers)
        if due > last:
            break
        if line == f"start {due}":
            announced = True
        elif announced and line.startswith(f"done {due} "):
            answers.append(Reply(line.split(" ", 2)[2]))
            announced = False
    return answers


def _trouble(ran: TaskResult, *, in_a_line: bool) -> Reply:
    """Why the worker stopped in the middle."""
    outcome = ran.outcome
    if ran.hung:
        return Reply("", "timeout", NO_END)
    if ran.stopped == "memory":
        return Reply("", "crashed", "stopped for taking too much memory")
    if outcome.code == 0 and in_a_line:
        return Reply("", "wrong", "the answer is too long")
    how = outcome.signal_name or f"exit code {outcome.code}"
    return Reply("", "crashed", f"the program ended ({how})")


def _stdin(cases: Sequence[Case], first: int) -> bytes:
    return "".join(f"{case.line(i)}\n" for i, case in enumerate(cases[first:], first)).encode()


def _replies_and_trouble(ran: TaskResult, cases: Sequence[Case], first: int) -> tuple[list[Reply], Reply | None]:
    """The answers, and what became of the next case; None where nobody knows."""
    lines = ran.outcome.stdout.split("\n")
    rest = lines.pop()
    replies = _read(lines, first, len(cases) - 1)
    if len(replies) == len(cases) - first:
        return replies, None
    # Cut off, perhaps at the end of a line: after the last case a worker says so. It may also have ended itself in
    # the next case, and will do so again when that is the first one.
    ended = f"end {len(cases) - first}" in lines[-1:]
    was_cut = ran.outcome.code == 0 and not ran.hung and not ran.stopped and not ended
    return replies, None if was_cut and replies else _trouble(ran, in_a_line=bool(rest))


def ask_worker(ask: Ask, cases: Sequence[Case], budget: TimeBudget) -> Replies:
    """Goes on behind a case that ended the worker. A kind of cases that ended it three times is left, and a function
    that hung three times, or never answered until then."""
    replies: list[Reply] = []
    used, hangs, cuts = 0.0, 0, 0
    endings: Counter[str] = Counter()  # by kind
    seconds = budget.next_function()
    while len(replies) < len(cases):
        if not seconds:
            return _give_up(replies, cases, used, Reply("", "timeout", "there was no time left for it", asked=False))
        ran = ask(_stdin(cases, len(replies)), seconds)
        answers, trouble = _replies_and_trouble(ran, cases, len(replies))
        used += ran.outcome.seconds
        budget.spend(seconds if ran.hung else ran.cpu_seconds, stopped=ran.was_stopped)
        seconds = budget.next_run()
        replies += answers
        if len(replies) == len(cases):
            break
        if trouble is None and cuts < _MAX_CUTS:
            cuts += 1
            continue
        kind = cases[len(replies)].group
        replies.append(trouble or Reply("", "wrong", "the answer is too long"))
        endings[kind] += 1
        hangs += ran.hung
        given_up = Reply("", replies[-1].outcome, "not asked any more after that", asked=False)
        answered = any(reply.outcome == "ok" for reply in replies)
        if hangs == _MAX_ENDINGS or endings.total() == (_MAX_RESTARTS if answered else _MAX_ENDINGS):
            return _give_up(replies, cases, used, given_up)
        if endings[kind] == _MAX_ENDINGS:
            replies += [given_up for case in cases[len(replies) :] if case.group == kind]
    return Replies(replies, used)


def _give_up(replies: list[Reply], cases: Sequence[Case], seconds: float, rest: Reply) -> Replies:
    return Replies(replies + [rest] * (len(cases) - len(replies)), seconds)


def answers_until_trouble(ask: Ask, cases: Sequence[Case], seconds: float) -> WorkerRun:
    """The last reply may be the trouble that ended the run, if the function was called; the rest is not known."""
    ran = ask(_stdin(cases, 0), seconds)
    replies, trouble = _replies_and_trouble(ran, cases, 0)
    if trouble is not None and f"start {len(replies)}" in ran.outcome.stdout.split("\n")[-3:]:
        replies = [*replies, trouble]
    return WorkerRun(replies[: len(cases)], seconds if ran.hung else ran.cpu_seconds, ran.outcome.seconds)


# One case with what came of it.


@dataclass(frozen=True)
class JudgedCase:
    """`outcome` is ok only where the answer is right."""

    case: Case
    verdict: Verdict
    outcome: Termination
    asked: bool = True


def judge_reply(function: Function, case: Case, expected: str, reply: Reply) -> JudgedCase:
    """Compares with the reference's line."""
    verdict = case.verdict(function.answer, expected, reply.line)
    if reply.outcome != "ok":
        verdict = replace(verdict, problem=reply.note, actual=f"no answer: {reply.note}", credit=0.0, given=None)
    outcome = reply.outcome if reply.outcome != "ok" or not verdict.problem else "wrong"
    return JudgedCase(case, verdict, outcome, reply.asked)


# Asks workers: a student's and the kit's own.

ANSWERS_KB = 8192  # a tree of many boxes is a long answer
_REFERENCE_LIMITS = Limits(wall_seconds=300, cpu_seconds=300, output_kb=ANSWERS_KB)


def ask_student(sandbox: Sandbox, worker: Program, limits: StepLimits) -> Ask:
    """The student's functions, asked in a process that knows no answer: cases, and how many seconds it may take."""

    def ask(cases: bytes, seconds: float) -> TaskResult:
        return sandbox.run(worker.task((), replace(limits.of_program(seconds), output_kb=ANSWERS_KB), cases))

    return ask


def ask_some(ask: Ask, others: Ask, functions: Collection[str]) -> Ask:
    """These functions are asked by `others`. All cases of a question are of one function."""

    def route(cases: bytes, seconds: float) -> TaskResult:
        words = cases.split(maxsplit=2)
        return (others if len(words) > 1 and words[1].decode() in functions else ask)(cases, seconds)

    return route


def uncached_reference_answers(kit: BuiltKit, cases: bytes) -> TaskResult:
    """Its answers to questions that nobody asks twice."""
    return LimitsOnly().run(Task((Input(kit.reference("worker"), "worker"),), _REFERENCE_LIMITS, stdin=cases))


def reference_answers(kit: BuiltKit, cases: bytes) -> TaskResult:
    """The reference's answers, kept: a class is asked the same questions."""
    path = kit.kept("answers", hashlib.sha256(cases).hexdigest()[:32])
    if path.is_file():
        return TaskResult(Outcome(0, False, path.read_text("utf-8"), "", 0.0), {}, 0.0, "")
    ran = uncached_reference_answers(kit, cases)
    if ran.outcome.code != 0 or ran.outcome.timed_out:
        raise GraderFault(f"the reference did not answer the judge: {ran.outcome.stderr.strip()}")
    write_bytes(path, ran.outcome.stdout.encode())
    return ran
