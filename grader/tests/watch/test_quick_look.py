"""What `watch` learns of a step at once, with real programs."""

import dataclasses
import errno
import io
import json
import signal
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from conftest import Sources
from rich.console import Console

from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import make_stub
from raysteps.images.compare import GROSS, read_png
from raysteps.results.model import StepResult, TestResult
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Task, TaskResult
from raysteps.toolchain.compile import KeptLibraries, StudentBuild, build_log
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.watch import worker
from raysteps.watch.runner import WORKER
from raysteps.watch.step_view import StepView, verdict
from raysteps.watch.terminal_view import TerminalView
from raysteps.watch.worker import QuickLook

_ID = "07-tone-mapping"


@pytest.fixture
def step(steps: list[Step]) -> Step:
    return next(step for step in steps if step.id == _ID)


def _look(kit: BuiltKit, step: Step, source: str, out: Path) -> tuple[StepResult, list[tuple[int, int]]]:
    """The result, and how many tests and pictures were told of at each time."""
    told: list[tuple[int, int]] = []
    tell = QuickLook(kit, step, LimitsOnly(), out, lambda result: told.append((len(result.tests), len(result.images))))
    return tell.look(source), told


def test_a_right_step_is_told_bit_by_bit(kit: BuiltKit, step: Step, solved: Sources, tmp_path: Path) -> None:
    result, told = _look(kit, step, solved[_ID], tmp_path)
    tests = len(kit.tests[_ID])
    assert result.status == "passed"
    assert told == [(0, 0), (tests, 0), *((tests, number + 1) for number in range(len(step.images)))]
    assert result.hidden == []
    for image in result.images:
        assert image.passed
        assert image.mine
        assert (tmp_path / image.mine).is_file()


@pytest.mark.parametrize("own", [True, False])
def test_only_a_grade_keeps_less_of_a_grossly_wrong_picture(
    kit: BuiltKit, steps: list[Step], solved: Sources, tmp_path: Path, own: bool
) -> None:
    """Coarse blocks would be looked for in the own code."""
    step = next(step for step in steps if step.number == "01")
    turned = solved[step.id].replace("return frame;", "frame.right = -frame.right;\n    return frame;")
    assert turned != solved[step.id]
    result, _ = _look(kit.in_one_process() if own else kit, step, turned, tmp_path)
    wrong = next(image.mine for image in result.images if (image.wrong_share or 0) > GROSS)
    assert wrong is not None
    mine = read_png(tmp_path / wrong)
    blocks = mine[::2, ::2].repeat(2, axis=0).repeat(2, axis=1)[: len(mine), : len(mine[0])]
    assert (mine == blocks).all() != own


class _Counting(LimitsOnly):
    """Counts the runs of compilers and their like."""

    tools = 0

    def run(self, task: Task) -> TaskResult:
        self.tools += task.tools
        return super().run(task)


def test_what_was_compiled_once_is_not_compiled_again(
    kit: BuiltKit, step: Step, solved: Sources, tmp_path: Path
) -> None:
    """Not the steps before the one that was saved, and nothing by the check that follows a look."""
    kept = KeptLibraries(tmp_path / "own")
    counts: list[int] = []
    for source in (solved[_ID], solved[_ID], solved[_ID] + "\n#warning again\n"):
        sandbox = _Counting()
        build = StudentBuild(kit, sandbox, tmp_path / f"build{len(counts)}", kept)
        compiled = build.compile(step, source.encode(), kit.limits_of(step))
        assert compiled.binary is not None
        assert compiled.binary.is_file()
        counts.append(sandbox.tools)
    assert counts[0] == counts[2] > 0
    assert counts[1] == 0
    again = StudentBuild(kit, LimitsOnly(), tmp_path / "last", kept)
    said = build_log(again.compile(step, source.encode(), kit.limits_of(step)).ran)
    assert "again" in said, "what the compiler said is told again, too"


def test_libraries_are_kept_for_some_saves_only(kit: BuiltKit, step: Step, tmp_path: Path) -> None:
    kept = KeptLibraries(tmp_path)
    for number in range(50):
        kept.keep(kit, step, b"%d" % number, b"library", "")
    assert len(list(tmp_path.glob("*.library"))) == len(list(tmp_path.glob("*.log"))) == 40
    assert kept.find(kit, step, b"49") == (b"library", "")


