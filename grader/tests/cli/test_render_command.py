"""The arguments of `render`."""

import subprocess
import sys
from pathlib import Path

import pytest

from raysteps.cli import render
from raysteps.cli.app import main
from raysteps.cli.render import build_mine, run_raytrace, take_impl
from raysteps.cli.todo_steps import advice, as_far_as_written
from raysteps.common.errors import StudentBuildError, UsageError
from raysteps.common.process import Outcome, run
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.course.stubs import stub_for
from raysteps.images.compare import read_png, read_ppm
from raysteps.toolchain.cmake import BuildTree, release_tree
from raysteps.toolchain.kit_artifacts import BuiltKit


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
    assert run_raytrace(program, []) == 1
    assert "your program crashed (SIGSEGV: memory" in capsys.readouterr().err


def test_odd_columns_do_not_matter(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "abc")
    assert main(["grade", "/no/such/submission"]) == 2


def test_a_picture_of_another_kind_is_refused_before_anything_is_built(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["render", "scene.nff", "-o", "picture.jpg"]) == 2
    assert "picture.jpg: pictures are written as .png or .ppm" in capsys.readouterr().err


@pytest.mark.parametrize("command", ["render", "view", "inspect"])
def test_a_scene_that_is_not_there_is_told_before_anything_is_built(
    command: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(BuildTree, "build", lambda *words: pytest.fail("it was built"))
    more = ["1", "2", "--step", "1"] if command == "inspect" else ["--step", "1"]
    assert main([command, "scenes/nope.nff", *more]) == 2
    assert "scenes/nope.nff: is not there; expected a scene, such as scenes/lessons/" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"), [(["-o", "one.png"], "Picture: one.png\n"), (["-o", "one.png", "--quiet"], "")]
)
def test_it_says_where_the_picture_is(
    words: list[str], said: str, kit: BuiltKit, project: Project, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    scene = str(project.scenes / "lessons" / "three-spheres.nff")
    assert main(["render", scene, "--impl", "reference", "--size", "8x6", "--step", "1", *words]) == 0
    assert capfd.readouterr().out == said
    assert (tmp_path / "one.png").is_file()


def test_a_picture_that_goes_where_it_prints_holds_nothing_else(
    kit: BuiltKit, project: Project, tmp_path: Path
) -> None:
    scene, out = str(project.scenes / "lessons" / "three-spheres.nff"), tmp_path / "here.ppm"
    words = ["render", scene, "--impl", "reference", "--size", "8x6", "--step", "1", "-o", str(out)]
    with out.open("wb") as file:
        done = subprocess.run([sys.executable, "-m", "raysteps", *words], stdout=file, check=False, timeout=600)
    assert done.returncode == 0
    assert read_ppm(out).shape == (6, 8, 3)
    assert out.stat().st_size == len(b"P6\n8 6\n255\n") + 8 * 6 * 3


def _written(project: Project, root: Path, *numbers: int) -> Project:
    """A course in which these steps are written."""
    for step in read_steps(project):
        place = root / "steps" / step.id
        place.mkdir(parents=True)
        (place / "step.toml").write_bytes((project.steps / step.id / "step.toml").read_bytes())
        source = (project.samples / "complete" / "steps" / step.path).read_text(encoding="utf-8")
        (root / "steps" / step.path).write_text(
            source if step.index in numbers else stub_for(project, step), encoding="utf-8"
        )
    return Project(root)


@pytest.mark.parametrize(("written", "wanted", "said"), [(0, 8, "not started"), (2, 8, "--step 2"), (2, 2, "")])
def test_a_picture_that_needs_more_than_is_written(
    project: Project, tmp_path: Path, written: int, wanted: int, said: str
) -> None:
    told = advice(_written(project, tmp_path, *range(1, written + 1)), wanted)
    assert said in told
    assert bool(said) == bool(told)


@pytest.mark.parametrize(
    ("written", "words", "more"),
    [
        ((), [], []),
        ((1, 2), [], ["--step", "2"]),
        ((1, 2, 4), [], ["--step", "2"]),
        ((1, 2), ["--step", "3"], []),
        ((1, 2, 3, 4, 5), [], ["--step", "5"]),
        ((1, 2, 3, 4, 5, 7), [], ["--step", "7", "--accel", "none"]),
        ((1, 2, 3, 4, 5, 7), ["--step", "7"], ["--accel", "none"]),
        ((1, 2, 3, 4, 5, 7), ["--step", "7", "--accel", "octree"], []),
        ((1, 2, 3, 4, 5, 7), ["--step", "6"], []),
        ((1, 2, 3, 4, 5, 6, 7), [], ["--step", "7"]),
        ((1, 2, 3, 4, 5, 6, 7, 8), [], []),
        ((1, 2, 3, 4, 5, 7, 9), ["--step", "9"], []),
    ],
)
def test_a_picture_goes_as_far_as_is_written_and_does_without_a_tree(
    project: Project, tmp_path: Path, written: tuple[int, ...], words: list[str], more: list[str]
) -> None:
    added, said = as_far_as_written(_written(project, tmp_path, *written), words)
    assert added == more
    assert said == (f"--step {more[1]}, the last that your steps can draw" if "--step" in more[:1] else "")


@pytest.mark.parametrize(("words", "found"), [(["--step", "99"], "99"), (["--step", "x"], "x"), (["--step"], "")])
def test_a_step_that_is_none_is_all_that_is_told(
    words: list[str], found: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Neither advice for it nor a build comes first."""
    assert main(["render", "scene.nff", "-o", "picture.png", *words]) == 2
    assert capsys.readouterr().err == f"raysteps: --step: expected a whole number from 1 to 9, found '{found}'\n"


@pytest.mark.parametrize(("code", "advised"), [(2, False), (0, True)])
def test_words_that_the_program_refuses_get_no_advice(
    project: Project,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    code: int,
    advised: bool,
) -> None:
    program = tmp_path / "raytrace-mine"
    program.write_text(f"#!/bin/sh\nexit {code}\n")
    program.chmod(0o755)
    monkeypatch.setattr(render, "build_mine", lambda _: program)
    (tmp_path / "scene.nff").touch()
    words = [str(tmp_path / "scene.nff"), "-o", "picture.png"]
    assert render.run_words(_written(project, tmp_path, 1, 2), words) == code
    assert ("--step 2, the last that your steps can draw" in capsys.readouterr().err) == advised


def test_only_the_first_build_is_said_to_take_long(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Not each one until the student's steps build."""
    failed = Outcome(1, timed_out=False, stdout="", stderr="", seconds=1)
    monkeypatch.setattr(BuildTree, "build", lambda *_: failed)
    tree = release_tree(_written(project, tmp_path))
    for said in ("raysteps: building; the first time takes a minute or two\n", ""):
        with pytest.raises(StudentBuildError):
            build_mine(tree)
        assert capsys.readouterr().err == said


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (
            ["scene.nff"],
            2,
            "raysteps render: expected -o FILE for the picture\nAll options: ./raysteps render --help\n",
        ),
        (["--help"], 0, "Usage: raysteps render SCENE.nff -o OUT.png"),
    ],
)
def test_the_renderer_speaks_of_the_command_that_a_person_types(
    kit: BuiltKit, words: list[str], code: int, said: str
) -> None:
    outcome = run([kit.reference("raytrace"), *words], seconds=60)
    assert outcome.code == code
    assert said in outcome.stdout + outcome.stderr


def test_a_png_has_the_pixels_of_the_ppm(kit: BuiltKit, project: Project, tmp_path: Path) -> None:
    scene = project.scenes / "lessons" / "three-spheres.nff"
    for name in ("a.ppm", "a.png"):
        words: list[str | Path] = [kit.reference("raytrace"), scene, "--size", "67x41", "-o", tmp_path / name]
        assert run(words, seconds=60).code == 0
    assert (read_png(tmp_path / "a.png") == read_ppm(tmp_path / "a.ppm")).all()
