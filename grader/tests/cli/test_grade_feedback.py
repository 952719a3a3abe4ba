"""What `grade` prints: no more than results.json tells."""

import io
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from page_results import document_of, wrong_step
from rich.console import Console

from raysteps.cli import grade as command
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.settings import COURSE_VARIABLE
from raysteps.results.model import Feedback, Results, Settings


def _grades_to(monkeypatch: pytest.MonkeyPatch, found: Results, steps: list[Step]) -> dict[str, Any]:
    """Gives what the pipeline is told by name."""
    told: dict[str, Any] = {}

    def grade(*_: Any, **options: Any) -> Results:
        told.update(options)
        return found

    for name, value in {
        "find_sandbox": None,
        "load_submission": None,
        "build_kit": SimpleNamespace(steps=steps),
    }.items():
        monkeypatch.setattr(command, name, lambda *_, value=value, **__: value)
    monkeypatch.setattr(command, "grade_submission", grade)
    return told


@pytest.mark.parametrize(
    ("feedback", "seen", "unseen"),
    [
        ("full", ["normal is not of length 1", "direction (1, 0, 0)", "replay"], []),
        ("diagnosis", ["normal is not of length 1"], ["direction (1, 0, 0)", "replay"]),
        ("score", ["hidden cases"], ["normal is not of length 1", "direction (1, 0, 0)", "replay", "mirror"]),
    ],
)
def test_the_terminal_tells_no_more_than_the_results(
    monkeypatch: pytest.MonkeyPatch,
    project: Project,
    steps: list[Step],
    tmp_path: Path,
    feedback: Feedback,
    seen: list[str],
    unseen: list[str],
) -> None:
    found = document_of([wrong_step(steps[2], tmp_path)])
    _grades_to(monkeypatch, found, steps)
    console = Console(file=io.StringIO(), width=200)
    options = command.GradeOptions(tmp_path / "ann", tmp_path / "out", Settings(feedback))
    assert command.grade(project, options, console) == found
    printed = console.file.getvalue()  # type: ignore[attr-defined]
    assert [words for words in seen if words not in printed] == []
    assert [words for words in unseen if words in printed] == []


def test_the_course_is_told_to_what_writes_the_results(
    monkeypatch: pytest.MonkeyPatch, project: Project, steps: list[Step], tmp_path: Path
) -> None:
    """It writes them also where the grader then fails."""
    (tmp_path / "course.toml").write_text('title = "Optics"\nterm = "2026"\n')
    monkeypatch.setenv(COURSE_VARIABLE, str(tmp_path / "course.toml"))
    told = _grades_to(monkeypatch, document_of([wrong_step(steps[2], tmp_path)]), steps)
    out = tmp_path / "out"
    command.grade(project, command.GradeOptions(tmp_path / "ann", out, Settings()), Console(file=io.StringIO()))
    assert told["course"] == "Optics, 2026"
    assert not (out / "results.json").exists()  # written once, and not here


def test_what_was_graded_into_the_folder_before_is_not_replaced_in_silence(
    monkeypatch: pytest.MonkeyPatch, project: Project, steps: list[Step], tmp_path: Path
) -> None:
    _grades_to(monkeypatch, document_of([wrong_step(steps[2], tmp_path)]), steps)
    said = []
    for only in ((), (steps[2].id,)):
        console = Console(file=io.StringIO(), width=200)
        (tmp_path / "out").mkdir(exist_ok=True)
        (tmp_path / "out" / "results.json").write_text("{}")
        command.grade(project, command.GradeOptions(tmp_path / "ann", tmp_path / "out", Settings(only=only)), console)
        said.append("take the place of all that was graded" in console.file.getvalue())  # type: ignore[attr-defined]
    assert said == [False, True]
