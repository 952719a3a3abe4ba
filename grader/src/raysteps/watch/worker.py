"""Does one job and ends: a process of its own can be stopped at any time, and its faults stop nobody else.

It waits for the job as a line of JSON on stdin, so that it can be started ahead of time, and tells what it sees as
lines of JSON on stdout. A job is {"kind": "look" or "check", "root": FOLDER, "step": ID}; a line is a WorkerLine.
"""

import contextlib
import json
import os
import signal
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path
from types import FrameType

from raysteps.common.errors import RaystepsError, reason, reason_and_place
from raysteps.common.platform import own_command, processor_count
from raysteps.common.process import end_what_runs
from raysteps.course.manifest import Step, chosen_step, earlier
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub, same_code
from raysteps.grading.build_messages import link_message, why_not_built
from raysteps.grading.images import ImageGrader, grade_image
from raysteps.grading.self_check import own_steps
from raysteps.grading.step import GradingContext, SpareProcessors, compile_steps
from raysteps.grading.unit_tests import mark_waiting, mark_waiting_pictures, run_tests
from raysteps.images.compare import write_png
from raysteps.images.render import shown_reference
from raysteps.progress import own_check  # noqa: F401 - ahead of time
from raysteps.progress.check import check_steps
from raysteps.progress.standing import misplaced, own_source
from raysteps.results.model import ImageResult, StepResult
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Sandbox
from raysteps.submission.entries import RejectedFile
from raysteps.submission.load import load_submission
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.compile import Program, StudentBuild, build_log, own_libraries
from raysteps.toolchain.kit_artifacts import BuiltKit, Kind, ProgressCallback
from raysteps.watch.events import WorkerLine

# What can be told of a step within a second or two: whether it builds, its visible tests and its pictures.

ReportCallback = Callable[[StepResult], None]


@dataclass(frozen=True)
class QuickLook:
    """One step between steps of the reference, in a students' kit between the student's own; without the judge. `tell`
    hears of each part when it is done, and `say` of waits."""

    kit: BuiltKit
    step: Step
    sandbox: Sandbox
    out: Path
    tell: ReportCallback = lambda result: None
    say: ProgressCallback = lambda text: None

    def look(self, source: str) -> StepResult:
        """No points: they are for a check to say."""
        result = StepResult(self.step.id, "failed", 0.0, self.step.points, self.step.bonus)
        if same_code(source, pristine_stub(self.kit.project, self.step)):
            return self._not_started(result)
        with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
            build = StudentBuild(self.kit, self.sandbox, Path(folder), own_libraries(self.kit))
            compiled = build.compile(self.step, source.encode(), self.kit.limits_of(self.step))
            result.build_log = build_log(compiled.ran)
            if compiled.binary is None:
                return _does_not_build(result, why_not_built(self.kit, self.step, compiled, source))
            return self._run(build, compiled.binary, result, Path(folder), source)

    def _not_started(self, result: StepResult) -> StepResult:
        """The reference's pictures are shown all the same: that is where it goes."""
        result.status = "not-started"
        result.messages = [f"{self.step.file} is still the stub. What to do stands in steps/{self.step.id}/README.md."]
        for case in self.step.images:
            image = ImageResult(case.name, case.scene, False, case.max_wrong)
            image.reference = (Path("pictures") / self.step.id / f"{case.name}-reference.png").as_posix()
            pixels = shown_reference(self.kit, self.kit.project.root / case.scene, case)
            write_png(pixels, self.out / image.reference)
            result.images.append(image)
        return result

    def _around(self, binary: Path, folder: Path) -> dict[str, Path]:
        """In a students' kit the student's own steps stand before this one."""
        if self.kit.has_reference:
            return {self.step.number: binary}
        own_files = load_submission(self.kit.project.steps, self.kit.steps)
        kept = own_libraries(self.kit)
        context = GradingContext(self.kit, own_files, self.sandbox, folder, self.out, kept=kept)
        with ThreadPoolExecutor() as pool:
            before = earlier(self.step, self.kit.steps)
            own = own_steps(context, self.step, compile_steps(context, before, pool, {}))
            return own | {self.step.number: binary}

    def _run(self, build: StudentBuild, binary: Path, result: StepResult, folder: Path, source: str) -> StepResult:
        limits = self.kit.limits_of(self.step)
        binaries, alone = self._around(binary, folder), self.kit.has_reference

        def program(kind: Kind) -> Program | None:
            found, ran = build.program(kind, self.step, binaries, limits, together=not alone)
            if found is None and ran is not None:
                result.build_log = (result.build_log + "\n" + build_log(ran)).strip()
                _does_not_build(result, link_message(ran))
            return found

        tests, raytrace = program("test"), program("raytrace")
        if tests is None or raytrace is None:
            return result
        gallery = ImageGrader(self.kit, self.sandbox, limits, self.out)
        self.tell(result)
        with ExitStack() as ends:
            spare = SpareProcessors(processor_count() - 1, ends)
            draws = [partial(grade_image, gallery, raytrace, self.step, case) for case in self.step.images]
            drawn = [(draw, spare.start(draw)) for draw in draws]
            result.tests = run_tests(self.sandbox, tests, self.kit.tests[self.step.id], limits, self.say)
            gallery.record_stops(result.tests)
            waiting = mark_waiting(result, self.step, self.kit.tests[self.step.id], source)
            self.tell(result)
            for draw, begun in drawn:
                result.images.append(draw() if begun is None else begun.result())
                mark_waiting_pictures(result.images[-1:], waiting)
                self.tell(result)
        passed = [item.passed for items in (result.tests, result.images) for item in items]
        result.status = "passed" if all(passed) else "partial" if any(passed) else "failed"
        return result


