"""The real worker, linked with the reference."""

import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from raysteps.common.process import Outcome
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.judge.estimates import read_estimates
from raysteps.judge.functions import AGAIN, Case, functions_of
from raysteps.judge.hidden_tests import make_cases, run_hidden_tests
from raysteps.judge.plan import Plan, read_plan
from raysteps.judge.protocol import Real, TokenReader
from raysteps.judge.random_source import RandomSource
from raysteps.judge.worker import reference_answers
from raysteps.sandbox.task import TaskResult
from raysteps.toolchain.kit_artifacts import BuiltKit

_MAX_SECONDS = 0.5  # of the worker for a whole step, on any machine


@pytest.fixture(scope="module")
def worker(kit: BuiltKit) -> Path:
    return kit.reference("worker")


def _plan(project: Project, step: Step) -> Plan:
    plan = read_plan(project, step)
    assert plan is not None
    return plan


def _run(worker: Path, stdin: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([worker], input=stdin, capture_output=True, text=True, timeout=60, check=False)


@pytest.mark.parametrize("seed", [1, 2, 12345])
def test_the_reference_is_right_in_everything(project: Project, steps: list[Step], worker: Path, seed: int) -> None:
    def ask(stdin: bytes, _seconds: float) -> TaskResult:
        done = _run(worker, stdin.decode())
        return TaskResult(Outcome(done.returncode, False, done.stdout, done.stderr, 0.01), {}, 0.0, "")

    for step in steps:
        for result in run_hidden_tests(step, _plan(project, step), ask, ask, seed):
            assert result.share == 1, f"{result.message} {result.given}"


def test_overlap_answers_are_what_the_cases_were_made_for(project: Project, steps: list[Step], worker: Path) -> None:
    step = next(step for step in steps if step.number == "06")
    for plan in _plan(project, step).functions:
        if not plan.name.endswith("::overlaps"):
            continue
        cases = make_cases(step, plan, 4)
        out = _run(worker, "".join(case.line(i) + "\n" for i, case in enumerate(cases))).stdout
        answers = [line.split()[2] for line in out.splitlines() if line.startswith("done ")]
        for case, answer in zip(cases, answers, strict=True):
            if not case.group.startswith("touching or") and case.group != AGAIN:
                assert answer == ("0" if case.group == "far apart" else "1"), case.given()


@pytest.mark.parametrize("hanging", ["Box::clip", "build_octree"])
def test_a_function_that_hangs_costs_no_other(project: Project, steps: list[Step], worker: Path, hanging: str) -> None:
    used = []

    def reference(stdin: bytes, _seconds: float) -> TaskResult:
        done = _run(worker, stdin.decode())
        return TaskResult(Outcome(done.returncode, False, done.stdout, done.stderr, 0.01), {}, 0.0, "")

    def student(stdin: bytes, seconds: float) -> TaskResult:
        number, function = stdin.decode().split(" ", 2)[:2]
        hangs = function == hanging
        ran = TaskResult(Outcome(-9, True, f"start {number}\n", "", seconds), {}, 0.0, "wall")
        ran = ran if hangs else reference(stdin, seconds)
        used.append(ran.outcome.seconds)
        return ran

    step = next(step for step in steps if step.number == "06")
    results = run_hidden_tests(step, _plan(project, step), student, reference, 1)
    assert {result.name: result.share for result in results} == {
        name: 0.0 if name == hanging else 1.0 for name in step.functions
    }
    assert sum(used) < 4 * step.seconds


def test_the_lines(worker: Path) -> None:
    done = _run(worker, "7 to_byte 1\n8 tone_map 1 nan inf\n9 point_at 0 0 0 0 0 -1 0.1\n")
    assert done.returncode == 0
    assert done.stdout.splitlines() == [
        "start 7",
        "done 7 255",
        "start 8",
        "done 8 0.5 0 1",
        "start 9",
        "done 9 0 0 -0.1",
        "end 3",
    ]


@pytest.mark.parametrize(
    "line", ["1 to_byte", "1 to_byte x", "1 to_byte 1 2", "1 no_such_function 1", "1 bounds_of 1 9", "1 bounds_of -1"]
)
def test_a_case_that_nobody_can_run(worker: Path, line: str) -> None:
    assert _run(worker, line + "\n").stdout.splitlines()[1].startswith("done 1 bad-case ")


def test_no_cases(worker: Path) -> None:
    assert _run(worker, "").stdout == "end 0\n"


def test_the_reference_may_say_as_much_as_a_student(kit: BuiltKit, tmp_path: Path) -> None:
    """An answer that is as long as a student's may be is not cut off."""
    (tmp_path / "bin").symlink_to(kit.folder / "bin")
    cases = "".join(f"{i} split 0.1 0.2 0.3 0.4 0.5 0.6\n" for i in range(20_000))
    said = reference_answers(replace(kit, folder=tmp_path), cases.encode()).outcome.stdout
    assert len(said) > 2 << 20
    assert said.endswith("\nend 20000\n")


def test_estimates_stop_when_their_mean_is_known(worker: Path) -> None:
    """At the least number: the error is the one that was asked for, and half of the estimates would not have done."""
    furnace = functions_of("13")["path_light"].by_name["a furnace"]
    case = Case("path_light", "a furnace", furnace.make(RandomSource("1")))
    precision = case.inputs["precision"]
    assert isinstance(precision, Real)
    out = _run(worker, case.line(0) + "\n").stdout
    answer = next(line for line in out.splitlines() if line.startswith("done ")).split(" ", 2)[2]
    found = read_estimates(TokenReader(answer.removeprefix("often ")))
    error = float(found.error.max() / found.mean.max())
    assert 0.7 * precision.value < error < 1.1 * precision.value
