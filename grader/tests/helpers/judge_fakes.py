"""Workers that are Python functions: the judge does not notice."""

from collections.abc import Callable, Sequence

from raysteps.common.process import Outcome
from raysteps.common.vectors import Vector
from raysteps.judge.protocol import text
from raysteps.sandbox.task import TaskResult

Answer = Callable[[str, list[float]], str]


class Ended(Exception):
    """The worker ends in the middle of a case; `code` as a process would."""

    def __init__(self, code: int = -11, *, timed_out: bool = False, half: str = "") -> None:
        super().__init__()
        self.code = code
        self.timed_out = timed_out
        self.half = half  # what it wrote of a line


def ran(stdout: str, code: int = 0, *, timed_out: bool = False, seconds: float = 0.01) -> TaskResult:
    return TaskResult(Outcome(code, timed_out, stdout, "", seconds), {}, 0.0, "wall" if timed_out else "")


class FakeWorker:
    """Answers cases as worker.cpp does. Counts how often it was started, and how long it ran; who hangs runs as long
    as it may."""

    def __init__(self, answer: Answer, seconds: float = 0.01) -> None:
        self._answer = answer
        self._seconds = seconds
        self.starts = 0
        self.used = 0.0

    def __call__(self, stdin: bytes, seconds: float) -> TaskResult:
        self.starts += 1
        ran = self._run(stdin, seconds)
        self.used += ran.outcome.seconds
        return ran

    def _run(self, stdin: bytes, seconds: float) -> TaskResult:
        said = ""
        lines = stdin.decode().splitlines()
        for line in lines:
            number, function, *rest = line.split()
            said += f"start {number}\n"
            try:
                said += f"done {number} {self._answer(function, [float(word) for word in rest])}\n"
            except Ended as end:
                used = seconds if end.timed_out else self._seconds
                return ran(said + end.half, end.code, timed_out=end.timed_out, seconds=used)
        return ran(said + f"end {len(lines)}\n", seconds=self._seconds)


def words(numbers: Sequence[float] | Vector) -> str:
    return " ".join(text(float(number)) for number in numbers)
