"""Does one job and ends: a process of its own can be stopped at any time, and its faults stop nobody else.

It waits for the job as a line of JSON on stdin, so that it can be started ahead of time, and tells what it sees as
lines of JSON on stdout. A job is {"kind": "look" or "check", "root": FOLDER, "step": ID}; a line is a WorkerLine.
"""

import contextlib
import json
import os
import signal
import sys
from dataclasses import asdict
from pathlib import Path
from types import FrameType

from raysteps.common.errors import RaystepsError, reason
from raysteps.common.platform import own_command
from raysteps.common.process import end_what_runs
from raysteps.course.manifest import chosen_step
from raysteps.course.project import Project
from raysteps.grading.quick_look import QuickLook
from raysteps.progress import own_check  # noqa: F401 - ahead of time
from raysteps.progress.check import check_steps
from raysteps.progress.standing import own_source
from raysteps.results.model import StepResult
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.entries import RejectedFile
from raysteps.toolchain.build_kit import build_kit
from raysteps.watch.events import WorkerLine

_UNHURRIED = 5  # of `nice`: a check goes on while its student types


def _tell(line: WorkerLine) -> None:
    print(json.dumps(asdict(line)), flush=True)


def _say(text: str) -> None:
    _tell(WorkerLine(say=text))


def look(project: Project, name: str) -> None:
    """The visible part, told bit by bit."""
    kit = build_kit(project, _say).in_one_process()
    step = chosen_step(project, name)
    out = project.build / "watch"

    def tell(result: StepResult, *, complete: bool = False) -> None:
        _tell(WorkerLine(result=result, out=str(out), complete=complete))

    try:
        source = own_source(project, step)
    except (OSError, RejectedFile) as error:
        _tell(WorkerLine(error=f"{step.file}: {reason(error)}"))
        return
    if source is None:
        _tell(WorkerLine(error=f"{step.file} is not there; {own_command()} reset {step.number} puts the stub there"))
        return
    tell(QuickLook(kit, step, LimitsOnly(), out, tell).look(source.decode("utf-8", "replace")), complete=True)


def check(project: Project, name: str) -> None:
    """All of it, as `./raysteps check` does."""
    with contextlib.suppress(AttributeError, OSError):
        os.nice(_UNHURRIED)
    chosen = [chosen_step(project, name)]
    (result,) = check_steps(project, chosen, _say).results.steps
    _tell(WorkerLine(result=result, out=str(project.build / "check"), complete=True))


def _stop(number: int, _frame: FrameType | None) -> None:
    """Also CMake and the compiler: the next worker may build in the same folder."""
    end_what_runs()
    os._exit(128 + number)


def main() -> int:
    line = sys.stdin.readline()
    if not line:
        return 0  # whoever wanted it has gone
    signal.signal(signal.SIGTERM, _stop)
    job = json.loads(line)
    try:
        {"look": look, "check": check}[job["kind"]](Project(Path(job["root"])), job["step"])
    except RaystepsError as error:
        _tell(WorkerLine(error=str(error)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
