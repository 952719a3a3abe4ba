"""Grades one step of one submission, the hidden part too."""

import hashlib
from collections.abc import Collection
from pathlib import Path

from raysteps.common.files import write_bytes
from raysteps.course.manifest import Step
from raysteps.diagnosis.diagnose import Diagnostician
from raysteps.grading.build_messages import link_message
from raysteps.grading.images import ImageGrader, grade_integration, too_many_tests, trouble
from raysteps.grading.scoring import status_and_points
from raysteps.grading.step import GradingContext, Programs, StepGrader
from raysteps.images.compare import compare
from raysteps.images.render import reference_picture
from raysteps.judge.claims import contradictions
from raysteps.judge.counterexamples import Examples
from raysteps.judge.hidden_scenes import HiddenScene, hidden_scenes
from raysteps.judge.hidden_tests import run_hidden_tests
from raysteps.judge.plan import Plan, read_plan
from raysteps.judge.worker import ask_student, reference_answers, reference_unkept
from raysteps.results.model import HiddenResult, Integration, StepResult
from raysteps.results.settings import Settings
from raysteps.sandbox.task import TaskResult
from raysteps.toolchain.compile import Compiled, Program
from raysteps.toolchain.kit_artifacts import ProgressCallback
from raysteps.toolchain.limits import StepLimits

# The hidden part of a step: the judge's cases, and scenes that nobody has seen.


def ask_functions(
    gallery: ImageGrader, worker: Program, step: Step, plan: Plan, settings: Settings, say: ProgressCallback
) -> list[HiddenResult]:
    """All functions of a step."""
    student = ask_student(gallery.sandbox, worker, gallery.limits)

    def reference(cases: bytes, _seconds: float) -> TaskResult:
        return reference_answers(gallery.kit, cases)

    def unkept(cases: bytes, _seconds: float) -> TaskResult:
        return reference_unkept(gallery.kit, cases)

    shown = settings.feedback == "full"  # else the cases are withheld, and nobody needs a small one
    examples = Examples(student, unkept, gallery.out, say) if shown else None
    return run_hidden_tests(step, plan, student, reference, settings.seed, gallery.limits.seconds, examples)


def _judge_scene(gallery: ImageGrader, program: Program, scene: HiddenScene, folder: Path) -> HiddenResult:
    path = folder / f"{hashlib.sha256(scene.nff.encode()).hexdigest()[:16]}.nff"
    write_bytes(path, scene.nff.encode())
    reference = reference_picture(gallery.kit, path, scene.args)
    rendered = gallery.render(program, path, scene.args)
    result = HiddenResult(scene.name, "picture", 0.0, weight=scene.weight)
    result.seconds = round(rendered.ran.outcome.seconds, 2)
    if rendered.pixels is None:
        result.outcome, result.message = trouble(rendered)
        return result
    verdict = compare(rendered.pixels, reference, scene.max_wrong)
    problem = verdict.message
    if verdict.passed and scene.max_share is not None:
        problem = too_many_tests(rendered.share_tested, scene.max_share)
    result.wrong_share = round(verdict.wrong_share, 6)
    result.message, result.share = problem, 0.0 if problem else 1.0
    result.outcome = "wrong" if problem else "ok"
    return result


def render_scenes(
    gallery: ImageGrader, program: Program, step: Step, plan: Plan, seed: int, folder: Path
) -> list[HiddenResult]:
    """Scenes made for this seed. The file's name says nothing about what it is for."""
    scenes = hidden_scenes(gallery.kit.project, step, plan, seed)
    return [_judge_scene(gallery, program, scene, folder) for scene in scenes]


class HiddenStepGrader(StepGrader):
    """One step between steps of the reference."""

    def __init__(
        self, work: GradingContext, step: Step, limits: StepLimits, compiled: dict[str, Compiled], settings: Settings
    ) -> None:
        self._plan = read_plan(work.kit.project, step)
        super().__init__(work, step, limits, compiled, judged=self._plan is not None)
        self._settings = settings
        if self._plan is not None:
            self.kinds = ("test", "raytrace", "worker")

    def _judge(self, programs: Programs) -> None:
        if self._plan is None:
            return
        step, result, work, seed = self.step, self._result, self._work, self._settings.seed
        result.hidden = ask_functions(self._gallery, programs["worker"], step, self._plan, self._settings, work.say)
        folder = work.folder / step.number
        result.hidden += render_scenes(self._gallery, programs["raytrace"], step, self._plan, seed, folder)
        result.inconsistent = contradictions(step, self._plan, result, work.kit.tests[step.id])

    def _explain(self, programs: Programs) -> None:
        """In words why it is not right. Whatever a student's program says, it costs no grade."""
        worker = programs.get("worker")
        ask = ask_student(self._gallery.sandbox, worker, self._gallery.limits) if worker is not None else None
        doctor = Diagnostician(self._work.kit, self.step, self._plan, ask, self._work.say)
        try:
            self._result.diagnoses = doctor.diagnose(self._result, self._gallery.made, self._unfinished)
        except Exception as error:  # the kit's own trouble too: an explanation is not worth a grade
            self._work.say(f"no diagnosis of {self.step.number}: {error!r}")

    def finish(self, right: Collection[str]) -> StepResult:
        """After all steps were graded alone: does this one work with those before it that are right, by their ids?"""
        if self._ran:
            self._result.cumulative = self._together(right)
            self._result.status, self._result.points = status_and_points(self._result, self.step)
        return self._result

    def _together(self, right: Collection[str]) -> Integration:
        """A step that is not right is replaced by the reference's: its mistake costs its own step only."""
        step, work = self.step, self._work
        if not all(image.passed for image in self._result.images[:1]):
            return Integration(False, "This step itself is not right yet.")
        earlier = [other for other in work.kit.steps if other.index < step.index]
        replaced = [other.id for other in earlier if other.id not in right]
        mine = [self._compiled[other.id].binary for other in (*earlier, step) if other.id in right or other is step]
        objects = [path for path in mine if path is not None]
        objects += [work.kit.reference_step(other) for other in earlier if other.id in replaced]
        program, ran = self._build.program("raytrace", step, objects, self._limits, together=True)
        if ran is not None:
            self._expect_room()
            return Integration(False, f"The steps do not build together. {link_message(ran)}")
        assert program is not None
        own = [other for other in (*earlier, step) if other.id not in replaced]
        return grade_integration(self._gallery, program, step, own, replaced)
