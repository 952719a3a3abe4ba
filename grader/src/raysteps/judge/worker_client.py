"""Asks a worker all cases of a function. A crash costs the case that was running, and the rest goes on."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from raysteps.common.text import in_seconds
from raysteps.judge.functions import Case
from raysteps.judge.time_budget import TimeBudget
from raysteps.results.model import Ending
from raysteps.sandbox.task import Ran

Ask: TypeAlias = Callable[[bytes, float], Ran]  # the worker's stdin, and how many seconds it may take

_MOST_RESTARTS = 3
_MOST_CUTS = 30  # a long answer may be cut off at the limit of a sandbox; what came before counts


@dataclass(frozen=True)
class Reply:
    """What came back for one case: the words after `done <id>`, or why there are none. `asked` is false where the
    worker never came to it, so that nobody knows what it would have said."""

    line: str = ""
    outcome: Ending = "ok"
    note: str = ""
    asked: bool = True


@dataclass(frozen=True)
class Replies:
    """One for each case, and the seconds that the worker ran."""

    replies: list[Reply]
    seconds: float


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


def _hung(ran: Ran) -> bool:
    return ran.outcome.timed_out or ran.stopped in ("wall", "cpu")


def _trouble(ran: Ran, *, in_a_line: bool) -> Reply:
    """Why the worker stopped in the middle."""
    outcome = ran.outcome
    if _hung(ran):
        return Reply("", "timeout", f"stopped after {in_seconds(outcome.seconds)}")
    if ran.stopped == "memory":
        return Reply("", "crashed", "stopped for taking too much memory")
    if outcome.code == 0 and in_a_line:
        return Reply("", "wrong", "the answer is too long")
    how = outcome.signal_name or f"exit code {outcome.code}"
    return Reply("", "crashed", f"the program ended ({how})")


def ask_once(ask: Ask, cases: Sequence[Case], first: int, seconds: float) -> tuple[Ran, list[Reply], Reply | None]:
    """How it ran, the answers that came, and what became of the next case; None where nobody knows."""
    stdin = "".join(f"{case.line(i)}\n" for i, case in enumerate(cases[first:], first))
    ran = ask(stdin.encode(), seconds)
    lines = ran.outcome.stdout.split("\n")
    rest = lines.pop()
    replies = _read(lines, first, len(cases) - 1)
    # Cut off, perhaps at the end of a line: after the last case a worker says so. It may also have ended itself in
    # the next case, and will do so again when that is the first one.
    ended = f"end {len(cases) - first}" in lines[-1:]
    was_cut = ran.outcome.code == 0 and not _hung(ran) and not ran.stopped and not ended
    return ran, replies, None if was_cut and replies else _trouble(ran, in_a_line=bool(rest))


def ask_worker(ask: Ask, cases: Sequence[Case], budget: TimeBudget) -> Replies:
    """Goes on behind a case that ended the worker, three times at most."""
    replies: list[Reply] = []
    used, restarts, cuts = 0.0, 0, 0
    seconds = budget.next_function()
    while len(replies) < len(cases):
        if not seconds:
            return _give_up(replies, cases, used, Reply("", "timeout", "there was no time left for it", asked=False))
        ran, answers, trouble = ask_once(ask, cases, len(replies), seconds)
        used += ran.outcome.seconds
        budget.spend(ran.outcome.seconds, hung=_hung(ran))
        seconds = budget.next_run()
        replies += answers
        if len(replies) == len(cases):
            break
        if trouble is None and cuts < _MOST_CUTS:
            cuts += 1
            continue
        replies.append(trouble or Reply("", "wrong", "the answer is too long"))
        restarts += 1
        if restarts > _MOST_RESTARTS:
            given_up = Reply("", replies[-1].outcome, "not asked any more after that", asked=False)
            return _give_up(replies, cases, used, given_up)
    return Replies(replies, used)


def _give_up(replies: list[Reply], cases: Sequence[Case], seconds: float, rest: Reply) -> Replies:
    return Replies(replies + [rest] * (len(cases) - len(replies)), seconds)


def answers_until_trouble(ask: Ask, cases: Sequence[Case], seconds: float) -> Replies:
    """One run, and the seconds of a processor that it took. The last reply may be the trouble that ended it, if the
    function was called; the rest is not known."""
    ran, replies, trouble = ask_once(ask, cases, 0, seconds)
    if trouble is not None and f"start {len(replies)}" in ran.outcome.stdout.split("\n")[-3:]:
        replies = [*replies, trouble]
    return Replies(replies[: len(cases)], ran.outcome.seconds if _hung(ran) else ran.cpu_seconds)
