"""Grades one step of one submission."""

import shutil
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.text import listed
from raysteps.diagnosis.diagnosing import Diagnostician
from raysteps.grading.build_messages import build_log, link_message, why_not_built
from raysteps.grading.hidden import ask_functions, render_scenes
from raysteps.grading.scoring import is_right, most_points, status_and_points, sum_up
from raysteps.grading.settings import Settings
from raysteps.grading.visible_images import Gallery, judge, judge_together
from raysteps.grading.visible_tests import run_tests
from raysteps.judge.consistency import contradictions
from raysteps.judge.plan import read_plan
from raysteps.kit.built_kit import BuiltKit, Kind, Say
from raysteps.kit.manifest import Step
from raysteps.kit.stubs import same_code, stub_for, unfinished_functions
from raysteps.programs.asking import ask_student
from raysteps.programs.limits import StepLimits
from raysteps.programs.student_build import Compiled, Program, StudentBuild
from raysteps.results.model import Cumulative, StepResult
from raysteps.sandbox.task import Sandbox
from raysteps.submission.intake import Submission

_LEAST_ROOM = 256 << 20  # bytes, more than a build can use


@dataclass(frozen=True)
class Work:
    """What is graded, with what, where it is built and where the results go."""

    kit: BuiltKit
    submission: Submission
    settings: Settings
    sandbox: Sandbox
    folder: Path
    out: Path
    say: Say = lambda text: None

    def source(self, step: Step) -> str | None:
        """The student's file, or None when there is none or its code is the stub's."""
        data = self.submission.sources.get(step.id)
        if data is None:
            return None
        text = data.decode("utf-8", "replace")
        return None if same_code(text, stub_for(self.kit.project, step)) else text


class StepGrader:
    """One step between steps of the reference."""

    def __init__(self, work: Work, step: Step, limits: StepLimits, compiled: dict[str, Compiled]) -> None:
        self._work = work
        self.step = step
        self._limits = limits
        self._compiled = compiled
        self._build = StudentBuild(work.kit, work.sandbox, work.folder)
        self._gallery = Gallery(work.kit, work.sandbox, limits, work.out)
        self._plan = read_plan(work.kit.project, step)
        most = most_points(step, judged=self._plan is not None)
        self._unfinished: list[str] = []
        self._result = StepResult(step.id, "not-started", 0.0, most, step.bonus)
        self._ran = False

    def grade(self) -> StepResult:
        """Between steps of the reference. What goes wrong in the student's code is a result; only the kit's own trouble
        is raised."""
        step, result = self.step, self._result
        source = self._work.source(step)
        if source is None:
            handed_in = step.id in self._work.submission.sources
            missing = f"{step.file} was not handed in."
            if handed_in:
                missing = f"{step.file} is still the stub. What to do stands in steps/{step.id}/README.md."
            result.messages = [self._work.submission.notes.get(step.id) or missing]
            result.cumulative = Cumulative(False, "This step was not started.")
            return result
        remark = self._work.submission.remarks.get(step.id)
        result.messages += [remark] if remark else []
        left = self._unfinished = unfinished_functions(source, step)
        if left:
            result.messages.append(f"RAYSTEPS_TODO is still in: {listed(left)}.")
        compiled = self._compiled[step.id]
        result.build_log = build_log(compiled.ran)
        if compiled.binary is None:
            self._expect_room()
            return self._does_not_build(why_not_built(self._work.kit, step, compiled, source))
        self._run(compiled.binary)
        return result

    def _expect_room(self) -> None:
        """A full disk is nobody's fault. The disk is asked, not the compiler, whose words a source can shape."""
        free = shutil.disk_usage(self._work.folder).free
        if free < _LEAST_ROOM:
            raise GraderFault(f"{self.step.id} was not built: {free >> 20} MB are left in {self._work.folder}")

    def _does_not_build(self, message: str) -> StepResult:
        self._result.status = "does-not-build"
        self._result.messages.append(message)
        self._result.cumulative = Cumulative(False, "This step does not build.")
        return self._result

    def _program(self, kind: Kind, binary: Path) -> Program | None:
        program, ran = self._build.program(kind, self.step, [binary], self._limits)
        if program is None and ran is not None:
            self._expect_room()
            self._result.build_log = (self._result.build_log + "\n" + build_log(ran)).strip()
            self._does_not_build(link_message(ran))
        return program

    def _run(self, binary: Path) -> None:
        step, result, work = self.step, self._result, self._work
        tests = self._program("test", binary)
        raytrace = self._program("raytrace", binary) if tests else None
        worker = self._program("worker", binary) if raytrace and self._plan else None
        if tests is None or raytrace is None or (self._plan and worker is None):
            return
        tags = work.kit.tests[step.id]
        result.tests = run_tests(work.sandbox, tests, list(tags), self._limits)
        if any(test.outcome == "timeout" for test in result.tests):
            self._gallery.hung()
        result.images = [judge(self._gallery, raytrace, step, case) for case in step.images]
        if self._plan is not None and worker is not None:
            seed = work.settings.seed
            result.hidden = ask_functions(self._gallery, worker, step, self._plan, work.settings, work.say)
            scenes = render_scenes(self._gallery, raytrace, step, self._plan, seed, work.folder / step.number)
            result.hidden += scenes
            result.inconsistent = contradictions(step, self._plan, result, tags)
        result.messages += sum_up(result)
        if not is_right(result):
            self._diagnose(worker)
        self._ran = True

    def _diagnose(self, worker: Program | None) -> None:
        """In words why it is not right. Whatever a student's program says, it costs no grade."""
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