def test_a_step_that_does_not_build(kit: BuiltKit, step: Step, solved: Sources, tmp_path: Path) -> None:
    result, told = _look(kit, step, solved[_ID] + "\nint oops( { }\n", tmp_path)
    assert (result.status, told) == ("does-not-build", [])
    assert result.messages[0].startswith("It does not build: tone_mapping.cpp:")
    assert "int oops( { }" in result.messages[0]


def test_a_crash_is_told_of_each_test(kit: BuiltKit, step: Step, solved: Sources, tmp_path: Path) -> None:
    source = solved[_ID].replace("std::lround(", "*static_cast<volatile int*>(nullptr) + std::lround(")
    assert source != solved[_ID]
    result, _ = _look(kit, step, source, tmp_path)
    assert result.status == "partial"
    assert "crashed" in {test.outcome for test in result.tests}
    assert "ok" in {test.outcome for test in result.tests}
    assert "crashed" in result.images[0].message


def test_what_is_not_written_is_said_and_no_mistake(
    project: Project, kit: BuiltKit, step: Step, tmp_path: Path
) -> None:
    """Pictures wait for it, too."""
    source = make_stub((project.solutions / step.path).read_text(encoding="utf-8"), step, ["to_byte"])
    result, _ = _look(kit, step, source, tmp_path)
    assert result.messages == ["Not written yet: tone_map."]
    assert {image.waits_for for image in result.images if not image.passed} == {"tone_map"}
    console = Console(file=io.StringIO(), width=200)
    view = StepView(step, "idle", result=result, complete=True)
    TerminalView(console).result(view)
    assert isinstance(console.file, io.StringIO)
    assert console.file.getvalue().splitlines()[1].strip() == "Not written yet: tone_map."
    assert verdict(view)[0] == "warn"


def test_nobody_waits_in_silence_for_what_hangs(
    kit: BuiltKit, step: Step, solved: Sources, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stopped = TestResult("to_byte", False, "It was stopped.", outcome="timeout")

    def hang(*words: Any) -> list[TestResult]:
        words[-1]("stopped: to_byte")
        return [replace(stopped, name=name) for name in kit.tests[_ID]]

    monkeypatch.setattr(worker, "run_tests", hang)
    said: list[str] = []
    QuickLook(kit, step, LimitsOnly(), tmp_path, say=said.append).look(solved[_ID])
    assert said == ["stopped: to_byte"]


def test_the_stub_shows_where_it_goes(kit: BuiltKit, step: Step, unsolved: Sources, tmp_path: Path) -> None:
    result, _ = _look(kit, step, "// mine\n" + unsolved[_ID], tmp_path)
    assert result.status == "not-started"
    assert [image.name for image in result.images] == [case.name for case in step.images]
    for image in result.images:
        assert image.mine is None
        assert image.reference
        assert (tmp_path / image.reference).is_file()


@pytest.mark.usefixtures("kit")
def test_the_worker_does_a_job(project: Project, steps: list[Step]) -> None:
    """Whatever stands in the step now: a student's clone holds other things than the stub."""
    job = json.dumps({"kind": "look", "root": str(project.root), "step": steps[0].id})
    ran = subprocess.run(WORKER, input=job + "\n", capture_output=True, text=True, check=True, timeout=300)
    last = json.loads(ran.stdout.splitlines()[-1])
    assert last["complete"]
    assert set(last["result"]) == {field.name for field in dataclasses.fields(StepResult)}
    assert last["out"] == str(project.build / "watch")


def test_a_worker_says_where_it_cannot_write(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def locked(*_: object) -> None:
        raise OSError(errno.EROFS, "Read-only file system", "/kit/build")

    monkeypatch.setattr(worker, "look", locked)
    job = json.dumps({"kind": "look", "root": str(tmp_path), "step": _ID})
    monkeypatch.setattr("sys.stdin", io.StringIO(job + "\n"))
    monkeypatch.setattr(signal, "signal", lambda *_: None)
    assert worker.main() == 0
    assert json.loads(capsys.readouterr().out)["error"] == "/kit/build: the disk is read-only"


def test_a_worker_without_a_job_ends() -> None:
    ran = subprocess.run(WORKER, input="", capture_output=True, text=True, check=False, timeout=60)
    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "", "")
