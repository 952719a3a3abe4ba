"""Where results go, and what is deleted there."""

from pathlib import Path

import pytest

from raysteps.cli.demo import complain_about
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import usable_folder
from raysteps.course.manifest import Step
from raysteps.grading.step import clear_old_results
from raysteps.results.model import Results, StepResult


def test_only_old_results_are_deleted(tmp_path: Path, steps: list[Step]) -> None:
    old = [f"pictures/{steps[0].id}/a-{kind}.png" for kind in ("mine", "reference", "difference")]
    others = ["pictures/cover.png", f"pictures/{steps[1].id}/notes.txt", "pictures/elsewhere/a-mine.png", "page.md"]
    for name in [*old, *others, "results.json"]:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("x")
    clear_old_results(tmp_path, steps, steps)
    left = sorted(path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file())
    assert left == sorted(others)
    assert not (tmp_path / "pictures" / steps[0].id).exists()


def test_folders_that_become_empty_go(tmp_path: Path, steps: list[Step]) -> None:
    folder = tmp_path / "pictures" / steps[0].id
    folder.mkdir(parents=True)
    (folder / "a-mine.png").touch()
    clear_old_results(tmp_path, steps, steps)
    assert not list(tmp_path.iterdir())


def test_links_are_not_followed(tmp_path: Path, steps: list[Step]) -> None:
    outside = tmp_path / "outside" / steps[0].id
    outside.mkdir(parents=True)
    (outside / "a-mine.png").touch()
    out = tmp_path / "out"
    out.mkdir()
    (out / "pictures").symlink_to(outside.parent)
    clear_old_results(out, steps, steps)
    assert (outside / "a-mine.png").exists()


def test_a_folder_that_cannot_be_written_is_a_usage_error(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(UsageError, match="is a file; expected a folder"):
        usable_folder(tmp_path / "file")
    with pytest.raises(UsageError, match="cannot be written"):
        usable_folder(tmp_path / "file" / "below")


def test_the_demo_checks_its_samples(steps: list[Step]) -> None:
    results = Results.of("a", [StepResult(step.id, "passed", step.points, step.points, step.bonus) for step in steps])
    complain_about("complete", results)
    with pytest.raises(GraderFault, match="partial got 120"):
        complain_about("partial", results)
    results.steps[3].points = 5.0
    complain_about("partial", results)
    with pytest.raises(GraderFault, match="complete got 115"):
        complain_about("complete", results)
