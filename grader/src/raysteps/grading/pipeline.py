"""Grades one submission: each step between steps of the reference, the hidden part too, then all of them together."""

import hashlib
import tempfile
import time
from collections.abc import Callable, Collection, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from raysteps.common.documents import convert, plain
from raysteps.common.errors import GraderFault, RaystepsError, reason_and_place
from raysteps.common.files import write_bytes
from raysteps.common.text import in_seconds, join_and, printable, shorten
from raysteps.course.manifest import Step
from raysteps.diagnosis.diagnose import Diagnostician
from raysteps.diagnosis.mutant_fingerprints import are_learned
from raysteps.grading.build_messages import link_message
from raysteps.grading.images import (
    ImageGrader,
    grade_image,
    grade_integration,
    image_credit,
    too_many_tests,
    trouble,
)
from raysteps.grading.scoring import is_right, status_and_points, sum_up
from raysteps.grading.step import (
    TURN,
    GradingContext,
    Programs,
    SpareProcessors,
    StepGrader,
    compile_steps,
    interruptible_map,
)
from raysteps.grading.unit_tests import known_to_hang, limits_after, mark_waiting, run_tests
from raysteps.grading.withhold import withhold
from raysteps.images.render import PictureCriteria, RenderResult, judge_picture
from raysteps.judge.counterexamples import Counterexamples
from raysteps.judge.hidden_scenes import HiddenScene, hidden_scenes
from raysteps.judge.hidden_tests import make_all_cases, revoke_tree_points, run_hidden_tests, unspared, why_unspared
from raysteps.judge.plan import Plan, read_plan
from raysteps.judge.worker import Ask, ask_some, ask_student, reference_answers, uncached_reference_answers
from raysteps.results.model import HiddenResult, ImageResult, Integration, Results, Settings, StepResult, Timing
from raysteps.results.store import RESULTS, write_results
from raysteps.sandbox.task import AccountingSandbox, Sandbox, TaskResult
from raysteps.submission.load import Submission
from raysteps.toolchain.compile import NOTHING_AHEAD, Compiled, CompiledAhead, Program, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import StepLimits, submission_seconds

# Of the time of a submission, and beside it: to ask a wrong function again may better it, and must cost nobody a step.
_APART = 0.25
_NOT_GRADED = "This step was not graded, by a fault of the grader and not of your code: somebody has to look at it."


@dataclass(frozen=True)
class _RenderedScene:
    """A scene made for this seed, and what came of it."""

    scene: HiddenScene
    path: Path
    rendered: RenderResult


