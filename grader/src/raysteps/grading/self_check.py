"""Checks steps in a students' kit: visible tests and pictures, with the student's own steps before each."""

import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, suppress
from dataclasses import replace
from functools import partial
from pathlib import Path

from raysteps.common.errors import RaystepsError
from raysteps.common.platform import processor_count
from raysteps.common.text import join_and
from raysteps.course.manifest import Step, earlier
from raysteps.grading.images import ImageGrader, grade_image
from raysteps.grading.scoring import is_right, status_and_points, sum_up
from raysteps.grading.step import GradingContext, SpareProcessors, StepGrader, compile_steps, interruptible_map
from raysteps.grading.unit_tests import has_crashed, has_hung, mark_waiting, tell_crash_line
from raysteps.images.compare import write_png
from raysteps.images.render import reference_image_path, render
from raysteps.results.model import ImageResult, Integration, Results, StepResult, Timing
from raysteps.sandbox.task import AccountingSandbox, Sandbox
from raysteps.submission.load import Submission
from raysteps.toolchain.compile import NOTHING_AHEAD, Compiled, CompiledAhead, Program, StudentBuild, own_libraries
from raysteps.toolchain.kit_artifacts import BuiltKit, Kind, ProgressCallback

# One step between the student's own steps: a students' kit has no reference to put around it.


def own_steps(context: GradingContext, step: Step, compiled: dict[str, Compiled]) -> dict[str, Path]:
    """By number, the student's steps before this one that build; the kit's stub stands in for the others."""
    before = [other for other in earlier(step, context.kit.steps) if other.id in compiled]
    binaries = {other.number: compiled[other.id].binary for other in before}
    return {number: binary for number, binary in binaries.items() if binary is not None}


_LARGER = 3  # times as wide and as high
_LARGE_SECONDS = 5.0  # of all large pictures together, on the clock: nobody waits for them


class SelfCheckGrader(StepGrader):
    """What a student can be told at home."""

    _raytrace: Program | None = None

    def _program(self, kind: Kind, binary: Path) -> Program | None:
        own = own_steps(self._context, self.step, self._compiled) | {self.step.number: binary}
        return self._linked(kind, own, together=True)

    def check(self) -> StepResult:
        """The visible part, with its points. The pictures are made with the student's own steps already."""
        result, programs = self._result, self.programs()
        if programs is not None:
            self._raytrace = programs["raytrace"]
            draw = partial(self._draw, programs["raytrace"])
            early = self._spare.start(partial(draw, self._image_grader))
            self._run_tests(programs["test"])
            early = self._drawn_again(draw, early)
            result.images = draw(self._image_grader) if early is None or early.cancel() else early.result()
            source = self._context.source(self.step) or ""
            mark_waiting(result, self.step, self._context.kit.tests[self.step.id], source)
            result.messages += sum_up(result)
            result.cumulative = Integration(all(image.passed for image in result.images[:1]))
            result.status, result.points = status_and_points(result, self.step)
        return result

    def _draw(self, program: Program, image_grader: ImageGrader) -> list[ImageResult]:
        return [grade_image(image_grader, program, self.step, case) for case in self.step.images]

    @property
    def has_picture(self) -> bool:
        return any(image.mine for image in self._result.images[:1])

    @property
    def step_is_right(self) -> bool:
        return is_right(self._result)

    def draw_large(self, seconds: float) -> None:
        """The step's first picture again, larger than the one that is compared: to be looked at. What does not come out
        in time is left out."""
        case, image = self.step.images[0], self._result.images[0] if self._result.images else None
        if self._raytrace is None or image is None or not image.mine or "--size" not in case.args:
            return
        args = list(self._image_grader.args_of(case))
        at = args.index("--size") + 1
        args[at] = "x".join(str(_LARGER * int(side)) for side in args[at].split("x"))
        limits = replace(self._context.kit.limits_of(self.step).of_program(), wall_seconds=seconds)
        drawn = render(
            self._context.sandbox, self._raytrace, self._context.kit.project.root / case.scene, tuple(args), limits
        )
        if drawn.pixels is not None:
            large = image.mine.replace("-mine.png", "-large.png")
            write_png(drawn.pixels, self._context.out / large)
            image.large = large


def _draw_large(graders: Sequence[SelfCheckGrader], say: ProgressCallback) -> None:
    """What is wrong first, then from the last step back, as long as there is time and nobody interrupts: the points are
    told already."""
    graders = [grader for grader in graders if grader.has_picture]
    if graders:
        say("drawing larger pictures for the report")
    end = time.monotonic() + _LARGE_SECONDS
    with suppress(KeyboardInterrupt):
        for grader in sorted(graders, key=lambda grader: (grader.step_is_right, -grader.step.index)):
            left = end - time.monotonic()
            if left > 0:
                grader.draw_large(left)


