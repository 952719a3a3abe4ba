"""Asks a worker all cases of a function. A crash costs the case that was running, and the rest goes on."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from raysteps.common.text import number
from raysteps.grading.results import Ending
from raysteps.judge.functions import Case
from raysteps.sandbox.task import Ran

Ask: TypeAlias = Callable[[bytes], Ran]

_MOST_RESTARTS = 3
_MOST_CUTS = 30  # a long answer may be cut off at the limit of a sandbox; what came before counts


@dataclass(frozen=True)
class Reply:
    """What came back for one case: the words after `done <id>`, or why there are none."""

    line: str = ""
    outcome: Ending = "ok"
    note: str = ""


@dataclass(frozen=True)
class Replies:
    """One for each case, and the seconds that the worker ran."""

    replies: list[Reply]
    seconds: float


def _read(stdout: str, first: int, last: int) -> dict[int, str]:
    """The answers, in order. Lines that do not fit are no answers."""
    answers: dict[int, str] = {}
    announced = False
    for line in stdout.split("\n")[:-1]:
        due = first + len(answers)
        if due > last:
            break
        if line == f"start {due}":
            announced = True
        elif announced and line.startswith(f"done {due} "):
            answers[due] = line.split(" ", 2)[2]
            announced = False
    return answers


def _trouble(ran: Ran) -> Reply:
    """Why the worker stopped in the middle."""
    outcome = ran.outcome
    if outcome.timed_out or ran.stopped in ("wall", "cpu"):
        return Reply("", "timeout", f"stopped after {number(outcome.seconds)} seconds")
    if ran.stopped == "memory":
        return Reply("", "crashed", "stopped for taking too much memory")
    how = outcome.signal_name or f"exit code {outcome.code}"
    return Reply("", "crashed", f"the program ended ({how})")


def ask_worker(ask: Ask, cases: Sequence[Case], most_seconds: float) -> Replies:
    """Goes on behind a case that ended the worker, three times at most."""
    replies: list[Reply] = []
    seconds, restarts, cuts = 0.0, 0, 0
    while len(replies) < len(cases):
        if seconds > most_seconds:
            return _give_up(replies, cases, seconds, Reply("", "timeout", "there was no time left for it"))
        first, last = len(replies), len(cases) - 1
        lines = [case.line(i) for i, case in enumerate(cases[first:], first)]
        ran = ask("".join(line + "\n" for line in lines).encode())
        seconds += ran.outcome.seconds
        answers = _read(ran.outcome.stdout, first, last)
        replies += [Reply(answers[i]) for i in sorted(answers)]
        if len(replies) == len(cases):
            break
        was_cut = ran.outcome.code == 0 and bool(ran.outcome.stdout) and not ran.outcome.stdout.endswith("\n")
        if was_cut and answers and cuts < _MOST_CUTS:
            cuts += 1
            continue
        replies.append(Reply("", "wrong", "the answer is too long") if was_cut else _trouble(ran))
        restarts += 1
        if restarts > _MOST_RESTARTS:
            return _give_up(replies, cases, seconds, Reply("", replies[-1].outcome, "not asked any more after that"))
    return Replies(replies, seconds)


def _give_up(replies: list[Reply], cases: Sequence[Case], seconds: float, rest: Reply) -> Replies:
    return Replies(replies + [rest] * (len(cases) - len(replies)), seconds)
