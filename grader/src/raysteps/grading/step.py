"""The visible part of one step: it is built, its tests are run, its pictures made and compared."""

import shutil
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.text import join_and
from raysteps.course.manifest import Step
from raysteps.course.stubs import pristine_stub, same_code, unfinished_functions
from raysteps.grading.build_messages import build_log, link_message, why_not_built
from raysteps.grading.images import ImageGrader, judge
from raysteps.grading.scoring import is_right, max_points, sum_up
from raysteps.grading.unit_tests import run_tests
from raysteps.results.model import Integration, StepResult
from raysteps.sandbox.task import Sandbox
from raysteps.submission.load import Submission
from raysteps.toolchain.compile import Compiled, Program, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit, Kind, ProgressCallback
from raysteps.toolchain.limits import StepLimits, limits_of

Programs = dict[Kind, Program]

_LEAST_ROOM = 256 << 20  # bytes, more than a build can use


@dataclass(frozen=True)
class GradingContext:
    """What is graded, where it is built and where the results go."""

    kit: BuiltKit
    submission: Submission
    sandbox: Sandbox
    folder: Path
    out: Path
    say: ProgressCallback = lambda text: None

    def source(self, step: Step) -> str | None:
        """The student's file, or None when there is none or its code is the stub's."""
        data = self.submission.sources.get(step.id)
        if data is None:
            return None
        text = data.decode("utf-8", "replace")
        return None if same_code(text, pristine_stub(self.kit.project, step)) else text


class StepGrader:
    """One step. Those who know more of it than everybody may see add to it."""

    kinds: tuple[Kind, ...] = ("test", "raytrace")

    def __init__(
        self,
        work: GradingContext,
        step: Step,
        limits: StepLimits,
        compiled: dict[str, Compiled],
        *,
        judged: bool = False,
    ) -> None:
        self._work = work
        self.step = step
        self._limits = limits
        self._compiled = compiled
        self._build = StudentBuild(work.kit, work.sandbox, work.folder)
        self._gallery = ImageGrader(work.kit, work.sandbox, limits, work.out)
        self._unfinished: list[str] = []
        self._result = StepResult(step.id, "not-started", 0.0, max_points(step, judged=judged), step.bonus)
        self._ran = False

    def grade(self) -> StepResult:
        """What goes wrong in the student's code is a result; only the kit's own trouble is raised."""
        step, result = self.step, self._result
        self._work.say(f"checking {step.id}")
        source = self._work.source(step)
        if source is None:
            handed_in = step.id in self._work.submission.sources
            missing = f"{step.file} was not handed in."
            if handed_in:
                missing = f"{step.file} is still the stub. What to do stands in steps/{step.id}/README.md."
            result.messages = [self._work.submission.notes.get(step.id) or missing]
            result.cumulative = Integration(False, "This step was not started.")
            return result
        remark = self._work.submission.remarks.get(step.id)
        result.messages += [remark] if remark else []
        left = self._unfinished = unfinished_functions(source, step)
        if left:
            result.messages.append(f"RAYSTEPS_TODO is still in: {join_and(left)}.")
        compiled = self._compiled[step.id]
        result.build_log = build_log(compiled.ran)
        if compiled.binary is None:
            self._expect_room()
            return self._does_not_build(why_not_built(self._work.kit, step, compiled, source))
        programs = self._programs(compiled.binary)
        if programs is not None:
            self._run(programs)
        return result

    def _expect_room(self) -> None:
        """A full disk is nobody's fault. The disk is asked, not the compiler, whose words a source can shape."""
        free = shutil.disk_usage(self._work.folder).free
        if free < _LEAST_ROOM:
            raise GraderFault(f"{self.step.id} was not built: {free >> 20} MB are left in {self._work.folder}")

    def _does_not_build(self, message: str) -> StepResult:
        self._result.status = "does-not-build"
        self._result.messages.append(message)
        self._result.cumulative = Integration(False, "This step does not build.")
        return self._result

    def _program(self, kind: Kind, binary: Path) -> Program | None:
        """The step between steps of the reference."""
        return self._linked(kind, [binary], together=False)

    def _linked(self, kind: Kind, binaries: list[Path], *, together: bool) -> Program | None:
        program, ran = self._build.program(kind, self.step, binaries, self._limits, together=together)
        if program is None and ran is not None:
            self._expect_room()
            self._result.build_log = (self._result.build_log + "\n" + build_log(ran)).strip()
            self._does_not_build(link_message(ran))
        return program

    def _programs(self, binary: Path) -> Programs | None:
        """All of them, or none when one does not build."""
        programs: Programs = {}
        for kind in self.kinds:
            program = self._program(kind, binary)
            if program is None:
                return None
            programs[kind] = program
        return programs

    def _run(self, programs: Programs) -> None:
        step, result, work = self.step, self._result, self._work
        result.tests = run_tests(work.sandbox, programs["test"], list(work.kit.tests[step.id]), self._limits)
        if any(test.outcome == "timeout" for test in result.tests):
            self._gallery.hung()
        result.images = [judge(self._gallery, programs["raytrace"], step, case) for case in step.images]
        self._judge(programs)
        result.messages += sum_up(result)
        if not is_right(result):
            self._explain(programs)
        self._ran = True

    def _judge(self, programs: Programs) -> None:
        """What is hidden, where there is somebody to judge it."""

    def _explain(self, programs: Programs) -> None:
        """Why it is not right."""


# Compiles the steps of a submission, several at a time.


def compile_steps(
    work: GradingContext, chosen: list[Step], pool: ThreadPoolExecutor, changes: Mapping[str, float]
) -> dict[str, Compiled]:
    """Each chosen step that was started."""
    sources = {step: work.source(step) for step in chosen}
    started = [(step, source) for step, source in sources.items() if source is not None]

    def compile_one(item: tuple[Step, str]) -> Compiled:
        step, source = item
        build = StudentBuild(work.kit, work.sandbox, work.folder)
        return build.compile(step, source.encode(), limits_of(step, changes))

    return {step.id: compiled for (step, _), compiled in zip(started, pool.map(compile_one, started), strict=True)}
