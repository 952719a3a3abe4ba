"""The command `check`: one report of all steps, whatever was checked last."""

import subprocess
import sys
from argparse import Namespace
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from conftest import Sources
from course_fakes import checked, small_project, write_own
from rich.console import Console

from raysteps.cli import check as check_command
from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub
from raysteps.progress import check, own_check
from raysteps.report.attempts import read_attempts
from raysteps.results.model import Diagnosis, Results, Termination, TestResult
from raysteps.results.store import REPORT, read_results
from raysteps.sandbox.task import Sandbox
from raysteps.submission.load import Submission
from raysteps.toolchain.compile import NOTHING_AHEAD
from raysteps.toolchain.kit_artifacts import BuiltKit

_CODE = "int answer() { return 42; }\n"


class _Kit(SimpleNamespace):
    """What `check` asks of one."""

    def in_one_process(self) -> "_Kit":
        return self


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    """Whatever is checked passes."""
    project = small_project(tmp_path)
    kit = _Kit(fingerprint="one", steps=read_steps(project), has_reference=False, project=project)

    def look_through(_kit: Any, _submission: Any, chosen: Sequence[Step], *_: Any, **__: Any) -> Results:
        return Results.of("steps", [checked(step, "passed", 6.5).steps[0] for step in chosen], kit=kit.fingerprint)

    monkeypatch.setattr(check, "build_kit", lambda *_: kit)
    monkeypatch.setattr(check, "_compiled_ahead", lambda *_: NOTHING_AHEAD)
    monkeypatch.setattr(own_check, "_look_through", look_through)
    return project


def _check(course: Project, *numbers: int) -> list[str]:
    """The steps that are in the results."""
    chosen = [step for step in read_steps(course) if step.index in numbers]
    for step in chosen:
        write_own(course, step, _CODE)
    check.check_steps(course, chosen, lambda _: None)
    return [result.id[:2] for result in read_results(course.build / "check" / "results.json").steps]


def _page(course: Project) -> str:
    return (course.build / "check" / REPORT).read_text(encoding="utf-8")


def test_a_step_takes_its_place_among_the_others(course: Project) -> None:
    assert _check(course, 2) == ["02"]
    assert _check(course, 1) == ["01", "02"]
    assert _check(course, 2) == ["01", "02"]
    assert read_results(course.build / "check" / "results.json").total.points == 13


def test_the_next_thing_to_do_is_the_real_one(course: Project) -> None:
    _check(course, 1)
    assert "Next comes 02 " in _page(course)
    _check(course, *range(2, 10))
    assert "Nothing: every step is right." in _page(course)


