"""Grades a student's own steps and keeps what came of it in build/check: one report, whatever was checked last."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.platform import processor_count
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.grading.self_check import name_crash, self_check
from raysteps.grading.step import clear_old_results
from raysteps.progress.standing import Kind, StepProgress, next_of, save_progress, standings
from raysteps.report.attempts import OwnProgress, note_attempt, read_attempts
from raysteps.report.student import try_student_page
from raysteps.results.model import Results, StepResult
from raysteps.results.store import RESULTS, read_results, write_results
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.submission.load import Submission
from raysteps.toolchain.compile import CompiledAhead
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback


@dataclass(frozen=True)
class CheckResult:
    """What came of checking one's own steps; there is no page where it could not be made."""

    kit: BuiltKit
    results: Results
    page: Path | None
    following: Step | None  # what comes next in the course


_NEWER: tuple[Kind, ...] = ("changed", "missing", "unreadable")  # than what was checked


def _look_through(
    kit: BuiltKit,
    submission: Submission,
    chosen: list[Step],
    ahead: CompiledAhead,
    out: Path,
    say: ProgressCallback,
    tell: Callable[[Results], None],
    *,
    draws_large: bool,
) -> Results:
    jobs = processor_count()
    if not kit.has_reference:
        heard = tell if draws_large else None
        return self_check(kit, submission, chosen, jobs, LimitsOnly(), out, say, heard, ahead)
    from raysteps.grading.pipeline import (
        grade_submission,  # a students' kit has neither the judge nor what belongs to it
    )
    from raysteps.results.model import Settings

    settings = Settings(only=tuple(step.id for step in chosen))
    crash = partial(name_crash, kit, submission, LimitsOnly(), say)
    return grade_submission(
        kit, submission, settings, LimitsOnly(), out, say, jobs=jobs, tell=tell, name_crash=crash, ahead=ahead
    )


def _with_steps(results: Results, steps: Sequence[StepResult]) -> Results:
    ordered = sorted(steps, key=lambda result: result.id)
    return Results.of(results.submission, ordered, results.kit, results.isolation, results.timing)


def _found_before(out: Path, kit: BuiltKit, chosen: Sequence[Step]) -> Results | None:
    """What the same kit found of other steps, if any."""
    try:
        before = read_results(out / RESULTS)
    except UsageError:
        return None
    asked = {step.id for step in chosen}
    kept = [result for result in before.steps if result.id not in asked]
    return _with_steps(before, kept) if kept and before.kit == kit.fingerprint else None


def check_and_keep(
    kit: BuiltKit,
    submission: Submission,
    chosen: list[Step],
    ahead: CompiledAhead,
    say: ProgressCallback,
    tell: Callable[[CheckResult], None] | None,
) -> CheckResult:
    """Grades the chosen steps, and writes build/check with what is kept there of the others; `tell` gets it at once,
    where more is still to be learned or drawn."""
    project = kit.project
    out = project.build / "check"
    before = _found_before(out, kit, chosen)
    kept = [] if before is None else before.steps
    clear_old_results(out, [step for step in kit.steps if step.id not in {result.id for result in kept}], chosen)
    if before is not None:
        write_results(before, out)  # whatever becomes of the rest
    noted = False

    def keep(results: Results) -> CheckResult:
        nonlocal noted
        whole = _with_steps(results, [*kept, *results.steps]) if kept else results
        write_results(whole, out)
        if not noted:
            save_progress(project, results, submission.sources)
            note_attempt(out, whole, [step.id for step in chosen], datetime.now().astimezone())
            noted = True
        found = standings(project)
        page = try_student_page(out, kit.steps, say, own_progress(project, out, found))
        return CheckResult(kit, results, page, next_of(found))

    def first(results: Results) -> None:
        found = keep(results)
        if tell is not None:
            tell(found)

    try:
        return keep(_look_through(kit, submission, chosen, ahead, out, say, first, draws_large=tell is not None))
    except KeyboardInterrupt:
        if before is not None and not noted:  # the page of the other steps, which nobody has to check again
            try_student_page(out, kit.steps, say, own_progress(project, out, standings(project)))
        raise


def own_progress(project: Project, folder: Path, found: Sequence[StepProgress]) -> OwnProgress:
    """What the report of one's own steps in that folder shows beside their results."""
    changed = frozenset(standing.step.id for standing in found if standing.kind in _NEWER)
    return OwnProgress(read_attempts(folder), changed, next_of(found), project.has_reference)
