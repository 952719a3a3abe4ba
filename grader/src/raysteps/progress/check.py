"""Checks a student's own steps and keeps what came of it in build/check."""

import os
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from raysteps.common.files import one_at_a_time
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.grading.self_check import self_check
from raysteps.grading.step import clear
from raysteps.progress.standing import remember
from raysteps.report.student import try_student_page
from raysteps.results.model import Results
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import Submission, load_submission
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback


@dataclass(frozen=True)
class CheckResult:
    """What came of checking one's own steps; there is no page where it could not be made."""

    kit: BuiltKit
    results: Results
    page: Path | None


Tell = Callable[[BuiltKit, Results], None]  # of results in which no mistake has its name yet


def _look_through(
    kit: BuiltKit, submission: Submission, chosen: list[Step], out: Path, say: ProgressCallback, tell: Tell
) -> Results:
    jobs = os.cpu_count() or 1
    if not kit.has_reference:
        return self_check(kit, submission, chosen, jobs, LimitsOnly(), out, say)
    from raysteps.grading.pipeline import (
        grade_submission,  # a students' kit has neither the judge nor what belongs to it
    )
    from raysteps.results.settings import Settings

    settings = Settings(only=tuple(step.id for step in chosen))
    first = partial(tell, kit)
    return grade_submission(kit, submission, settings, LimitsOnly(), out, say, jobs=jobs, tell=first)


def check_steps(
    project: Project, chosen: list[Step], say: ProgressCallback, tell: Tell = lambda kit, results: None
) -> CheckResult:
    """The steps in the repository; the results go to build/check. Your own code needs no sandbox. Where mistakes must
    be learned before they can be named, `tell` gets the results at once."""
    out = project.build / "check"
    with one_at_a_time(project.build / "check.lock"):
        kit = build_kit(project, say).in_one_process()
        clear(out, kit.steps, chosen)
        submission = load_submission(project.steps, kit.steps)
        results = _look_through(kit, submission, chosen, out, say, tell)
        remember(project, results, submission.sources)
        return CheckResult(kit, results, try_student_page(out, kit.steps, say))
