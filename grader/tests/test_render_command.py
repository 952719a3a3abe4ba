"""The arguments of `render`."""

from pathlib import Path

import pytest

from raysteps.cli import main
from raysteps.commands.render import run_raytrace, take_impl
from raysteps.common.errors import UsageError


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
