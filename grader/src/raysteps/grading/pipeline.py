"""Grades one submission."""

import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step
from raysteps.grading.hidden import HiddenStepGrader
from raysteps.grading.scoring import is_right
from raysteps.grading.step import GradingContext, compile_steps
from raysteps.grading.withhold import withhold
from raysteps.results.model import Results, Timing
from raysteps.results.settings import Settings
from raysteps.results.store import write_results
from raysteps.sandbox.accounting import AccountingSandbox
from raysteps.sandbox.task import Sandbox
from raysteps.submission.load import Submission
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import limits_of


def _chosen(kit: BuiltKit, settings: Settings) -> list[Step]:
    return [step for step in kit.steps if not settings.only or step.id in settings.only]


def grade_submission(
    kit: BuiltKit,
    submission: Submission,
    settings: Settings,
    sandbox: Sandbox,
    out: Path,
    say: Callable[[str], None] = lambda text: None,
    *,
    jobs: int = 1,
) -> Results:
    """Writes out/results.json and out/pictures/. What goes wrong in a step costs that step only. So many `jobs` are
    done at a time; that changes a grade only where a step is near its time limit."""
    start = time.monotonic()
    counted = AccountingSandbox(sandbox)
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        work = GradingContext(kit, submission, counted, Path(folder), out, say)
        chosen = _chosen(kit, settings)
        with ThreadPoolExecutor(max_workers=max(1, jobs)) as pool:
            say("building the steps")
            compiled = compile_steps(work, chosen, pool, settings.limits)

            graders = [
                HiddenStepGrader(work, step, limits_of(step, settings.limits), compiled, settings) for step in chosen
            ]
            right = {result.id for result in pool.map(HiddenStepGrader.grade, graders) if is_right(result)}
            steps = list(pool.map(lambda grader: grader.finish(right), graders))
    timing = Timing(round(time.monotonic() - start, 2), round(counted.cpu_seconds, 2))
    results = Results.of(submission.name, steps, settings.seed, kit.fingerprint, counted.isolation, timing)
    try:
        write_results(withhold(results, settings.feedback), out)
    except OSError as error:
        raise GraderFault(f"{out}: the results cannot be written: {error}") from error
    return results
