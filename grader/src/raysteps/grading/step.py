"""What grading a step at home and in a course have in common: it is built, and its visible tests are run."""

import shutil
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor, wait
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TypeVar

from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import usable_folder
from raysteps.course.manifest import Step
from raysteps.course.stubs import begun_source, unfinished_functions
from raysteps.grading.build_messages import link_message, why_not_built
from raysteps.grading.images import ImageGrader
from raysteps.grading.scoring import max_points, still_missing, test_weights
from raysteps.grading.unit_tests import not_written_yet, run_tests
from raysteps.results.model import Integration, StepResult
from raysteps.results.store import CASES_FOLDER, REPORT, RESULTS, case_path
from raysteps.sandbox.task import Sandbox
from raysteps.submission.load import Submission
from raysteps.toolchain.compile import (
    NOTHING_AHEAD,
    Compiled,
    CompiledAhead,
    KeptLibraries,
    Program,
    StudentBuild,
    build_log,
)
from raysteps.toolchain.kit_artifacts import BuiltKit, Kind, ProgressCallback
from raysteps.toolchain.limits import StepLimits

Programs = dict[Kind, Program]

# What a machine with more processors than there are steps to grade can do meanwhile: somebody waits for one step after
# a save.

_T = TypeVar("_T")


class SpareProcessors:
    """So many of them; `ends` ends what they were begun with."""

    def __init__(self, amount: int, ends: ExitStack) -> None:
        self._pool = ends.enter_context(ThreadPoolExecutor(amount)) if amount > 0 else None
        if self._pool is not None:
            ends.callback(self._pool.shutdown, wait=False, cancel_futures=True)

    def start(self, work: Callable[[], _T]) -> "Future[_T] | None":
        """None where no processor is spare. Whoever cannot wait cancels the future, and does the work itself."""
        return None if self._pool is None else self._pool.submit(work)


_LEAST_ROOM = 256 << 20  # bytes, more than a build can use


# Old results go first.


def clear_old_results(out: Path, steps: list[Step], asked_again: list[Step]) -> None:
    """Old results must not be taken for new ones. Only what a grader names so is deleted: the folder may be any. Cases
    stay for `replay` until their step is graded again."""
    usable_folder(out)
    try:
        for name in (RESULTS, REPORT):
            (out / name).unlink(missing_ok=True)
        for step in steps:
            folder = out / "pictures" / step.id
            if folder.is_symlink() or folder.parent.is_symlink() or not folder.is_dir():
                continue
            for kind in ("mine", "reference", "difference", "large"):
                for picture in folder.glob(f"*-{kind}.png"):
                    picture.unlink()
            if not any(folder.iterdir()):
                folder.rmdir()
        if not (out / CASES_FOLDER).is_symlink():
            for name in (case_path(step.number, function) for step in asked_again for function in step.functions):
                (out / name).unlink(missing_ok=True)
        for room in (out / "pictures", out / CASES_FOLDER):
            if room.is_dir() and not room.is_symlink() and not any(room.iterdir()):
                room.rmdir()
    except OSError as error:
        raise UsageError(f"{out}: old results cannot be removed: {reason(error)}") from error


@dataclass(frozen=True)
class GradingContext:
    """What is graded, where it is built and where the results go."""

    kit: BuiltKit
    submission: Submission
    sandbox: Sandbox
    folder: Path
    out: Path
    say: ProgressCallback = lambda text: None
    kept: KeptLibraries | None = None
    ahead: CompiledAhead = NOTHING_AHEAD

    def source(self, step: Step) -> str | None:
        """The student's file, or None when there is none or its code is the stub's."""
        return begun_source(self.kit.project, step, self.submission.sources.get(step.id))


