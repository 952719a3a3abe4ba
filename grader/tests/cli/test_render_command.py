"""The arguments of `render`."""

import subprocess
import sys
from pathlib import Path
from shutil import rmtree
from types import ModuleType

import pytest
from course_fakes import written_course

from raysteps.cli import render, view
from raysteps.cli.app import main
from raysteps.cli.render import build_mine, place_of_scene, run_raytrace, take_impl
from raysteps.cli.todo_steps import advice, as_far_as_written, last_written, refuse_missing_tree
from raysteps.common.errors import StudentBuildError, UsageError
from raysteps.common.process import Outcome, run
from raysteps.course.project import Project
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


def test_a_picture_that_never_ends_is_told_while_it_is_drawn(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    told = tmp_path / "told"
    program = tmp_path / "raytrace-mine"
    program.write_text(f"#!/bin/sh\nfor i in $(seq 1000); do test -e {told} && exit 0; sleep 0.01; done; exit 1\n")
    program.chmod(0o755)

    def say(text: str) -> None:
        print(text)
        told.touch()

    monkeypatch.setattr(render, "_say", say)
    monkeypatch.setattr(render, "_LONG", 0.01)
    assert render._run_mine(program, []) == 0
    assert "one of your functions may never end" in capfd.readouterr().out


def test_odd_columns_do_not_matter(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "abc")
    assert main(["grade", "/no/such/submission"]) == 2


@pytest.mark.parametrize("command", [render, view])
def test_help_needs_no_steps_that_build(command: ModuleType, project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[Path] = []
    monkeypatch.setattr(render, "build_reference", lambda tree, target: Path(target))
    monkeypatch.setattr(render, "build_mine", lambda *_: pytest.fail("a step may not build"))
    monkeypatch.setattr(view, "check_glfw", lambda _: None)
    monkeypatch.setattr(command, "run_raytrace", lambda program, args: ran.append(program))
    command.run_words(project, ["--help"])
    assert ran == [Path("raytrace-reference" if command is render else "view-reference")]


@pytest.mark.parametrize("name", ["picture.jpg", "picture", "mine.v2", ".png"])
def test_a_picture_of_another_kind_is_refused_before_anything_is_built(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["render", "scene.nff", "-o", name]) == 2
    assert f"{name}: pictures are written as .png or .ppm; expected a name such as mine.png" in capsys.readouterr().err


@pytest.mark.parametrize("command", ["render", "view", "inspect"])
def test_a_scene_that_is_not_there_is_told_before_anything_is_built(
    command: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(BuildTree, "build", lambda *words: pytest.fail("it was built"))
    more = ["1", "2", "--step", "1"] if command == "inspect" else ["--step", "1"]
    assert main([command, "scenes/nope.nff", *more]) == 2
    assert "scenes/nope.nff: is not there; expected a scene, such as scenes/lessons/" in capsys.readouterr().err


@pytest.mark.parametrize("words", [[], ["-o", "a.png", "--step", "1"]])
@pytest.mark.parametrize("command", ["render", "view"])
def test_a_scene_that_nobody_named_is_asked_for_before_anything_is_built(
    command: str, words: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(BuildTree, "build", lambda *words: pytest.fail("it was built"))
    assert main([command, *words]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"raysteps: {command}: expected a scene, like scenes/lessons/three-spheres.nff; all options")


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("three-spheres", "is not there; expected the path of a scene; did you mean {scenes}three-spheres.nff?"),
        ("scenes/lessons/three-sphere.nff", "is not there; expected the path of a scene; did you mean {scenes}three-s"),
        ("own", "is not there; expected the path of a scene; did you mean own.nff?"),
        ("there", "is a folder; expected a scene, such as scenes/lessons/three-spheres.nff; others of the kit"),
        ("qqq", "is not there; expected a scene, such as scenes/lessons/three-spheres.nff; others of the kit"),
    ],
)
@pytest.mark.parametrize("command", ["render -o a.png --quiet", "view --click 1,1", "inspect", "finale"])
def test_a_name_that_is_no_path_is_answered_with_one(
    command: str, typed: str, said: str, project: Project, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.setattr(BuildTree, "build", lambda *words: pytest.fail("it was built"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "own.nff").touch()
    (tmp_path / "there").mkdir()
    more = ["1", "2", "--step", "1"] if command == "inspect" else []
    assert main([*command.split(), typed, *more]) == 2
    scenes = f"{project.scenes}/lessons/"
    assert capsys.readouterr().err.startswith(f"raysteps: {typed}: {said.format(scenes=scenes)}")


@pytest.mark.parametrize(
    ("typed", "said"),
    [
        ("render {scene} --size 8x8", "render: expected -o FILE for the picture; all options: ./raysteps render"),
        ("render {scene} -o there", "there: is a folder; expected the name of a file to write"),
        ("render {scene} -o a.png --stats there", "there: is a folder; expected the name of a file to write"),
        ("render {scene} -o new/a.png", "new/a.png: there is no folder new; make it first, or write elsewhere"),
        ("render {scene} -o new/a.png -o a.jpg", "a.jpg: pictures are written as .png or .ppm"),
        ("view {scene} --screenshot new/a.ppm", "new/a.ppm: there is no folder new; make it first, or write elsewhere"),
        ("inspect {scene} 1 2 --step 1 --json there", "there: is a folder; expected the name of a file to write"),
        ("inspect {scene} 1 2 --step 1 --html there", "there: is a folder; expected the name of a file to write"),
        ("inspect {scene} 1 2 --step 1 --html new/a.html", "new/a.html: there is no folder new; make it first"),
        ("convert {scene} -o new/a.pbrt", "new/a.pbrt: there is no folder new; make it first"),
        ("similar there --out new/a.html", "new/a.html: there is no folder new; make it first"),
    ],
)
def test_a_place_that_nothing_can_be_written_to_is_told_before_anything_is_built(
    typed: str, said: str, project: Project, tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.setattr(BuildTree, "build", lambda *words: pytest.fail("it was built"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there").mkdir()
    assert main(typed.format(scene=project.scenes / "template.nff").split()) == 2
    assert capsys.readouterr().err.startswith(f"raysteps: {said}")
    assert [path.name for path in tmp_path.iterdir()] == ["there"]


def test_of_several_places_the_last_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    program = tmp_path / "raytrace-mine"
    program.write_text("#!/bin/sh\nexit 0\n")
    program.chmod(0o755)
    monkeypatch.setattr(render, "build_mine", lambda _: program)
    course = written_course(tmp_path, 1)
    words = [str(course.scenes / "template.nff"), "-o", "a.png", "--step", "9", "-o", "b.png", "--step", "1"]
    assert render.run_words(course, words) == 0
    assert capsys.readouterr().out == "Picture: b.png\n"


@pytest.mark.parametrize("folder", [False, True])
def test_a_source_that_is_not_there_is_told_with_what_brings_it_back(
    folder: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(BuildTree, "build", lambda *words: pytest.fail("it was built"))
    course = written_course(tmp_path, 1, 2)
    path = course.steps / "02-intersection" / "intersection.cpp"
    path.unlink()
    if folder:
        path.mkdir()
    said = r"^steps/02-intersection/intersection\.cpp: is {}; expected your step 02; .* reset 02 puts its stub there$"
    with pytest.raises(StudentBuildError, match=said.format("a folder" if folder else "not there")):
        build_mine(release_tree(course))


@pytest.mark.parametrize(
    ("typed", "scene"),
    [
        ("a -o b", "a"),
        ("-o b a", "a"),
        ("--quiet a -o b", "a"),
        ("--step 3 --spd a", "a"),
        ("--size=320x240 a", "a"),
        ("-o b", None),
        ("--help a", None),
        ("", None),
    ],
)
def test_the_scene_is_the_word_that_belongs_to_no_option(typed: str, scene: str | None) -> None:
    words = typed.split()
    place = place_of_scene(words)
    assert (None if place is None else words[place]) == scene


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


@pytest.mark.parametrize(("written", "wanted", "said"), [(0, 8, "not started"), (2, 8, "--step 2"), (2, 2, "")])
def test_a_picture_that_needs_more_than_is_written(tmp_path: Path, written: int, wanted: int, said: str) -> None:
    told = advice(written_course(tmp_path, *range(1, written + 1)), wanted)
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
    tmp_path: Path, written: tuple[int, ...], words: list[str], more: list[str]
) -> None:
    added, said = as_far_as_written(written_course(tmp_path, *written), words)
    assert added == more
    assert said == (f"--step {more[1]}, the last that your steps can draw" if "--step" in more[:1] else "")


@pytest.mark.parametrize(
    ("written", "words", "said"),
    [
        ((1,), ["--accel", "octree"], r"^--accel octree: step 06 is not written yet: expected Box::clip, .* steps/0"),
        ((1,), ["--step", "6", "--accel", "octree"], "step 06 is not written yet"),
        ((1, 6), ["--accel", "bvh", "--step", "6"], r"step 09 .* steps/09-bvh/bvh\.cpp; --accel none draws the same"),
        ((1, 6), ["--accel", "octree"], None),
        ((1,), ["--accel", "none"], None),
        ((1,), ["--accel"], None),
    ],
)
def test_a_tree_that_would_find_nothing_is_refused_before_anything_is_built(
    project: Project, tmp_path: Path, written: tuple[int, ...], words: list[str], said: str | None
) -> None:
    course = written_course(tmp_path, *written)
    if said is None:
        refuse_missing_tree(course, words)
        return
    for command in (render, view):
        with pytest.raises(UsageError, match=said):
            command.run_words(course, [str(project.scenes / "template.nff"), "-o", "picture.png", *words])


def test_a_tree_that_is_begun_shows_in_the_picture_of_its_own_step_only(tmp_path: Path) -> None:
    course = written_course(tmp_path, 1, 2, 3, 4, 5, 6)
    path = course.steps / "06-octree" / "octree.cpp"
    path.write_text(path.read_text() + 'void f() { RAYSTEPS_TODO("06-octree", "occluded_in_octree"); }\n')
    refuse_missing_tree(course, ["--step", "6", "--accel", "octree"])
    with pytest.raises(UsageError, match=r"^--accel octree: .* expected occluded_in_octree in steps/06"):
        refuse_missing_tree(course, ["--step", "5", "--accel", "octree"])


def test_a_course_may_have_no_tree(tmp_path: Path) -> None:
    course = written_course(tmp_path, 1)
    rmtree(course.steps / "06-octree")
    with pytest.raises(UsageError, match=r"^--accel octree: this course has no step 06, which builds it; --accel none"):
        refuse_missing_tree(course, ["--accel", "octree"])


def test_a_file_that_is_not_there_is_not_written(tmp_path: Path) -> None:
    course = written_course(tmp_path, 1, 2, 3)
    (course.steps / "02-intersection" / "intersection.cpp").unlink()
    assert last_written(course) == 1


@pytest.mark.parametrize(("words", "found"), [(["--step", "99"], "99"), (["--step", "x"], "x"), (["--step"], "")])
def test_a_step_that_is_none_is_all_that_is_told(
    words: list[str], found: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Neither advice for it nor a build comes first."""
    assert main(["render", "scene.nff", "-o", "picture.png", *words]) == 2
    assert capsys.readouterr().err == f"raysteps: --step: expected the number of a step, 1-9, found '{found}'\n"


@pytest.mark.parametrize(("code", "advised"), [(2, False), (0, True)])
def test_words_that_the_program_refuses_get_no_advice(
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
    assert render.run_words(written_course(tmp_path, 1, 2), words) == code
    assert ("--step 2, the last that your steps can draw" in capsys.readouterr().err) == advised


def test_only_the_first_build_is_said_to_take_long(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Not each one until the student's steps build."""
    failed = Outcome(1, timed_out=False, stdout="", stderr="", seconds=1)
    monkeypatch.setattr(BuildTree, "build", lambda *_: failed)
    tree = release_tree(written_course(tmp_path))
    for said in ("raysteps: building; the first time may take a minute\n", ""):
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


@pytest.mark.parametrize(
    ("scene", "words", "is_black"),
    [
        ("lessons/cornell.pbrt", "--step 9", True),
        ("lessons/cornell.pbrt", "--step 11", True),
        ("lessons/cornell.pbrt", "--step 12", False),
        ("lessons/cornell.pbrt", "--step 2 --view normals", False),
        ("lessons/cornell.pbrt", "--step 9 --map tests", False),
        ("lessons/metals.pbrt", "--step 9", False),  # it has a sky
        ("lessons/three-spheres.nff", "--step 9", False),
    ],
)
def test_lamps_that_a_step_does_not_know_are_said(
    whole_kit: BuiltKit, project: Project, tmp_path: Path, scene: str, words: str, is_black: bool
) -> None:
    program = whole_kit.reference("raytrace")
    typed: list[str | Path] = [
        program,
        project.scenes / scene,
        "--size",
        "8x8",
        *words.split(),
        "-o",
        tmp_path / "a.ppm",
    ]
    outcome = run(typed, seconds=60)
    assert outcome.code == 0
    assert ("which shine from step 12 on only" in outcome.stderr) == is_black
    assert bool(read_ppm(tmp_path / "a.ppm").any()) == (not is_black)


def test_a_png_has_the_pixels_of_the_ppm(kit: BuiltKit, project: Project, tmp_path: Path) -> None:
    scene = project.scenes / "lessons" / "three-spheres.nff"
    for name in ("a.ppm", "a.png"):
        words: list[str | Path] = [kit.reference("raytrace"), scene, "--size", "67x41", "-o", tmp_path / name]
        assert run(words, seconds=60).code == 0
    assert (read_png(tmp_path / "a.png") == read_ppm(tmp_path / "a.ppm")).all()
