"""Checks a student's own steps. Whoever saved a file waits for this, so the compiler works while Python still imports
what grades, which takes a third of a second."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from raysteps.common.files import file_lock, usable_folder
from raysteps.common.platform import processor_count
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import begun_source
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import AccountingSandbox
from raysteps.submission.load import Submission, load_submission
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.compile import CompiledAhead, StudentBuild, own_libraries
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback

if TYPE_CHECKING:
    from raysteps.progress.own_check import CheckResult


def _compiled_ahead(kit: BuiltKit, submission: Submission, chosen: list[Step], ends: ExitStack) -> CompiledAhead:
    """Starts the compiler for the chosen steps that were begun."""
    folder = ends.enter_context(tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True))
    pool = ends.enter_context(ThreadPoolExecutor(processor_count()))
    ends.callback(pool.shutdown, wait=False, cancel_futures=True)
    sandbox = AccountingSandbox(LimitsOnly())
    ends.enter_context(sandbox.until_interrupted())
    build = StudentBuild(kit, sandbox, Path(folder), None if kit.has_reference else own_libraries(kit))
    sources = {step: begun_source(kit.project, step, submission.sources.get(step.id)) for step in chosen}
    begun = {
        step.id: pool.submit(build.compile, step, source.encode(), kit.limits_of(step))
        for step, source in sorted(sources.items(), key=lambda item: -len(item[1] or ""))
        if source is not None
    }
    return CompiledAhead(begun, sandbox)


def check_steps(
    project: Project, chosen: list[Step], say: ProgressCallback, tell: Callable[[CheckResult], None] | None = None
) -> CheckResult:
    """The chosen steps of those in the repository. In build/check they take the place of what was there of them, and
    the other steps stay. Your own code needs no sandbox. `tell` gets what is found, and what is kept of it, at once,
    where mistakes must be learned before they can be named, or larger pictures are still to be drawn."""
    with ExitStack() as ends:
        lock = project.build / "check.lock"
        ends.enter_context(file_lock(lock, lambda: say("waiting for another command, which checks here")))
        kit = build_kit(project, say).in_one_process()
        usable_folder(project.build / "check")
        submission = load_submission(project.steps, kit.steps)
        ahead = _compiled_ahead(kit, submission, chosen, ends)
        from raysteps.progress.own_check import check_and_keep

        return check_and_keep(kit, submission, chosen, ahead, say, tell)
