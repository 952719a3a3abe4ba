"""What all programs of a submission may take together."""

import math
from dataclasses import replace
from pathlib import Path
from typing import cast

import pytest

from raysteps.common.process import Outcome
from raysteps.course.manifest import Step
from raysteps.grading.images import ImageGrader, trouble
from raysteps.grading.unit_tests import known_to_hang, run_tests
from raysteps.sandbox.task import AccountingSandbox, Isolation, LimitHit, Limits, Task, TaskResult
from raysteps.toolchain.compile import Program
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import give_up_after, limits_of, parse_limits, submission_seconds

pytestmark = pytest.mark.portable


class _Sleepers:
    """Every task sleeps a little less than it may, but no longer than that."""

    isolation = Isolation()

    def __init__(self) -> None:
        self.tasks: list[Task] = []

    def run(self, task: Task) -> TaskResult:
        self.tasks.append(task)
        slept = min(9.0, task.limits.wall_seconds)
        cut = slept == task.limits.wall_seconds
        return TaskResult(Outcome(0, cut, "", "", slept), {}, 0.5, "wall" if cut else "")


def test_sleepers_below_every_limit_have_no_more_time_than_the_sum() -> None:
    inner = _Sleepers()
    sandbox = AccountingSandbox(inner, 20.0)
    task = Task(("sleeper",), Limits(wall_seconds=10.0))
    results = [sandbox.run(task) for _ in range(5)]
    assert [one.limits.wall_seconds for one in inner.tasks] == [10.0, 10.0, 2.0]
    assert [ran.stopped for ran in results] == ["", "", "wall", "wall", "wall"]
    assert sandbox.is_spent
    assert sandbox.cpu_seconds == 1.5
    assert not AccountingSandbox(inner).is_spent


@pytest.mark.parametrize("why", ["cpu", "memory"])
def test_who_runs_into_limits_is_not_waited_for(steps: list[Step], tmp_path: Path, why: LimitHit) -> None:
    """Whichever limit it is."""

    class Eating:
        isolation = Isolation()

        def __init__(self) -> None:
            self.seconds: list[float] = []

        def run(self, task: Task) -> TaskResult:
            self.seconds.append(task.limits.cpu_seconds)
            return TaskResult(Outcome(-9, False, "", "", 7.0), {}, 7.0, why)

    kit = cast(BuiltKit, None)  # nobody asks for the reference's pictures
    sandbox, limits, program = Eating(), limits_of(steps[0], {"seconds": 8.0}), Program(("tests",))
    said: list[str] = []
    tests = {f"test {number}": ["build"] for number in range(20)}
    results = run_tests(sandbox, program, tests, limits, said.append)
    assert said == [
        "the tests were stopped; each of the others runs by itself now",
        *(f"stopped: test {number}" for number in range(3)),
    ], "nobody waits in silence"
    assert sandbox.seconds == [8, 8, 2, 2]
    assert len(results) == 20
    assert {result.outcome for result in results[:3]} == {"crashed" if why == "memory" else "timeout"}
    assert all("was not run" in result.message for result in results[3:])
    assert not any("was not run" in result.message for result in results[:3])

    gallery = ImageGrader(kit, sandbox, limits, tmp_path)
    gallery.record_stops(results[:1])
    assert gallery.limits.seconds == 2
    gallery, before = ImageGrader(kit, sandbox, limits, tmp_path), len(sandbox.seconds)
    for _ in range(4):
        gallery.render(program, tmp_path / "scene.nff", ())
    assert sandbox.seconds[before:] == [8, 8, 2, 2]


def test_a_program_that_gives_up_in_a_test_is_told_with_its_last_words(steps: list[Step]) -> None:
    class GivesUp:
        isolation = Isolation()

        def run(self, task: Task) -> TaskResult:
            return TaskResult(Outcome(1, False, "", "a\nwithout an end", 0.1), {}, 0.1, "")

    (result,) = run_tests(GivesUp(), Program(("tests",)), {"a": ["build"]}, limits_of(steps[0], {}))
    assert result.outcome == "crashed"
    assert "ended in the middle of the test, with exit code 1: without an end. A debugger" in result.message


def _ended(name: str, seconds: float, *, passed: bool = True) -> str:
    success = str(passed).lower()
    overall = f'<OverallResult success="{success}" durationInSeconds="{seconds}"/>'
    return f'<TestCase name="{name}">{overall}</TestCase>'


@pytest.mark.parametrize("root", ['<Catch name="x"><Group name="x">', '<?xml version="1.0"?><Catch2TestRun name="x">'])
@pytest.mark.parametrize(
    ("before", "asked"), [(0.15, ["c"]), *((before, ["a", "b", "c"]) for before in (0.5, 1.95, math.nan))]
)
def test_a_test_in_which_all_of_them_were_stopped_is_not_asked_again(
    steps: list[Step], root: str, before: float, asked: list[str]
) -> None:
    """What had ended before it counts. Where others had a share of the time, it may be slow and right."""

    class Stopped:
        isolation = Isolation()

        def __init__(self) -> None:
            self.ran: list[str] = []

        def run(self, task: Task) -> TaskResult:
            name = str(task.command[-1])
            if "report" in repr(name):
                report = f'{root}{_ended("a", before)}<TestCase name="b" tags="[x]">\n  <Sec'
                return TaskResult(Outcome(-9, False, "", "", 8.0), {"report": report.encode()}, 8.0, "cpu")
            self.ran.append(name)
            totals = '<OverallResultsCases successes="1" failures="0"/>'
            report = f"<Catch2TestRun>{_ended(name, 0.1)}{totals}</Catch2TestRun>"
            return TaskResult(Outcome(0, False, "", "", 0.1), {"report": report.encode()}, 0.1, "")

    sandbox = Stopped()
    tests = {"a": ["build"], "b": ["search"], "c": ["search"]}
    results = run_tests(sandbox, Program(("tests",)), tests, limits_of(steps[0], {"seconds": 8.0}))
    assert sandbox.ran == asked
    found = {result.name: result.outcome for result in results}
    assert found == {"a": "ok", "b": "ok" if "b" in asked else "timeout", "c": "ok"}
    stopped = [result.message for result in results if not result.passed]
    assert stopped == ["The test was stopped after 8 seconds. Is there an endless loop?"] * (asked == ["c"])