def _does_not_build(result: StepResult, message: str) -> StepResult:
    result.status = "does-not-build"
    result.messages = [message]
    return result


_UNHURRIED = 5  # of `nice`: a check goes on while its student types


def _tell(line: WorkerLine) -> None:
    print(json.dumps(asdict(line)), flush=True)


def _say(text: str) -> None:
    _tell(WorkerLine(say=text))


def look(project: Project, name: str) -> None:
    """The visible part, told bit by bit."""
    kit = build_kit(project, _say).in_one_process()
    step = chosen_step(project, name)
    out = project.build / "watch"

    def tell(result: StepResult, *, complete: bool = False) -> None:
        _tell(WorkerLine(result=result, out=str(out), complete=complete))

    try:
        source = own_source(project, step)
    except (OSError, RejectedFile) as error:
        _tell(WorkerLine(error=f"{step.file}: {reason(error)}"))
        return
    if source is None:
        there = f"{step.file} is not there; {own_command()} reset {step.number} puts the stub there"
        _tell(WorkerLine(error=misplaced(project, [step]).get(step.id) or there))
        return
    tell(QuickLook(kit, step, LimitsOnly(), out, tell, _say).look(source.decode("utf-8", "replace")), complete=True)


def check(project: Project, name: str) -> None:
    """All of it, as `./raysteps check` does."""
    with contextlib.suppress(AttributeError, OSError):
        os.nice(_UNHURRIED)
    chosen = [chosen_step(project, name)]
    (result,) = check_steps(project, chosen, _say).results.steps
    _tell(WorkerLine(result=result, out=str(project.build / "check"), complete=True))


def _stop(number: int, _frame: FrameType | None) -> None:
    """Also CMake and the compiler: the next worker may build in the same folder."""
    end_what_runs()
    os._exit(128 + number)


def main() -> int:
    line = sys.stdin.readline()
    if not line:
        return 0  # whoever wanted it has gone
    signal.signal(signal.SIGTERM, _stop)
    job = json.loads(line)
    try:
        {"look": look, "check": check}[job["kind"]](Project(Path(job["root"])), job["step"])
    except (RaystepsError, OSError) as error:
        _tell(WorkerLine(error=reason_and_place(error)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