class StepGrader:
    """What all who grade a step need: its programs, its visible tests, and the result that they fill in."""

    kinds: tuple[Kind, ...] = ("test", "raytrace")

    def __init__(
        self,
        context: GradingContext,
        step: Step,
        limits: StepLimits,
        compiled: dict[str, Compiled],
        spare: SpareProcessors,
        *,
        judged: bool = False,
    ) -> None:
        self._context = context
        self.step = step
        self._limits = limits
        self._compiled = compiled
        self._build = StudentBuild(context.kit, context.sandbox, context.folder)
        self._spare = spare
        self._image_grader = ImageGrader(context.kit, context.sandbox, limits, context.out)
        self._unfinished: list[str] = []
        self._result = StepResult(step.id, "not-started", 0.0, max_points(step, judged=judged), step.bonus)

    def programs(self) -> Programs | None:
        """All programs of the step. None where there is nothing to run, and the result says why: what goes wrong in
        the student's code is a result; only the kit's own trouble is raised."""
        step, result = self.step, self._result
        self._context.say(f"checking {step.id}")
        source = self._context.source(step)
        if source is None:
            handed_in = step.id in self._context.submission.sources
            missing = f"{step.file} was not handed in."
            if handed_in:
                missing = f"{step.file} is still the stub. What to do stands in steps/{step.id}/README.md."
            result.not_taken = self._context.submission.notes.get(step.id, "")
            result.messages = [result.not_taken or missing]
            why = "No file was taken for this step." if result.not_taken else "This step was not started."
            result.cumulative = Integration(False, why)
            return None
        remark = self._context.submission.remarks.get(step.id)
        result.messages += [remark] if remark else []
        self._unfinished = unfinished_functions(source, step)
        compiled = self._compiled[step.id]
        result.build_log = build_log(compiled.ran)
        if compiled.binary is None:
            self._expect_room()
            self._does_not_build(why_not_built(self._context.kit, step, compiled, source))
            return None
        programs: Programs = {}
        for kind in self.kinds:
            program = self._program(kind, compiled.binary)
            if program is None:
                return None
            programs[kind] = program
        return programs

    def _expect_room(self) -> None:
        """A full disk is nobody's fault. The disk is asked, not the compiler, whose words a source can shape."""
        free = shutil.disk_usage(self._context.folder).free
        if free < _LEAST_ROOM:
            raise GraderFault(f"{self.step.id} was not built: {free >> 20} MB are left in {self._context.folder}")

    def _does_not_build(self, message: str) -> None:
        self._result.status = "does-not-build"
        self._result.messages.append(message)
        if self._unfinished:
            self._result.messages.append(not_written_yet(self._unfinished))
        self._result.cumulative = Integration(False, "This step does not build.")

    def _program(self, kind: Kind, binary: Path) -> Program | None:
        """The step between steps of the reference."""
        return self._linked(kind, {self.step.number: binary}, together=False)

    def _linked(self, kind: Kind, binaries: dict[str, Path], *, together: bool) -> Program | None:
        program, ran = self._build.program(kind, self.step, binaries, self._limits, together=together)
        if program is None and ran is not None:
            self._expect_room()
            self._result.build_log = (self._result.build_log + "\n" + build_log(ran)).strip()
            self._does_not_build(link_message(ran))
        return program

    def _run_tests(self, program: Program) -> None:
        tests = self._context.kit.tests[self.step.id]

        def say(text: str) -> None:
            self._context.say(f"{self.step.id}: {text}")

        self._result.tests = run_tests(self._context.sandbox, program, tests, self._limits, say)
        self._weigh_tests()

    def _weigh_tests(self) -> None:
        """By what is known of the functions so far."""
        result, tests = self._result, self._context.kit.tests[self.step.id]
        passed = {test.name for test in result.tests if test.passed}
        weights = test_weights(self.step, tests, still_missing(self._unfinished, tests, passed, result.hidden))
        for test in result.tests:
            test.weight = weights[test.name]

    def _drawn_again(self, draw: Callable[[ImageGrader], _T], early: "Future[_T] | None") -> "Future[_T] | None":
        """Of pictures that were begun while the tests ran: they have less time where a test was stopped, so that they
        are drawn again, and no grade depends on what was first."""
        if not any(test.limit for test in self._result.tests):
            return early
        if early is not None and not early.cancel():
            wait([early])
        self._image_grader = replace(self._image_grader, limits=self._limits, made={})
        self._image_grader.record_stops(self._result.tests)
        return self._spare.start(partial(draw, self._image_grader))


# Compiles the steps of a submission, several at a time.


TURN = 0.5  # seconds; who waits without an end may not hear a Ctrl-C
_Asked = TypeVar("_Asked")
_Answer = TypeVar("_Answer")


def interruptible_map(pool: Executor, ask: Callable[[_Asked], _Answer], items: Sequence[_Asked]) -> list[_Answer]:
    """As `pool.map`, but waits in turns: a Ctrl-C that comes just before Python waits without an end, or that another
    thread takes, is not heard until it wakes up."""
    futures = [pool.submit(ask, item) for item in items]
    answers = []
    try:
        for future in futures:
            while not future.done():
                wait([future], TURN)
            answers.append(future.result())
    finally:
        for future in futures:
            future.cancel()
    return answers


def compile_steps(
    context: GradingContext, chosen: list[Step], pool: ThreadPoolExecutor, changes: Mapping[str, float]
) -> dict[str, Compiled]:
    """Each chosen step that was started."""
    sources = {step: context.source(step) for step in chosen}
    started = [(step, source) for step, source in sources.items() if source is not None]
    started.sort(key=lambda item: -len(item[1]))  # what takes longest first: it leaves nobody idle at the end

    def compile_one(item: tuple[Step, str]) -> Compiled:
        step, source = item
        if step.id in context.ahead.steps:
            return context.ahead.steps[step.id].result()
        build = StudentBuild(context.kit, context.sandbox, context.folder, context.kept)
        return build.compile(step, source.encode(), context.kit.limits_of(step, changes))

    compiled = interruptible_map(pool, compile_one, started)
    return {step.id: one for (step, _), one in zip(started, compiled, strict=True)}
