"""Which of many candidates are wrong in the same way as a known case, and which of these is beyond doubt."""

from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.common.errors import GraderFault
from raysteps.judge.candidates import Candidate
from raysteps.judge.changes import Change
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Case, Function
from raysteps.judge.judged import Judged, judge_reply
from raysteps.judge.patience import Patience
from raysteps.judge.reshaping import jittered
from raysteps.judge.worker_client import Ask, Reply, answers_until_trouble

_JITTERS = 4
_TRIED_FOR_STABILITY = 5
_REFERENCE_SECONDS = 60.0


@dataclass(frozen=True)
class Wrong:
    """A candidate that is wrong as well, and how it came from the last one."""

    candidate: Candidate
    change: Change
    judged: Judged


def _silent(judged: Judged) -> bool:
    return judged.outcome in ("crashed", "timeout")


def _same_way(one: Judged, other: Judged) -> bool:
    if one.outcome != other.outcome:
        return False
    alike = type(one.verdict.problem) is type(other.verdict.problem) and one.verdict.problem == other.verdict.problem
    return alike or one.outcome == "timeout"


class Trials:
    """Asks many candidates at once: one run of the student's worker and one of the reference's for each round."""

    def __init__(self, function: Function, student: Ask, reference: Ask, patience: Patience) -> None:
        self._function = function
        self._student = student
        self._reference = reference
        self._patience = patience

    def wrong(self, found: Judged, proposed: Sequence[tuple[Candidate, Change]], seconds: float) -> list[Wrong]:
        """Those that are wrong in the same way, the simplest first."""
        cases = [candidate.case for candidate, _ in proposed]
        replies = self._replies(cases, seconds, go_on=not _silent(found))
        answered = [i for i, reply in enumerate(replies) if reply is not None]
        expected = self._expected([cases[i] for i in answered])
        wrong = []
        for i, line in zip(answered, expected, strict=True):
            judged = self._judge(cases[i], line, replies[i])
            if judged is not None and judged.asked and _same_way(found, judged):
                wrong.append(Wrong(*proposed[i], judged))
        return wrong

    def _replies(self, cases: Sequence[Case], seconds: float, *, go_on: bool) -> list[Reply | None]:
        """Simple cases come first: where the function crashes or hangs, the first such is the simplest."""
        replies: list[Reply | None] = []
        runs = 3 if go_on else 1
        while len(replies) < len(cases) and runs > 0 and seconds > 0:
            part = answers_until_trouble(self._student, cases[len(replies) :], seconds)
            self._patience.spend(part.seconds)
            seconds, runs = self._patience.next_run(), runs - 1
            replies += part.replies
        return replies + [None] * (len(cases) - len(replies))

    def _expected(self, cases: Sequence[Case]) -> list[str]:
        """The reference's lines; empty where it has none."""
        part = answers_until_trouble(self._reference, cases, _REFERENCE_SECONDS) if cases else None
        lines = [reply.line if reply.outcome == "ok" else "" for reply in part.replies] if part else []
        return lines + [""] * (len(cases) - len(lines))

    def _judge(self, case: Case, expected: str, reply: Reply | None) -> Judged | None:
        """Nothing where the reference itself fails: such a case is none."""
        try:
            return judge_reply(self._function, case, expected, reply) if reply is not None else None
        except GraderFault:
            return None

    def simplest_stable(self, wrong: Sequence[Wrong]) -> Wrong | None:
        """The simplest whose right answer stays the same when all numbers move a little: where it does not, correct
        methods may disagree. Kinds with exact numbers know what they do."""
        first = sorted(wrong, key=lambda one: one.candidate.complexity)[:_TRIED_FOR_STABILITY]
        if not first or self._function.by_name[first[0].candidate.case.group].exact:
            return next(iter(first), None)
        cases = [self._jittered(one.candidate.case, seed) for one in first for seed in range(_JITTERS)]
        lines = self._expected([one.candidate.case for one in first] + cases)
        for i, one in enumerate(first):
            near = range(len(first) + i * _JITTERS, len(first) + (i + 1) * _JITTERS)
            if all(self._agrees(one.candidate.case, lines[i], lines[k]) for k in near):
                return one
        return None

    def _jittered(self, case: Case, seed: int) -> Case:
        return Case(case.function, case.group, jittered(case.inputs, Draw(f"jitter {seed}").sign))

    def _agrees(self, case: Case, expected: str, near: str) -> bool:
        judged = self._judge(case, expected, Reply(near))
        return judged is not None and not judged.verdict.problem
