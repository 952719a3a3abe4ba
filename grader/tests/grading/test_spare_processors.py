"""What is done at the same time where a processor would be idle, and that no grade depends on it."""

from concurrent.futures import Future
from pathlib import Path
from threading import Barrier, Event, Lock

import pytest
from conftest import Sources

from raysteps.common.process import Outcome
from raysteps.grading import pipeline
from raysteps.grading.pipeline import grade_submission
from raysteps.judge.hidden_tests import make_all_cases
from raysteps.results.model import Settings, StepResult
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import AccountingSandbox, Input, Sandbox, Task, TaskResult
from raysteps.submission.load import Submission
from raysteps.toolchain.compile import Compiled, CompiledAhead, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit

STEP = "07-tone-mapping"
_PATIENCE = 300.0  # seconds, after which nobody comes any more


def _grade(kit: BuiltKit, source: str, out: Path, sandbox: Sandbox, jobs: int) -> StepResult:
    submission = Submission("jo", {STEP: source.encode()}, {})
    settings = Settings(only=(STEP,), limits={"seconds": 8.0})
    return grade_submission(kit.in_one_process(), submission, settings, sandbox, out, jobs=jobs).steps[0]


def _kind(task: Task) -> str:
    names = {word.inner_name for word in task.command if isinstance(word, Input)}
    return next((kind for kind in ("raytrace", "worker", "test") if kind in names), "")


class _Meeting:
    """The first of these kinds of programs wait for each other."""

    isolation = LimitsOnly.isolation

    def __init__(self, *kinds: str) -> None:
        self._kinds = list(kinds)
        self._barrier = Barrier(len(kinds), timeout=_PATIENCE)
        self._lock = Lock()

    def run(self, task: Task) -> TaskResult:
        with self._lock:
            waits = _kind(task) in self._kinds
            if waits:
                self._kinds.remove(_kind(task))
        if waits:
            self._barrier.wait()
        return LimitsOnly().run(task)


def test_pictures_are_made_while_the_judge_asks(kit: BuiltKit, solved: Sources, tmp_path: Path) -> None:
    result = _grade(kit, solved[STEP], tmp_path, _Meeting("raytrace", "worker"), 2)
    assert (result.status, result.points) == ("passed", result.max), result.messages


def test_pictures_are_made_while_the_tests_run(kit: BuiltKit, solved: Sources, tmp_path: Path) -> None:
    result = _grade(kit, solved[STEP], tmp_path, _Meeting("raytrace", "test"), 2)
    assert (result.status, result.points) == ("passed", result.max), result.messages


def test_no_step_waits_for_a_processor_that_is_busy_with_another(
    kit: BuiltKit, solved: Sources, tmp_path: Path
) -> None:
    """Three steps, and one processor more: the judges of all three meet, two of them asked by their own steps."""
    chosen = ("01-camera-rays", "03-phong-shading", STEP)
    submission = Submission("jo", {step: solved[step].encode() for step in chosen}, {})
    sandbox = _Meeting("worker", "worker", "worker")
    results = grade_submission(kit.in_one_process(), submission, Settings(only=chosen), sandbox, tmp_path, jobs=4)
    assert [result.status for result in results.steps] == ["passed"] * 3
    together = results.steps[1].cumulative
    assert together.message == (
        "The picture is right. It was drawn with the reference's 02-intersection, which was not graded this time."
    )


def test_two_steps_that_were_not_graded_are_told_as_two(kit: BuiltKit, solved: Sources, tmp_path: Path) -> None:
    chosen = ("03-phong-shading",)
    submission = Submission("jo", {step: solved[step].encode() for step in chosen}, {})
    results = grade_submission(kit.in_one_process(), submission, Settings(only=chosen), LimitsOnly(), tmp_path)
    assert results.steps[0].cumulative.message.endswith(
        "the reference's 01-camera-rays and 02-intersection, which were not graded this time."
    )


def test_what_is_compiled_ahead_is_not_compiled_again(kit: BuiltKit, solved: Sources, tmp_path: Path) -> None:
    whole, source = kit.in_one_process(), solved[STEP].encode()
    step = next(step for step in kit.steps if step.id == STEP)

    class NoCompiler:
        isolation = LimitsOnly.isolation

        def run(self, task: Task) -> TaskResult:
            assert not task.tools
            return LimitsOnly().run(task)

    compiled: Future[Compiled] = Future()
    compiled.set_result(StudentBuild(whole, LimitsOnly(), tmp_path).compile(step, source, kit.limits_of(step)))
    submission, settings = Submission("jo", {STEP: source}, {}), Settings(only=(STEP,))
    counted = AccountingSandbox(LimitsOnly())
    counted.cpu_seconds = 100.0
    ahead = CompiledAhead({STEP: compiled}, counted)
    results = grade_submission(whole, submission, settings, NoCompiler(), tmp_path / "out", ahead=ahead)
    assert results.timing is not None
    assert results.timing.cpu_seconds > 100.0
    assert results.steps[0].status == "passed"


def test_questions_are_made_while_the_compiler_works(
    kit: BuiltKit, solved: Sources, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = Event()

    class Waiting:
        isolation = LimitsOnly.isolation

        def run(self, task: Task) -> TaskResult:
            assert made.wait(_PATIENCE)
            return LimitsOnly().run(task)

    def make(*arguments: object) -> None:
        make_all_cases(*arguments)  # type: ignore[arg-type]
        made.set()

    monkeypatch.setattr(pipeline, "make_all_cases", make)
    assert _grade(kit, solved[STEP], tmp_path, Waiting(), 2).status == "passed"


@pytest.mark.parametrize("jobs", [1, 2])
def test_pictures_that_hang_take_no_time_from_the_judges_questions(
    kit: BuiltKit, solved: Sources, tmp_path: Path, jobs: int
) -> None:
    """Whether they are made before, or meanwhile: a grade must not depend on which of them is first."""
    seconds: dict[str, list[float]] = {"raytrace": [], "worker": []}

    class Hanging:
        isolation = LimitsOnly.isolation

        def run(self, task: Task) -> TaskResult:
            seconds.setdefault(_kind(task), []).append(task.limits.cpu_seconds)
            if _kind(task) == "raytrace":
                return TaskResult(Outcome(-9, True, "", "", 8.0), {}, 8.0, "cpu")
            return LimitsOnly().run(task)

    result = _grade(kit, solved[STEP], tmp_path, Hanging(), jobs)
    assert {image.outcome for image in result.images} == {"timeout"}
    assert seconds["raytrace"][:3] == [8.0, 8.0, 2.0], "the third picture has a quarter"
    assert seconds["worker"][:2] == [8.0, 8.0], "one for each function"


@pytest.mark.parametrize("jobs", [1, 2])
def test_pictures_have_less_time_after_a_test_that_hangs(
    kit: BuiltKit, solved: Sources, tmp_path: Path, jobs: int
) -> None:
    """Those that were made meanwhile count as little as if they had come after it."""

    class Hanging:
        isolation = LimitsOnly.isolation

        def run(self, task: Task) -> TaskResult:
            is_slow = _kind(task) == "raytrace" and task.limits.cpu_seconds < 8.0
            if _kind(task) == "test" or is_slow:
                return TaskResult(Outcome(-9, True, "", "", 8.0), {}, 8.0, "cpu")
            return LimitsOnly().run(task)

    result = _grade(kit, solved[STEP], tmp_path, Hanging(), jobs)
    assert {test.outcome for test in result.tests} == {"timeout"}
    assert {image.outcome for image in result.images} == {"timeout"}
    assert {item.outcome for item in result.hidden if item.kind == "picture"} == {"timeout"}
