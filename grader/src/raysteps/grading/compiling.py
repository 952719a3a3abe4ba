"""Compiles the steps of a submission, several at a time."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor

from raysteps.grading.step_grader import Work
from raysteps.kit.manifest import Step
from raysteps.programs.limits import limits_of
from raysteps.programs.student_build import Compiled, StudentBuild


def compile_steps(
    work: Work, chosen: list[Step], pool: ThreadPoolExecutor, changes: Mapping[str, float]
) -> dict[str, Compiled]:
    """Each chosen step that was started."""
    sources = {step: work.source(step) for step in chosen}
    started = [(step, source) for step, source in sources.items() if source is not None]

    def compile_one(item: tuple[Step, str]) -> Compiled:
        step, source = item
        build = StudentBuild(work.kit, work.sandbox, work.folder)
        return build.compile(step, source.encode(), limits_of(step, changes))

    return {step.id: compiled for (step, _), compiled in zip(started, pool.map(compile_one, started), strict=True)}