class HiddenStepGrader(StepGrader):
    """One step between steps of the reference."""

    def __init__(
        self,
        context: GradingContext,
        step: Step,
        limits: StepLimits,
        compiled: dict[str, Compiled],
        settings: Settings,
        spare: SpareProcessors,
        apart: Sandbox,
    ) -> None:
        self._plan = read_plan(context.kit.project, step)
        super().__init__(context, step, limits, compiled, spare, judged=self._plan is not None)
        self._settings = settings
        self._apart = apart  # runs what is asked a second time
        self._ran = False
        self._unexplained = False
        self._spoilt: list[str] = []  # functions that are better where the reference's stand for those before them
        self._ask: Ask | None = None
        self._examples: Counterexamples | None = None
        self.fault = ""  # of the grader, in this step
        if self._plan is not None:
            self.kinds = ("test", "raytrace", "worker")

    @contextmanager
    def _guarded(self) -> Iterator[None]:
        """What nobody foresaw, or a result that cannot be written, is this step's alone, and nothing that was seen of
        it until then counts: a grader that failed knows nothing of a step. What the kit itself says is wrong with it
        ends everything."""
        try:
            yield
            convert(plain(self._result), StepResult)
        except RaystepsError:
            raise
        except Exception as error:
            step, most = self.step, self._result.max
            what = reason_and_place(error) if isinstance(error, OSError) else f"{type(error).__name__}: {error}"
            self.fault = f"{step.id}: {shorten(printable(what), 300)}"
            self._ran, self._unexplained = False, False
            self._result = StepResult(step.id, "failed", 0.0, most, step.bonus, messages=[_NOT_GRADED])

    def grade(self) -> StepResult:
        """The visible tests, then pictures, those of scenes that nobody has seen, too, and the judge's cases."""
        with self._guarded():
            programs = self.programs()
            if programs is None:
                return self._result
            step, plan, result, kit = self.step, self._plan, self._result, self._context.kit
            binary = self._compiled[step.id].binary
            completed = None if binary is None else self._completed(binary)
            unseen = () if plan is None else hidden_scenes(kit.project, step, plan, self._settings.seed)
            draw = partial(self._draw, programs["raytrace"], unseen)
            early = self._spare.start(partial(draw, self._image_grader))
            self._run_tests(programs["test"])
            if completed is not None:
                self._run_tests_again(completed["test"])
            early = self._drawn_again(draw, early)
            if early is None:
                result.images, scenes = draw(self._image_grader)
            if plan is not None and binary is not None:
                limits = limits_after(result.tests, self._limits)  # a picture that hangs takes no time from functions
                ask = self._prepare_questions(programs["worker"], completed, limits)
                result.hidden = run_hidden_tests(
                    step,
                    plan,
                    ask,
                    self._reference_answers,
                    self._settings.seed,
                    limits.seconds,
                    self._examples,
                    known_to_hang(result.tests, kit.tests[step.id]),
                )
                self._ask_apart(binary, plan, limits)
                self._weigh_tests()
            if early is not None:
                result.images, scenes = draw(self._image_grader) if early.cancel() else early.result()
            not_spared = unspared(result.images, result.hidden)
            revoke_tree_points(result.images, result.hidden)
            spares = not why_unspared(result.hidden)
            result.hidden += [self._judge_scene(scene, not_spared, spares=spares) for scene in scenes]
            mark_waiting(
                result, step, kit.tests[step.id], self._context.source(step) or "", replaced=completed is not None
            )
            result.messages += sum_up(result)
            self._unexplained = not is_right(result)
            self._ran = True
        return self._result

    def _prepare_questions(self, worker: Program, completed: Programs | None, limits: StepLimits) -> Ask:
        """Whom the judge's cases are asked, and what makes a small one of a case that goes wrong."""
        kit = self._context.kit
        ask = self._ask = self._asked_of(worker, completed, limits)
        if self._settings.feedback == "full":  # else the cases are withheld, and nobody needs a small one
            self._examples = Counterexamples(
                ask, lambda cases, _: uncached_reference_answers(kit, cases), self._context.out, self._context.say
            )
        return ask

    def _reference_answers(self, cases: bytes, _: float) -> TaskResult:
        return reference_answers(self._context.kit, cases)

    def _draw(
        self, program: Program, unseen: Sequence[HiddenScene], image_grader: ImageGrader
    ) -> tuple[list[ImageResult], list[_RenderedScene]]:
        """The step's pictures, and those of scenes that nobody has seen. These have files whose names say nothing."""
        images, scenes = [], []
        for case in self.step.images:
            images.append(grade_image(image_grader, program, self.step, case))
        for scene in unseen:
            nff = scene.nff.encode()
            path = self._context.folder / self.step.number / f"{hashlib.sha256(nff).hexdigest()[:16]}.nff"
            write_bytes(path, nff)
            rendered = image_grader.render(program, path, scene.args, noisy=scene.max_noise is not None)
            scenes.append(_RenderedScene(scene, path, rendered))
        return images, scenes

    def _judge_scene(self, made: _RenderedScene, not_spared: str, *, spares: bool) -> HiddenResult:
        """`not_spared`: why few tests earn nothing; `spares`: whether a picture that does not pass earns something all
        the same."""
        image_grader, step = self._image_grader, self.step
        scene, path, rendered = made.scene, made.path, made.rendered
        result = HiddenResult(scene.name, "picture", 0.0, weight=scene.weight)
        result.seconds = round(rendered.ran.outcome.seconds, 2)
        if rendered.pixels is None:
            result.outcome, result.message = trouble(rendered)
            return result
        # Each seed has a picture of its own, so that the reference's must not take long.
        criteria = PictureCriteria(scene.args, scene.max_wrong, scene.max_noise, more_samples=4)
        verdict = judge_picture(image_grader.kit, path, criteria, rendered)
        problem = verdict.message
        if verdict.passed and scene.max_share is not None:
            problem = too_many_tests(rendered.share_tested, scene.max_share) or not_spared
        result.wrong_share = round(verdict.wrong_share, 6)
        result.message = problem
        if not problem:
            result.share, result.outcome = 1.0, "ok"
            return result
        result.outcome = "wrong"
        if spares or scene.max_share is None:
            result.share = image_credit(
                image_grader.kit,
                step,
                path,
                criteria,
                scene.max_share,
                rendered,
                pixels_pass=verdict.passed,
            )
        return result

    # A function that is not written costs its own points only: for those after it, which may call it, the reference's
    # takes its place. Those before it are what it is made of, and could be made of the reference's, turned round.

    def _after_missing(self) -> list[str]:
        functions = self.step.functions
        return list(functions[max(map(functions.index, self._unfinished), default=len(functions)) + 1 :])

    def _completed(self, binary: Path) -> Programs | None:
        """The programs of the tests and of the judge with the reference's function in place of the one that is not
        written. None where it is not a single one or the last, or where steps are no libraries: with more of them
        missing, what is left would be taken for most of the work."""
        step, unfinished = self.step, self._unfinished
        names = self._context.kit.linker_names(step, unfinished)
        if self._plan is None or not names or len(unfinished) != 1 or not self._after_missing():
            return None
        programs: Programs = {}
        for kind in ("test", "worker"):
            program, _ = self._build.program(kind, step, {step.number: binary}, self._limits, replaced=names)
            if program is None:
                return None
            programs[kind] = program
        return programs

    def _run_tests_again(self, program: Program) -> None:
        """Those of functions after the one that is not written."""
        tests = self._context.kit.tests[self.step.id]
        needed, after = set(self._unfinished), set(self._after_missing())
        own = [one for one in self._result.tests if after & set(tests[one.name]) and not needed & set(tests[one.name])]
        if all(test.passed for test in own):
            return
        again = {test.name: test for test in run_tests(self._context.sandbox, program, tests, self._limits)}
        own_names = {test.name for test in own}
        self._result.tests = [
            replace(again[test.name], weight=test.weight) if test.name in own_names else test
            for test in self._result.tests
        ]

    def _asked_of(self, worker: Program, completed: Programs | None, limits: StepLimits) -> Ask:
        sandbox = self._context.sandbox
        ask = ask_student(sandbox, worker, limits)
        if completed is None:
            return ask
        return ask_some(ask, ask_student(sandbox, completed["worker"], limits), self._after_missing())

    # A function that is wrong costs its own hidden points only: those after it, which may call it, are asked again with
    # the reference's in its place.

    def _ask_apart(self, binary: Path, plan: Plan, limits: StepLimits) -> None:
        """Whoever is better so is judged so. Who hung is not asked again, nor anybody where several functions are not
        written: as in `_completed`, what is left would be taken for most of the work. A tree that spares nothing stays:
        a search through it spares nothing either."""
        result, missing, examples = self._result, set(self._unfinished), self._examples
        wrong = [item for item in result.hidden if not item.passed and item.name not in missing]
        if len(missing) > 1:
            return
        better: dict[str, HiddenResult] = {}
        for before, item in enumerate(wrong[1:], start=1):
            worker = None
            if item.outcome != "timeout":
                replaced = {other.name for other in wrong[:before] if not other.spares_nothing}
                replaced |= missing if item.name in self._after_missing() else set()
                worker = self._worker_with(binary, replaced)
            if worker is None:
                continue
            ask = ask_student(self._apart, worker, limits)
            again = run_hidden_tests(
                self.step,
                replace(plan, functions=tuple(one for one in plan.functions if one.name == item.name)),
                ask,
                self._reference_answers,
                self._settings.seed,
                limits.seconds,
                None if examples is None else replace(examples, student=ask, above=item.share),
            )[0]
            if again.share > item.share:
                better[item.name] = again
                if item.case and not again.case:
                    (self._image_grader.out / item.case).unlink(missing_ok=True)
        self._spoilt = list(better)
        if better:
            result.hidden = [better.get(item.name, item) for item in result.hidden]
            result.messages.append(
                f"The hidden cases of {join_and(list(better))} are asked with the reference's functions in place of "
                "those before them that are wrong."
            )

    def _worker_with(self, binary: Path, replaced: Collection[str]) -> Program | None:
        """With the reference's functions in place of these. None where steps are no libraries."""
        step, names = self.step, self._context.kit.linker_names(self.step, replaced)
        binaries = {step.number: binary}
        build = StudentBuild(self._context.kit, self._apart, self._context.folder)
        return build.program("worker", step, binaries, self._limits, replaced=names)[0] if names else None

    @property
    def has_to_learn(self) -> bool:
        """Whether it takes a while to say why the step is wrong: the known mistakes must be learned before."""
        return self._unexplained and not are_learned(self._context.kit, self.step)

    def explain(self) -> None:
        """In words why it is not right. Whatever a student's program says, it costs no grade."""
        if not self._unexplained:
            return
        diagnostician = Diagnostician(self._context.kit, self.step, self._plan, self._ask, self._context.say)
        try:
            source = self._context.source(self.step) or ""
            self._result.diagnoses = diagnostician.diagnose(
                self._result, self._image_grader.made, self._unfinished, self._spoilt, source
            )
        except Exception as error:  # the kit's own trouble too: an explanation is not worth a grade
            self._context.say(f"no diagnosis of {self.step.number}: {error!r}")

    def finish(self, right: Collection[str]) -> StepResult:
        """After all steps were graded alone: does this one work with those before it that are right, by their ids? One
        that is not right is replaced by the reference's: its mistake costs its own step only."""
        with self._guarded():
            if self._ran:
                step = self.step
                earlier = self._context.kit.handed_in_up_to(step)[:-1]
                replaced = [other for other in earlier if other.id not in right]
                program, why = self._joined([other for other in earlier if other.id in right])
                if program is None:
                    self._result.cumulative = Integration(False, why)
                else:
                    own = [one for one in (*earlier, step) if one not in replaced]
                    self._wait_for(own)
                    only = self._settings.only
                    not_chosen = [one.id for one in replaced if only and one.id not in only]
                    others = {
                        f"{'was' if len(not_chosen) == 1 else 'were'} not graded this time": not_chosen,
                        "you do not have right yet": [one.id for one in replaced if not only or one.id in only],
                    }
                    self._result.cumulative = grade_integration(self._image_grader, program, step, own, others)
                self._result.status, self._result.points = status_and_points(self._result, step)
        return self._result

    def _wait_for(self, own: list[Step]) -> None:
        """A program of several steps has the time of the slowest, unless this one has hung before."""
        if self._image_grader.limits == self._limits:
            seconds = max(self._context.kit.limits_of(one, self._settings.limits).seconds for one in own)
            self._image_grader.limits = replace(self._limits, seconds=seconds)

    def _joined(self, right: list[Step]) -> tuple[Program | None, str]:
        """This step with those before it, or why there is no such program."""
        if not all(image.passed for image in self._result.images[:1]):
            return None, "This step itself is not right yet."
        binaries = {other.number: self._compiled[other.id].binary for other in (*right, self.step)}
        own = {number: path for number, path in binaries.items() if path is not None}
        program, ran = self._build.program("raytrace", self.step, own, self._limits, together=True)
        if ran is not None:
            self._expect_room()
            return None, f"The steps do not build together. {link_message(ran)}"
        assert program is not None
        return program, ""


