"""One case with what came of it."""

from dataclasses import dataclass

from raysteps.judge.answers import Verdict
from raysteps.judge.functions import Case, Function
from raysteps.judge.worker_client import Reply
from raysteps.results.model import Ending


@dataclass(frozen=True)
class Judged:
    """`outcome` is ok only where the answer is right."""

    case: Case
    verdict: Verdict
    outcome: Ending
    asked: bool = True

    @property
    def decided(self) -> bool:
        """Whether it says anything about the function."""
        return self.asked and self.verdict.decided


def judge_reply(function: Function, case: Case, expected: str, reply: Reply) -> Judged:
    """Compares with the reference's line."""
    verdict = function.answer.verdict(case.function, case.inputs, expected, reply.line)
    if reply.outcome != "ok":
        verdict = Verdict(reply.note, verdict.expected, f"no answer: {reply.note}")
    outcome = reply.outcome if reply.outcome != "ok" or not verdict.problem else "wrong"
    return Judged(case, verdict, outcome, reply.asked)