def name_crash(
    kit: BuiltKit, submission: Submission, sandbox: Sandbox, say: ProgressCallback, found: Sequence[StepResult]
) -> None:
    """The first test in which the student's own code crashed, or else hung, is run once more with sanitizers, and its
    message names the line where they can. What they cost, only who crashes pays; what goes wrong here changes nothing.
    """
    tests = {result.id: [*filter(has_crashed, result.tests), *filter(has_hung, result.tests)] for result in found}
    step = next((step for step in kit.steps if tests.get(step.id)), None)
    if step is None or sys.platform == "win32":
        return
    say(f"{step.id} {'crashed' if has_crashed(tests[step.id][0]) else 'did not end'}: looking for the line")
    alone, limits = kit.has_reference, kit.limits_of(step)
    test, result = tests[step.id][0], next(result for result in found if result.id == step.id)
    with suppress(RaystepsError, OSError), tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        counted = AccountingSandbox(sandbox)
        context = GradingContext(kit.sanitized(), submission, counted, Path(folder), Path(folder))
        sources = [*([] if alone else earlier(step, kit.steps)), step]
        with ThreadPoolExecutor(processor_count()) as pool, counted.until_interrupted():
            compiled = compile_steps(context, sources, pool, {})
        binary = compiled[step.id].binary
        if binary is None:
            return
        binaries = own_steps(context, step, compiled) | {step.number: binary}
        build = StudentBuild(context.kit, sandbox, context.folder)
        program, _ = build.program("test", step, binaries, limits, together=not alone)
        files, said = [Path(other.path).name for other in sources], test.message
        if program is not None and tell_crash_line(sandbox, program, test, limits, files):
            result.messages = [test.message if message == said else message for message in result.messages]


_TROUBLE = {
    "not-started": "is not started: its stub does nothing, and that shows here too",
    "does-not-build": "does not build: its stub stands in for it here, and that shows",
}


def blame(context: GradingContext, step: Step, found: Mapping[str, StepResult]) -> list[str]:
    """Earlier steps that are not right, and the pictures to compare with. Trees show in their own pictures only."""
    before = [other for other in earlier(step, context.kit.steps) if not other.is_about_a_tree]
    wrong = [other for other in before if not is_right(found[other.id])]
    if not wrong:
        return []
    first, *others = wrong
    lines = [
        f"Step {first.number} {_TROUBLE.get(found[first.id].status, 'is not right yet: its mistakes show here too')}."
    ]
    if others:
        named = join_and([other.number for other in others])
        lines.append(f"Not right either, perhaps only because of it: {named}. Mend {first.number} first.")
    root = context.kit.project.root
    pictures = [
        reference_image_path(context.kit.project, step, case).relative_to(root).as_posix() for case in step.images
    ]
    lines.append(f"Compare with the reference's picture{'s' if len(pictures) > 1 else ''}: {join_and(pictures)}.")
    return lines


def _check(
    context: GradingContext, counted: AccountingSandbox, steps: Sequence[Step], jobs: int, chosen: Sequence[Step]
) -> tuple[dict[str, StepResult], list[SelfCheckGrader]]:
    """The chosen steps, and what checked them; the others only where something is wrong that they may have caused, and
    out of sight."""
    found: dict[str, StepResult] = {}
    graders: list[SelfCheckGrader] = []
    with (
        ExitStack() as ends,
        ThreadPoolExecutor(max_workers=max(1, jobs)) as pool,
        counted.until_interrupted(),
        context.ahead.until_interrupted(),
    ):
        context.say("building the steps")
        compiled = compile_steps(context, list(steps), pool, {})

        def check(step: Step, spare: SpareProcessors) -> StepResult:
            unseen = replace(context, out=context.folder / "unseen", say=lambda text: None)
            here = context if step in chosen else unseen
            grader = SelfCheckGrader(here, step, context.kit.limits_of(step), compiled, spare)
            if step in chosen:
                graders.append(grader)
            return grader.check()

        spare, none = (SpareProcessors(amount, ends) for amount in (jobs - len(chosen), 0))
        answers = interruptible_map(pool, partial(check, spare=spare), chosen)
        found.update(zip([step.id for step in chosen], answers, strict=True))
        wrong = [step for step in chosen if found[step.id].tests and not is_right(found[step.id])]
        rest = [step for step in steps if step.id not in found and any(step.index < other.index for other in wrong)]
        answers = interruptible_map(pool, partial(check, spare=none), rest)
        found.update(zip([step.id for step in rest], answers, strict=True))
    for step in wrong:
        found[step.id].messages[:0] = blame(context, step, found)
    return found, graders


def self_check(
    kit: BuiltKit,
    submission: Submission,
    chosen: list[Step],
    jobs: int,
    sandbox: Sandbox,
    out: Path,
    say: ProgressCallback,
    tell: Callable[[Results], None] | None = None,
    ahead: CompiledAhead = NOTHING_AHEAD,
) -> Results:
    """Writes out/pictures/. Points are those of the visible part. Where somebody waits to be told of them, larger
    pictures are drawn after that."""
    start = time.monotonic()
    counted = AccountingSandbox(sandbox)
    with tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True) as folder:
        context = GradingContext(kit, submission, counted, Path(folder), out, say, own_libraries(kit), ahead)
        steps = [step for step in kit.steps if step.index <= max(one.index for one in chosen)]
        found, graders = _check(context, counted, steps, jobs, chosen)
        asked = [found[step.id] for step in chosen]
        name_crash(kit, submission, sandbox, say, asked)
        timing = Timing(round(time.monotonic() - start, 2), round(counted.cpu_seconds + ahead.cpu_seconds, 2))
        results = Results.of(submission.name, asked, kit.fingerprint, counted.isolation, timing)
        if tell is not None:
            tell(results)
            _draw_large(graders, say)
    return results