def _tell_of_the_limit(steps: list[StepResult], seconds: float) -> None:
    """Of all programs together."""
    for result in steps:
        if result.status not in ("passed", "not-started"):
            result.messages.append(
                f"All programs of a submission together may run for {in_seconds(seconds)}; when these were over, what "
                "was left was not run."
            )


def _make_questions(context: GradingContext, chosen: Sequence[Step], seed: int) -> None:
    """What is made is kept."""
    for step in chosen:
        plan = read_plan(context.kit.project, step)
        if plan is not None and context.source(step) is not None:
            make_all_cases(step, plan, seed)


def _chosen(kit: BuiltKit, settings: Settings) -> list[Step]:
    return [step for step in kit.steps if not settings.only or step.id in settings.only]


def _refuse_faults(graders: Sequence[HiddenStepGrader], out: Path) -> None:
    """When all is written."""
    faults = [grader.fault for grader in graders if grader.fault]
    if faults:
        raise GraderFault(f"not graded: {'; '.join(faults)}; what became of the other steps is in {out / RESULTS}")


def grade_submission(
    kit: BuiltKit,
    submission: Submission,
    settings: Settings,
    sandbox: Sandbox,
    out: Path,
    say: Callable[[str], None] = lambda text: None,
    *,
    jobs: int = 1,
    course: str = "",
    tell: Callable[[Results], None] | None = None,
    name_crash: Callable[[Sequence[StepResult]], None] = lambda found: None,
    ahead: CompiledAhead = NOTHING_AHEAD,
) -> Results:
    """Writes out/results.json, without what `settings.feedback` withholds, and out/pictures/; returns everything. What
    goes wrong in a step costs that step only; where it was the grader that failed in one, GraderFault says so when all
    is written. So many `jobs` are done at a time; that changes a grade only where a step is near its time limit, or
    where all programs together use theirs up.
    `course` is the name that results.json tells. `name_crash` may add to messages where a test crashed. Where known
    mistakes have to be learned, the results are written before, or `tell` gets them: nobody waits for names. Steps that
    are compiled `ahead` are not compiled again."""
    start = time.monotonic()
    together = submission_seconds(settings.limits)
    counted, apart = AccountingSandbox(sandbox, together), AccountingSandbox(sandbox, _APART * together)
    chosen = _chosen(kit, settings)

    def write(results: Results) -> None:
        write_results(withhold(results, settings.feedback), out)

    with (
        ExitStack() as ends,
        ThreadPoolExecutor(max_workers=max(1, jobs)) as pool,
        counted.until_interrupted(),
        apart.until_interrupted(),
        ahead.until_interrupted(),
    ):
        folder = ends.enter_context(tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True))
        context = GradingContext(kit, submission, counted, Path(folder), out, say, ahead=ahead)
        spare = SpareProcessors(jobs - len(chosen), ends)
        say("building the steps")
        spare.start(partial(_make_questions, context, chosen, settings.seed))  # while the compiler works
        compiled = compile_steps(context, chosen, pool, settings.limits)

        graders = [
            HiddenStepGrader(context, step, kit.limits_of(step, settings.limits), compiled, settings, spare, apart)
            for step in chosen
        ]
        order = -1 if jobs > 1 else 1  # late steps take longest: first, they leave nobody idle at the end
        graded = [pool.submit(grader.grade) for grader in graders[::order]]
        while wait(graded, TURN).not_done:
            pass
        right = {one.result().id for one in graded if is_right(one.result())}
        finished = [pool.submit(grader.finish, right=right) for grader in graders[::order]]
        while wait(finished, TURN).not_done:
            pass
        steps = [one.result() for one in finished][::order]
        if counted.is_spent:
            _tell_of_the_limit(steps, together)
        name_crash(steps)
        used = counted.cpu_seconds + apart.cpu_seconds + ahead.cpu_seconds
        timing = Timing(round(time.monotonic() - start, 2), round(used, 2))
        results = Results.of(submission.name, steps, kit.fingerprint, counted.isolation, timing)
        results.course = course
        if any(grader.has_to_learn for grader in graders) and not any(grader.fault for grader in graders):
            (tell or write)(results)
        interruptible_map(pool, HiddenStepGrader.explain, graders)
    write(results)
    _refuse_faults(graders, out)
    return results
