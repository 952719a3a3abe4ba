"""Grades one step of one submission, the hidden part too."""

from collections.abc import Collection

from raysteps.diagnosis.diagnosing import Diagnostician
from raysteps.grading.build_messages import link_message
from raysteps.grading.hidden import ask_functions, render_scenes
from raysteps.grading.scoring import status_and_points
from raysteps.grading.settings import Settings
from raysteps.grading.step_grader import Programs, StepGrader, Work
from raysteps.grading.visible_images import judge_together
from raysteps.judge.consistency import contradictions
from raysteps.judge.plan import read_plan
from raysteps.kit.manifest import Step
from raysteps.programs.asking import ask_student
from raysteps.programs.limits import StepLimits
from raysteps.programs.student_build import Compiled
from raysteps.results.model import Cumulative, StepResult


class JudgedGrader(StepGrader):
    """One step between steps of the reference."""

    def __init__(
        self, work: Work, step: Step, limits: StepLimits, compiled: dict[str, Compiled], settings: Settings
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

    def _together(self, right: Collection[str]) -> Cumulative:
        """A step that is not right is replaced by the reference's: its mistake costs its own step only."""
        step, work = self.step, self._work
        if not all(image.passed for image in self._result.images[:1]):
            return Cumulative(False, "This step itself is not right yet.")
        earlier = [other for other in work.kit.steps if other.index < step.index]
        replaced = [other.id for other in earlier if other.id not in right]
        mine = [self._compiled[other.id].binary for other in (*earlier, step) if other.id in right or other is step]
        objects = [path for path in mine if path is not None]
        objects += [work.kit.reference_step(other) for other in earlier if other.id in replaced]
        program, ran = self._build.program("raytrace", step, objects, self._limits, together=True)
        if ran is not None:
            self._expect_room()
            return Cumulative(False, f"The steps do not build together. {link_message(ran)}")
        assert program is not None
        own = [other for other in (*earlier, step) if other.id not in replaced]
        return judge_together(self._gallery, program, step, own, replaced)
