"""The arguments of `render`."""

from pathlib import Path

import pytest

from raysteps.cli import main
from raysteps.commands.render import run_raytrace, take_impl
from raysteps.commands.unfinished import advice
from raysteps.common.errors import UsageError
from raysteps.kit.manifest import read_steps
from raysteps.kit.project import Project


def test_impl_is_taken_out() -> None:
    assert take_impl(["a.nff", "-o", "b.ppm"]) == ("mine", ["a.nff", "-o", "b.ppm"])
    assert take_impl(["a.nff", "--impl", "reference", "--quiet"]) == ("reference", ["a.nff", "--quiet"])
    assert take_impl(["--impl=mine"]) == ("mine", [])


@pytest.mark.parametrize("words", [["--impl"], ["--impl", "yours"], ["--impl="]])
def test_other_impls_are_refused(words: list[str]) -> None:
    with pytest.raises(UsageError, match="mine or reference"):
        take_impl(words)


def test_a_crash_of_the_renderer_is_a_failure(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    program = tmp_path / "raytrace-mine"
    program.write_text("#!/bin/sh\nkill -SEGV $$\n")
    program.chmod(0o755)
    with pytest.raises(SystemExit) as caught:
        run_raytrace(program, [])
    assert caught.value.code == 1
    assert "raytrace-mine crashed (SIGSEGV)" in capsys.readouterr().err


def test_odd_columns_do_not_matter(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "abc")
    assert main(["grade", "/no/such/submission"]) == 2


def test_a_picture_of_another_kind_is_refused_before_anything_is_built(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["render", "scene.nff", "-o", "picture.jpg"]) == 2
    assert "picture.jpg: pictures are written as .png or .ppm" in capsys.readouterr().err


@pytest.mark.parametrize(("written", "wanted", "said"), [(0, 8, "not started"), (2, 8, "--step 2"), (2, 2, "")])
def test_a_picture_that_needs_more_than_is_written(
    project: Project, tmp_path: Path, written: int, wanted: int, said: str
) -> None:
    copy = Project(tmp_path)
    for step in read_steps(project):
        manifest = project.root / "steps" / step.path.parent / "step.toml"
        place = tmp_path / "steps" / step.path.parent
        place.mkdir(parents=True)
        (place / "step.toml").write_bytes(manifest.read_bytes())
        folder = project.samples / "complete" if step.index <= written else project.root
        source = folder / "steps" / step.path
        (place / step.path.name).write_bytes(source.read_bytes())
    told = advice(copy, wanted)
    assert said in told
    assert bool(said) == bool(told)
