"""Checks a student's own steps and keeps what came of it in build/check."""

import os
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.files import one_at_a_time, usable_folder
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.grading.self_check import self_check
from raysteps.progress.standing import remember
from raysteps.report.student import REPORT, try_student_page
from raysteps.results.model import Results
from raysteps.results.store import FOLDER as CASES
from raysteps.results.store import place_of
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import Submission, load_submission
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback


def exit_code(results: Results) -> int:
    """0 all passed (a bonus need not be started), 3 when building is the only trouble, else 1."""
    open_steps = [
        step for step in results.steps if step.status != "passed" and not (step.bonus and step.status == "not-started")
    ]
    if not open_steps:
        return 0
    return 3 if all(step.status == "does-not-build" for step in open_steps) else 1


def clear(out: Path, steps: list[Step], asked_again: list[Step]) -> None:
    """Old results must not be taken for new ones. Only what a grader names so is deleted: the folder may be any. Cases
    stay for `replay` until their step is graded again."""
    usable_folder(out)
    try:
        for name in ("results.json", REPORT):
            (out / name).unlink(missing_ok=True)
        for step in steps:
            folder = out / "pictures" / step.id
            if folder.is_symlink() or folder.parent.is_symlink() or not folder.is_dir():
                continue
            for kind in ("mine", "reference", "difference"):
                for picture in folder.glob(f"*-{kind}.png"):
                    picture.unlink()
            if not any(folder.iterdir()):
                folder.rmdir()
        if not (out / CASES).is_symlink():
            for name in (place_of(step.number, function) for step in asked_again for function in step.functions):
                (out / name).unlink(missing_ok=True)
        for room in (out / "pictures", out / CASES):
            if room.is_dir() and not room.is_symlink() and not any(room.iterdir()):
                room.rmdir()
    except OSError as error:
        raise UsageError(f"{out}: old results cannot be removed: {error}") from error


@dataclass(frozen=True)
class CheckResult:
    """What came of checking one's own steps; there is no page where it could not be made."""

    kit: BuiltKit
    results: Results
    page: Path | None


def _look_through(
    kit: BuiltKit, submission: Submission, chosen: list[Step], out: Path, say: ProgressCallback
) -> Results:
    jobs = os.cpu_count() or 1
    if not kit.has_reference:
        return self_check(kit, submission, chosen, jobs, LimitsOnly(), out, say)
    from raysteps.grading.pipeline import (
        grade_submission,  # a students' kit has neither the judge nor what belongs to it
    )
    from raysteps.results.settings import Settings

    settings = Settings(only=tuple(step.id for step in chosen))
    return grade_submission(kit, submission, settings, LimitsOnly(), out, say, jobs=jobs)


def check_steps(project: Project, chosen: list[Step], say: ProgressCallback) -> CheckResult:
    """The steps in the repository; the results go to build/check. Your own code needs no sandbox."""
    out = project.build / "check"
    with one_at_a_time(project.build / "check.lock"):
        kit = build_kit(project, say)
        clear(out, kit.steps, chosen)
        submission = load_submission(project.steps, kit.steps)
        results = _look_through(kit, submission, chosen, out, say)
        remember(project, results, submission.sources)
        return CheckResult(kit, results, try_student_page(out, kit.steps, say))