def test_only_the_time_of_the_step_is_told(steps: list[Step], tmp_path: Path) -> None:
    class Hanging:
        isolation = Isolation()

        def run(self, task: Task) -> TaskResult:
            return TaskResult(Outcome(-9, False, "", "", task.limits.cpu_seconds), {}, 1.0, "cpu")

    limits, program = limits_of(steps[0], {"seconds": 10.0}), Program(("tests",))
    results = run_tests(Hanging(), program, {f"test {number}": ["build"] for number in range(4)}, limits)
    gallery = ImageGrader(cast(BuiltKit, None), Hanging(), limits, tmp_path)
    gallery.record_stops(results)
    said = [result.message for result in results] + [
        trouble(gallery.render(program, tmp_path / "scene.nff", ()))[1] for _ in range(2)
    ]
    assert "after 10 seconds" in said[0]
    assert not any("2.5" in words for words in said)
    assert said[-1] == said[1].replace("The test", "The picture")


def test_who_shares_a_test_or_had_less_time_is_not_known_to_hang(steps: list[Step]) -> None:
    """A right function that is slow has the time of the step in the judge, whatever hangs beside it."""

    class Hanging:
        isolation = Isolation()

        def run(self, task: Task) -> TaskResult:
            why: LimitHit = "memory" if str(task.command[-1]).startswith("large") else "cpu"
            return TaskResult(Outcome(-9, False, "", "", task.limits.cpu_seconds), {}, 1.0, why)

    def hanging(tests: dict[str, list[str]]) -> set[str]:
        results = run_tests(Hanging(), Program(("tests",)), tests, limits_of(steps[0], {"seconds": 8.0}))
        assert not any(result.passed for result in results)
        return known_to_hang(results, tests)

    assert hanging({"both": ["loop", "slow"], "alone": ["slow"]}) == set(), "the second one had less time"
    assert hanging({"alone": ["loop"], **{f"{number}": ["loop"] for number in range(5)}, "slow": ["slow"]}) == {"loop"}
    assert hanging({"large": ["large"], "slow": ["slow"]}) == set()


def test_what_hangs_takes_no_tests_from_functions_that_do_not(steps: list[Step]) -> None:
    """Of each other function one test is waited for at most."""
    tests = {f"{name} {number}": [name] for name in ("slow", "right", "slow too") for number in range(8)}

    class Running:
        isolation = Isolation()

        def __init__(self) -> None:
            self.ran: list[str] = []

        def run(self, task: Task) -> TaskResult:
            self.ran.append(str(task.command[-1]))
            if self.ran[-1].startswith("right"):
                passed = f'<TestCase name="{self.ran[-1]}"><OverallResult success="true"/></TestCase>'
                totals = '<OverallResultsCases successes="1" failures="0"/>'
                report = f"<Catch2TestRun>{passed}{totals}</Catch2TestRun>".encode()
                return TaskResult(Outcome(0, False, "", "", 0.1), {"report": report}, 0.1, "")
            return TaskResult(Outcome(-9, False, "", "", 7.0), {}, 7.0, "cpu")

    sandbox = Running()
    results = run_tests(sandbox, Program(("tests",)), tests, limits_of(steps[0], {"seconds": 8.0}))
    assert [result.name for result in results if result.passed] == [f"right {number}" for number in range(8)]
    waited_for = [name for name in sandbox.ran[1:] if name.startswith("slow")]
    assert waited_for == [*(f"slow {number}" for number in range(3)), "slow too 0"]


@pytest.mark.parametrize("why", ["wall", "cpu"])
def test_a_busy_machine_changes_no_words(why: LimitHit) -> None:
    """There the clock ends what elsewhere the processor time does."""

    class Hanging:
        isolation = Isolation()

        def run(self, task: Task) -> TaskResult:
            return TaskResult(Outcome(-9, True, "", "", 7.13), {}, 2.04, why)

    ran = AccountingSandbox(Hanging()).run(Task(("hangs",), Limits(wall_seconds=8, cpu_seconds=2)))
    assert ran.hung
    assert ran.outcome.seconds == 2


def test_the_sum_can_be_set(steps: list[Step]) -> None:
    changes = parse_limits(["submission_seconds=90", "seconds=3"])
    assert (submission_seconds(changes), give_up_after(changes)) == (90, 180)
    assert limits_of(steps[0], changes) == replace(limits_of(steps[0], {}), seconds=3)
    assert give_up_after({}) == 3600
