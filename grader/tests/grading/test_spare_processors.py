"""What is done at the same time where a processor would be idle, and that no grade depends on it."""

from concurrent.futures import Future
from pathlib import Path
from threading import Barrier, Event

import pytest
from conftest import Sources

from raysteps.grading import pipeline
from raysteps.grading.pipeline import grade_submission
from raysteps.judge.hidden_tests import make_all_cases
from raysteps.results.model import StepResult
from raysteps.results.settings import Settings
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Sandbox, Task, TaskResult
from raysteps.submission.load import Submission
from raysteps.toolchain.compile import Compiled, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit

STEP = "07-tone-mapping"
_PATIENCE = 300.0  # seconds, after which nobody comes any more
_HANGS = "    for (volatile int turn = 0; turn >= 0; turn = 1) {\n    }\n"
_AFTER_A_WHILE = "    static int calls = 0;\n    if (++calls < 3000) {\n        return k_black;\n    }\n"


def _grade(kit: BuiltKit, source: str, out: Path, sandbox: Sandbox, jobs: int) -> StepResult:
    submission = Submission("jo", {STEP: source.encode()}, {})
    settings = Settings(only=(STEP,), limits={"seconds": 1.0})
    return grade_submission(kit.in_one_process(), submission, settings, sandbox, out, jobs=jobs).steps[0]


class _Meeting:
    """The first picture and the first questions of the judge wait for each other."""

    isolation = LimitsOnly.isolation

    def __init__(self, kit: BuiltKit) -> None:
        self._kinds = ("raytrace", "worker")
        self._barrier = Barrier(len(self._kinds), timeout=_PATIENCE)
        self._came: set[str] = set()

    def run(self, task: Task) -> TaskResult:
        names = {word.inner_name for word in task.command if isinstance(word, Input)}
        for kind in self._kinds:
            if kind in names and kind not in self._came:
                self._came.add(kind)
                self._barrier.wait()
        return LimitsOnly().run(task)


def test_pictures_are_made_while_the_judge_asks(kit: BuiltKit, solved: Sources, tmp_path: Path) -> None:
    result = _grade(kit, solved[STEP], tmp_path, _Meeting(kit), 2)
    assert (result.status, result.points) == ("passed", result.max), result.messages


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
    results = grade_submission(whole, submission, settings, NoCompiler(), tmp_path / "out", ahead={STEP: compiled})
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


@pytest.mark.parametrize("before", ["", _AFTER_A_WHILE], ids=["everywhere", "in pictures"])
def test_a_hanging_step_gets_the_same_with_and_without(
    kit: BuiltKit, solved: Sources, tmp_path: Path, before: str
) -> None:
    """Whoever hangs runs out of patience, and what is asked meanwhile must not depend on when."""
    head = "Color tone_map(const Color& color) {\n"
    source = solved[STEP].replace(head, head + before + _HANGS)
    assert _HANGS in source
    one, two = (_grade(kit, source, tmp_path / str(jobs), LimitsOnly(), jobs) for jobs in (1, 2))
    for item in (*one.hidden, *two.hidden):
        item.seconds = 0.0
    assert one == two
    assert {image.outcome for image in one.images} == {"timeout"}
