"""A grader that only reads what it is told in the sources of step 01. Its workers import this and no command line.

`// points 7` gives points, `// hidden WORD` fails a hidden case of that input, `// unset NAME` uses a variable without
a value in that function, `// wait 0.5` takes time, `// die`, `// die once`, `// fault`, `// oops` go wrong,
`// program` starts a program that never ends, `// hang` never ends itself, `// held` waits while there is a file of the
log's name that ends in .hold."""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.course.manifest import read_steps
from raysteps.course.project import here
from raysteps.results.model import (
    USED_WITHOUT_VALUE,
    Diagnosis,
    HiddenResult,
    ImageResult,
    Results,
    Settings,
    StepResult,
    Timing,
)
from raysteps.results.store import write_results
from raysteps.sandbox.task import Isolation
from raysteps.submission.load import Submission
from raysteps.toolchain.kit_artifacts import ProgressCallback

FAKE = "fake_grader:make"
_REFERENCE = b"a reference picture, alike for all"


def log(text: str) -> None:
    """A line that several processes may write at once."""
    if path := os.environ.get("FAKE_LOG"):
        with Path(path).open("a") as file:
            file.write(f"{text}\n")


def _number(words: str, text: str) -> float | None:
    found = re.search(rf"// {words} ([0-9.]+)", text)
    return float(found[1]) if found else None


class FakeGrader:
    """Has no kit and no sandbox."""

    def __init__(self) -> None:
        self.fingerprint = os.environ.get("FAKE_KIT", "fake-kit")
        self.isolation = Isolation("none", os.environ.get("FAKE_STRONG") == "1", "No program runs.")

    def _misbehave(self, name: str, text: str) -> None:
        if "// die" in text:
            marker = Path(os.environ["FAKE_LOG"]).with_suffix(f".{name}")
            if "once" not in text or not marker.exists():
                marker.touch()
                print("it gets dark", file=sys.stderr, flush=True)
                os.kill(os.getpid(), signal.SIGKILL)
        if "// fault" in text:
            raise GraderFault("the moon is in the way")
        if "// oops" in text:
            raise ZeroDivisionError("oops")
        while "// held" in text and Path(os.environ["FAKE_LOG"]).with_suffix(".hold").exists():
            time.sleep(0.02)
        if "// hang" in text:
            re.match("(a+)+b", "a" * 60)
        if "// program" in text:
            program = subprocess.Popen(["sleep", "1000"], start_new_session=True)
            log(f"program {program.pid}")
            program.wait()

    def learn(self, steps: Sequence[str], say: ProgressCallback) -> None:
        """Knows no mistakes."""

    def grade(self, submission: Submission, settings: Settings, out: Path, say: ProgressCallback) -> None:
        source = next(iter(submission.sources.values()), b"").decode()
        log(f"begin {submission.name}")
        log(f"at {os.environ.get('FAKE_WORKER', 'here')}")
        time.sleep(_number("wait", source) or 0)
        self._misbehave(submission.name, source)
        points = _number("points", source) or 0.0
        steps = []
        for step in read_steps(here()):
            if settings.only and step.id not in settings.only:
                continue
            started = step.id in submission.sources
            mine = f"pictures/{step.id}/a-mine.png"
            reference = f"pictures/{step.id}/a-reference.png"
            result = StepResult(step.id, "partial" if started else "not-started", 0.0, step.points, step.bonus)
            if started:
                result.points = min(points, step.points)
                result.images = [
                    ImageResult("a", "a.nff", True, 0.1, mine=mine, reference=reference, seconds=time.time())
                ]
                result.hidden = [
                    HiddenResult("camera", "function", 0.0, message="is wrong", given=word, outcome="wrong")
                    for word in re.findall(r"// hidden (\w+)", source)
                ]
                result.diagnoses = [
                    Diagnosis("finding", USED_WITHOUT_VALUE, f"In {name} there is one.", seen_in=[name])
                    for name in re.findall(r"// unset (\w+)", source)
                ]
                (out / mine).parent.mkdir(parents=True)
                (out / mine).write_bytes(source.encode())
                (out / reference).write_bytes(_REFERENCE)
                (out / "pictures" / step.id / "secret-mine.png").write_bytes(b"named nowhere")
            if step.id in submission.notes:
                result.messages = [submission.notes[step.id]]
            steps.append(result)
        results = Results.of(submission.name, steps, self.fingerprint, self.isolation, Timing(time.time(), 1.0))
        write_results(results, out)
        log(f"end {submission.name}")


def make(*, require_sandbox: bool, say: ProgressCallback) -> FakeGrader:
    return FakeGrader()
