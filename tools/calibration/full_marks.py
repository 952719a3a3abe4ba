"""Grades every correct solution in every setting: each must get full marks."""

import os
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.course.manifest import Step
from raysteps.grading.pipeline import grade_submission
from raysteps.results.model import StepResult
from raysteps.results.settings import Settings
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import Submission
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback
from tools.calibration.measure import Setting, counted, own_setting
from tools.grade_audit import missed
from tools.test_submissions import Entrant, right_ones

_SECONDS = 60.0  # without optimisation, and beside other work, a program takes longer


@dataclass(frozen=True)
class Mark:
    """What a correct solution got."""

    step: Step
    candidate: Entrant
    setting: Setting
    result: StepResult

    @property
    def is_full(self) -> bool:
        return self.result.status == "passed" and self.result.points == self.result.max

    def lost(self) -> str:
        """What cost points, in a line each."""
        head = f"{self.step.id}, {self.candidate.name}, {self.setting.name}: {self.result.status}"
        return "\n  ".join(
            [f"{head}, {self.result.points:g} of {self.result.max:g}", *(missed(self.result) or self.result.messages)]
        )


def mark(kit: BuiltKit, step: Step, candidate: Entrant, setting: Setting, seed: int = 1) -> Mark:
    """As a submission of this one step would be graded."""
    submission = Submission(candidate.name, {step.id: candidate.source.encode()}, {})
    wished = Settings(seed=seed, only=(step.id,), limits={"seconds": _SECONDS})
    with tempfile.TemporaryDirectory(prefix="raysteps-") as out:
        results = grade_submission(setting.applied(kit).in_one_process(), submission, wished, LimitsOnly(), Path(out))
    return Mark(step, candidate, setting, results.steps[0])


def _table(found: Sequence[Mark], seconds: float) -> Table:
    table = Table(title=f"full marks of correct solutions, {seconds:.0f} s", title_justify="left")
    table.add_column("step")
    table.add_column("solution")
    table.add_column("settings", justify="right")
    table.add_column("full marks", justify="right")
    for step, name in dict.fromkeys((one.step.id, one.candidate.name) for one in found):
        mine = [one for one in found if (one.step.id, one.candidate.name) == (step, name)]
        full = sum(one.is_full for one in mine)
        table.add_row(step, escape(name), str(len(mine)), f"[{'green' if full == len(mine) else 'red'}]{full}[/]")
    return table


def marks(
    kit: BuiltKit, steps: Sequence[Step], settings: Sequence[Setting], console: Console, say: ProgressCallback
) -> int:
    """Grades all, prints a table, and says what was lost."""
    start = time.monotonic()
    work = [
        (step, candidate, setting)
        for step in steps
        for candidate in right_ones(kit.project, step)
        for setting in (own_setting(kit), *settings)
    ]
    one_more = counted(say, "graded", len(work))

    def one(item: tuple[Step, Entrant, Setting]) -> Mark:
        found = mark(kit, *item)
        one_more()
        return found

    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        found = list(pool.map(one, work))
    console.print(_table(found, time.monotonic() - start))
    short = [one for one in found if not one.is_full]
    for less in short:
        console.print(less.lost(), markup=False, highlight=False)
    print(f"{len(found) - len(short)} of {len(found)} have full marks", flush=True)
    return 1 if short else 0
