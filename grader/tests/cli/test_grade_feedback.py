"""What `grade` prints: no more than results.json tells."""

import io
from pathlib import Path
from types import SimpleNamespace

import pytest
from page_results import document_of, wrong_step
from rich.console import Console

from raysteps.cli import grade as command
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.results.settings import Feedback, Settings


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
    for name, value in {
        "find_sandbox": None,
        "load_submission": None,
        "build_kit": SimpleNamespace(steps=steps),
        "grade_submission": found,
    }.items():
        monkeypatch.setattr(command, name, lambda *_, value=value, **__: value)
    console = Console(file=io.StringIO(), width=200)
    options = command.GradeOptions(tmp_path / "ann", tmp_path / "out", Settings(feedback))
    assert command.grade(project, options, console) == found
    printed = console.file.getvalue()  # type: ignore[attr-defined]
    assert [words for words in seen if words not in printed] == []
    assert [words for words in unseen if words in printed] == []
