"""Grades the steps of one set of sources. What goes wrong in a step costs that step only."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.text import count, listed
from raysteps.grading.rendering import ReferencePictures
from raysteps.grading.results import Cumulative, Results, Status, StepResult
from raysteps.grading.visible_images import Gallery, judge, judge_together
from raysteps.grading.visible_tests import expected_cases, run_tests
from raysteps.kit.building import BuildTree, first_error, is_fault_of_machine, is_fault_of_step, what_failed
from raysteps.kit.manifest import Step
from raysteps.kit.stubs import same_code, stub_for, unfinished_functions

_BUILD_STEP_SECONDS = 300


@dataclass(frozen=True)
class Job:
    """What is to be graded, with what, and where the pictures go."""

    name: str
    tree: BuildTree
    all_steps: list[Step]
    chosen: list[Step]
    out: Path
    notes: Mapping[str, str]
    say: Callable[[str], None]


def _targets(step: Step) -> list[str]:
    return [f"test-isolated-{step.number}", f"raytrace-isolated-{step.number}"]


def _together_target(step: Step) -> str:
    return f"raytrace-cumulative-{step.number}"


def source_of(job: Job, step: Step) -> str | None:
    """The student's file, or None when there is none or its code is the stub's."""
    path = job.tree.mine / step.path
    if not path.is_file():
        return None
    source = path.read_text(encoding="utf-8", errors="replace")
    return None if same_code(source, stub_for(job.tree.project, step)) else source


def _status_and_points(result: StepResult, step: Step) -> tuple[Status, float]:
    def share(passed: list[bool]) -> float:
        return sum(passed) / len(passed) if passed else 0.0

    tests, images = [test.passed for test in result.tests], [image.passed for image in result.images]
    points = step.points * (step.weight_tests * share(tests) + step.weight_images * share(images))
    outcomes = {test.outcome for test in result.tests} | {image.outcome for image in result.images}
    if all(tests) and all(images):
        return "passed", step.points
    if "crashed" in outcomes:
        return "crashed", round(points, 2)
    if "timeout" in outcomes:
        return "timeout", round(points, 2)
    return ("partial" if points > 0 else "failed"), round(points, 2)


def _sum_up(result: StepResult) -> list[str]:
    messages = []
    failed = [test for test in result.tests if not test.passed]
    if failed:
        messages.append(f"{len(failed)} of {count(len(result.tests), 'test')} failed.")
    wrong = [image for image in result.images if not image.passed]
    if wrong:
        messages.append(f"{len(wrong)} of {count(len(result.images), 'picture')} did not pass.")
    outcomes = [(item.outcome, item.message) for item in result.tests]
    outcomes += [(item.outcome, item.message) for item in result.images]
    bad = [message for outcome, message in outcomes if outcome in ("crashed", "timeout")]
    return messages + bad[:1]


class Grader:
    """Grades one job; the kit's own programs are built before the student's."""

    def __init__(self, job: Job) -> None:
        self._job = job
        self._gallery: Gallery | None = None

    def grade(self) -> Results:
        """All chosen steps. The caller holds the lock of the build folder."""
        self._build_reference()
        self._build_ahead([step for step in self._job.chosen if source_of(self._job, step) is not None])
        return Results(self._job.name, [self._grade_step(step) for step in self._job.chosen])

    def _unstarted_before(self, step: Step) -> list[str]:
        earlier = [other for other in self._job.all_steps if other.index < step.index]
        return [other.id for other in earlier if source_of(self._job, other) is None]

    def _build_reference(self) -> None:
        job = self._job
        job.say("building the reference and the tests")
        targets = ["raytrace-reference", *(f"test-reference-{step.number}" for step in job.chosen)]
        outcome = job.tree.build(targets)
        if outcome.code != 0:
            raise GraderFault("the kit's own programs do not build:\n" + what_failed(outcome))
        program = job.tree.program("raytrace-reference")
        pictures = ReferencePictures(job.tree.project, program, job.tree.project.build / "grade" / "reference")
        self._gallery = Gallery(job.tree.project, pictures, job.out)

    def _build_ahead(self, steps: list[Step]) -> None:
        """Builds what builds, all at once; what does not is built again, alone, for its message."""
        if steps:
            self._job.say(f"building {listed([step.id for step in steps])}")
            targets = [target for step in steps for target in _targets(step)]
            targets += [_together_target(step) for step in steps if not self._unstarted_before(step)]
            self._job.tree.build(targets, keep_going=True, seconds=_BUILD_STEP_SECONDS)

    def _grade_step(self, step: Step) -> StepResult:
        job = self._job
        result = StepResult(step.id, "not-started", 0.0, step.points, step.bonus)
        source = source_of(job, step)
        if source is None:
            result.messages = [job.notes.get(step.id) or f"{step.file} is still the stub."]
            result.cumulative = Cumulative(False, "This step was not started.")
            return result
        job.say(f"checking {step.id}")
        left = unfinished_functions(source, step)
        if left:
            result.messages.append(f"RAYSTEPS_TODO is still in: {listed(left)}.")
        built = job.tree.build(_targets(step), keep_going=True, seconds=_BUILD_STEP_SECONDS)
        if built.code != 0:
            if not is_fault_of_step(built, job.tree.mine / step.path, _targets(step)):
                raise GraderFault(f"{step.id} was not built, and its source is not the reason:\n{what_failed(built)}")
            result.status = "does-not-build"
            error = first_error(built.stdout + built.stderr, job.tree.mine)
            why = "The compiler took too long" if built.timed_out else "It does not build"
            result.messages.append(f"{why}: {error}" if error else f"{why}.")
            result.cumulative = Cumulative(False, "This step does not build.")
            return result
        self._run_step(step, result)
        return result

    def _run_step(self, step: Step, result: StepResult) -> None:
        job = self._job
        assert self._gallery is not None
        names = expected_cases(job.tree.program(f"test-reference-{step.number}"))
        result.tests = run_tests(job.tree.program(f"test-isolated-{step.number}"), names, step.seconds, step.memory_mb)
        program = job.tree.program(f"raytrace-isolated-{step.number}")
        result.images = [judge(self._gallery, program, step, case) for case in step.images]
        result.status, result.points = _status_and_points(result, step)
        result.messages += _sum_up(result)
        result.cumulative = self._together(step)

    def _together(self, step: Step) -> Cumulative:
        job = self._job
        assert self._gallery is not None
        missing = self._unstarted_before(step)
        if missing:
            return Cumulative(False, f"Not started yet: {listed(missing)}.")
        target = _together_target(step)
        built = job.tree.build([target], seconds=_BUILD_STEP_SECONDS)
        if built.code != 0:
            if is_fault_of_machine(built):
                raise GraderFault(f"{target} was not built:\n{what_failed(built)}")
            error = first_error(built.stdout + built.stderr, job.tree.mine)
            return Cumulative(False, f"The steps do not build together: {error}" if error else "They do not build.")
        return judge_together(self._gallery, job.tree.program(target), step)