def test_another_kit_begins_anew(course: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    _check(course, 1)
    other = _Kit(fingerprint="two", steps=read_steps(course), has_reference=False, project=course)
    monkeypatch.setattr(check, "build_kit", lambda *_: other)
    assert _check(course, 2) == ["02"]


def test_what_was_found_before_outlives_a_check_that_fails(course: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    _check(course, 1, 2)

    def fail(*_: Any, **__: Any) -> Results:
        raise KeyboardInterrupt

    monkeypatch.setattr(own_check, "_look_through", fail)
    with pytest.raises(KeyboardInterrupt):
        _check(course, 2)
    assert [result.id[:2] for result in read_results(course.build / "check" / "results.json").steps] == ["01"]


def test_an_interrupted_check_leaves_a_page_of_the_other_steps(
    course: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    _check(course, 1, 2)

    def fail(*_: Any, **__: Any) -> Results:
        raise KeyboardInterrupt

    with monkeypatch.context() as interrupted:
        interrupted.setattr(own_check, "_look_through", fail)
        with pytest.raises(KeyboardInterrupt):
            _check(course, 2)
    assert "step-01" in _page(course)
    assert "step-02" not in _page(course)
    assert _check(course, 2) == ["01", "02"]


def test_what_is_found_is_there_before_its_mistakes_have_names(
    course: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = course.build / "check"
    told: list[bool] = []

    def find_and_learn(
        kit: Any,
        _submission: Any,
        chosen: Sequence[Step],
        _ahead: Any,
        _out: Path,
        _say: Any,
        tell: Callable[[Results], None],
        **_: Any,
    ) -> Results:
        tell(Results.of("steps", [checked(step, "partial", 3).steps[0] for step in chosen], kit=kit.fingerprint))
        raise KeyboardInterrupt

    def tell(found: own_check.CheckResult) -> None:
        told.append(found.page == out / REPORT and REPORT in {path.name for path in out.iterdir()})

    monkeypatch.setattr(own_check, "_look_through", find_and_learn)
    with pytest.raises(KeyboardInterrupt):
        check.check_steps(course, read_steps(course)[:1], lambda _: None, tell)
    assert told == [True]
    assert [result.points for result in read_results(out / "results.json").steps] == [3]
    assert [attempt.points for attempt in read_attempts(out)] == [3]


@pytest.mark.parametrize(("named", "outcome"), [(False, "wrong"), (True, "wrong"), (False, "crashed")])
def test_whoever_waits_for_known_mistakes_hears_what_came_of_it(
    course: Project, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
    named: bool, outcome: Termination,
) -> None:  # fmt: skip
    monkeypatch.setattr(Project, "has_reference", True)

    def find_and_learn(project: Project, _chosen: Any, _say: Any, tell: Callable[[own_check.CheckResult], None]) -> Any:
        results = checked(read_steps(project)[0], "partial", 3)
        results.steps[0].tests = [TestResult("one", False, outcome=outcome)]
        kit: Any = SimpleNamespace(steps=read_steps(project))
        tell(own_check.CheckResult(kit, results, None, None))
        results.steps[0].diagnoses += [Diagnosis("mistake", "one", "the one mistake", "", "", "", [])] if named else []
        return own_check.CheckResult(kit, results, None, None)

    monkeypatch.setattr(check_command, "check_steps", find_and_learn)
    assert check_command.run(course, Namespace(steps=["01"]), Console(width=200)) == 1
    said = capsys.readouterr().out
    assert ("the one mistake" in said, "none of them explains" in said) == (named, not named and outcome == "wrong")


def test_files_of_the_kit_that_changed_are_named_below_the_results(
    course: Project, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    write_own(course, read_steps(course)[0], _CODE)
    for changed in ("", "Not as the kit was given out: a.hpp."):
        monkeypatch.setattr(check_command, "about_changed", lambda _, said=changed: said)
        assert check_command.run(course, Namespace(steps=["01"]), Console(width=200)) == 0
        assert capsys.readouterr().out.count("Not as the kit was given out: a.hpp.\n") == bool(changed)


def test_the_report_tells_how_it_went_and_what_is_newer_than_its_check(course: Project) -> None:
    _check(course, 1)
    assert "How it went" not in _page(course)
    _check(course, 2)
    assert "from 6.5 of " in _page(course)
    assert [attempt.points for attempt in read_attempts(course.build / "check")] == [6.5, 13]
    first = read_steps(course)[0]
    write_own(course, first, _CODE.replace("42", "43"))
    _check(course, 2)
    assert _page(course).count("Changed since it was checked") == 1
    _check(course, 1)
    assert "Changed since it was checked" not in _page(course)


_NO_COMPILER = """
import sys
from pathlib import Path
from types import SimpleNamespace

from raysteps.cli import app
from raysteps.course.project import Project
from raysteps.progress import check

def stop(*_):
    print(*sys.modules)
    sys.exit(0)

project = Project(Path(sys.argv[1]))
kit = SimpleNamespace(steps=[])
kit.in_one_process = lambda: kit
app.here = lambda: project
check.build_kit = lambda *_: kit
check.load_submission = lambda *_: None
check._compiled_ahead = stop
sys.exit(app.main(["check", "01"]))
"""


def test_the_compiler_is_started_before_what_grades_is_imported(tmp_path: Path) -> None:
    words: list[str | Path] = [sys.executable, "-P", "-c", _NO_COMPILER, small_project(tmp_path).root]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    there = set(done.stdout.split())
    assert "raysteps.toolchain.compile" in there
    assert {"numpy", "jinja2", "raysteps.grading.step"}.isdisjoint(there)


@pytest.mark.parametrize("has_reference", [True, False])
def test_what_is_compiled_ahead(
    kit: BuiltKit, solved: Sources, has_reference: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The chosen steps that were begun; a student's own libraries are looked through where the kit is a student's."""
    one, stub, missing, other = kit.steps[:4]
    built: dict[str, object] = {}

    class Build:
        def __init__(self, _kit: object, sandbox: Sandbox, _folder: Path, kept: object) -> None:
            built.update(kept=kept, sandbox=sandbox)

        def compile(self, step: Step, source: bytes, _limits: object) -> str:
            return f"{step.number}: {len(source)}"

    monkeypatch.setattr(check, "StudentBuild", Build)
    sources = {step.id: solved[step.id].encode() for step in (one, other)}
    sources[stub.id] = pristine_stub(kit.project, stub).encode()
    fake: Any = SimpleNamespace(
        project=kit.project, has_reference=has_reference, limits_of=kit.limits_of, fingerprint=kit.fingerprint
    )
    with ExitStack() as ends:
        ahead = check._compiled_ahead(fake, Submission("steps", sources, {}), [one, stub, missing], ends)
        told: dict[str, Any] = {step: future.result() for step, future in ahead.steps.items()}
    assert told == {one.id: f"01: {len(sources[one.id])}"}
    assert (built["kept"] is None) == has_reference
    assert built["sandbox"] is ahead.sandbox, "what it takes is counted"
