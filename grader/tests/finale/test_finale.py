"""The command `finale`: what it draws with, what it writes, and what it says to wrong words."""

import argparse
import re
import sys
from pathlib import Path
from shutil import rmtree
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from course_fakes import written_course
from rich.console import Console

from raysteps.cli import finale as command
from raysteps.cli.app import main, new_parser
from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.finale import own_pictures
from raysteps.finale.finale_page import has_glyphs, in_words, poster
from raysteps.finale.own_pictures import available_steps
from raysteps.images.compare import read_png
from raysteps.toolchain.kit_artifacts import BuiltKit

_SCENE = """b 0.1 0.2 0.3
v
from 0 0 5
at 0 0 0
up 0 1 0
angle 40
hither 0.01
resolution 200 160
l 4 5 6
f 0.9 0.5 0.1 0.8 0.2 20 0 1
s 0 0 0 1
s 1.5 0 -1 0.7
"""


def _run(project: Project, *words: str) -> int:
    parser = argparse.ArgumentParser()
    command.add_arguments(parser)
    return command.run(project, parser.parse_args(words), Console(width=200))


def _ids(steps: tuple[Step, ...]) -> str:
    return " ".join(step.number for step in steps)


@pytest.mark.parametrize(
    ("written", "drawn", "last", "tree"),
    [
        ("01 02 03 04 05 06 07 08 09", "01 02 03 04 05 06 07 08 09", 8, "bvh"),
        ("01 02 03 04 05 06 07", "01 02 03 04 05 06 07", 7, "octree"),
        ("01 02 03 04 05 07", "01 02 03 04 05 07", 7, "none"),
        ("01 02 03 04 05 06 07 09", "01 02 03 04 05 06 07 09", 7, "bvh"),
        ("01 02 04 05 06", "01 02", 2, "none"),
    ],
)
def test_it_draws_with_as_many_steps_as_are_written(
    steps: list[Step], written: str, drawn: str, last: int, tree: str
) -> None:
    reach = available_steps(steps, {step.id for step in steps if step.number in written.split()})
    assert (_ids(reach.drawn), reach.last, reach.tree) == (drawn, last, tree)
    assert {*reach.drawn, *reach.missing} == set(steps)


@pytest.fixture
def with_reference(kit: BuiltKit, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its program in place of one that would have to be built."""
    monkeypatch.setattr(command, "build_program", lambda tree, name, impl: kit.reference(name))


@pytest.mark.usefixtures("with_reference")
def test_it_writes_picture_page_and_poster_and_the_same_ones_again(
    project: Project, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = tmp_path / "two-balls.nff"
    scene.write_text(_SCENE)
    words = (str(scene), "--name", "Zoë <b>", "--impl", "reference", "-o")
    assert _run(project, *words, str(tmp_path / "a")) == 0
    assert _run(project, *words, str(tmp_path / "b"), "--threads", "1") == 0
    said = capsys.readouterr().out
    assert "two-balls.nff, 9 rays for each pixel" in said
    assert "of the tests spared" in said
    names = ["finale.html", "finale.png", "poster.png"]
    assert sorted(path.name for path in (tmp_path / "a").iterdir()) == names
    for name in names:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes(), name
    picture, framed = read_png(tmp_path / "a/finale.png"), read_png(tmp_path / "a/poster.png")
    assert picture.shape == (160, 200, 3)
    assert np.array_equal(framed[20:180, 20:220], picture)
    page = (tmp_path / "a/finale.html").read_text("utf-8")
    assert "<h1>Two balls</h1>" in page
    assert "Zoë &lt;b&gt;" in page
    assert page.count('alt="After step') == 9
    assert re.search(r"through each\. With [\d.]+ thousand shadow rays and [\d.]+ thousand reflected rays that", page)


@pytest.mark.usefixtures("with_reference")
def test_what_is_missing_is_said_and_the_rest_is_drawn(
    project: Project, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    course = written_course(tmp_path / "course", 1, 2, 3)
    scene = tmp_path / "balls.nff"
    scene.write_text(_SCENE)
    assert _run(course, str(scene), "-o", str(tmp_path / "out")) == 0
    said = capsys.readouterr().out
    assert "not written yet, so without them: 04 Shadows, 05 Reflection" in said
    assert "without step 06 every ray asks every surface" in said
    assert "4 rays for each pixel" in said
    page = (tmp_path / "out/finale.html").read_text("utf-8")
    assert page.count('alt="After step') == 3
    assert page.count("Still to be written.") == 6
    assert page.count("Drawn as it is: not checked yet.") == 3
    assert "reference" not in page
    assert "The work" not in page
    caption = page.partition("<figcaption>")[2].partition("</figcaption>")[0]
    assert re.search(r"4 rays\s+through each\. That makes 128 thousand rays and 256 thousand tests\.", caption)


@pytest.fixture
def both_parts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    course = tmp_path / "course.toml"
    course.write_text("parts = [1, 2]\n")
    monkeypatch.setenv("RAYSTEPS_COURSE", str(course))


@pytest.fixture
def grey_denoiser(monkeypatch: pytest.MonkeyPatch) -> None:
    """In place of Open Image Denoise: as if the whole picture were light 0.5."""

    def denoise(light: np.ndarray[Any, Any], *, hdr: bool) -> np.ndarray[Any, Any]:
        assert hdr, "light is linear and may be above 1"
        assert light.dtype == np.float32
        assert light.std() > 0
        return np.full_like(light, 0.5)

    monkeypatch.setitem(sys.modules, "pyoidn", SimpleNamespace(denoise=denoise, __spec__=object()))


@pytest.mark.usefixtures("with_reference", "both_parts", "grey_denoiser")
def test_a_scene_of_part_two_is_drawn_with_its_steps_and_cleaned(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(own_pictures, "_SMALL", 32)
    scene = str(project.scenes / "lessons" / "soft-shadows.pbrt")
    words = (scene, "--impl", "reference", "--size", "200x160", "--samples", "4", "--denoise", "-o", str(tmp_path))
    assert _run(project, *words) == 0
    assert "4 rays for each pixel" in capsys.readouterr().out
    assert (read_png(tmp_path / "finale.png") == 188).all(), "0.5 by the curve of sRGB"
    assert read_png(tmp_path / "finale-noisy.png").std() > 10
    page = (tmp_path / "finale.html").read_text("utf-8")
    assert page.count('alt="After step') == 4
    assert page.count("lamps that have a size shine from step 12 on") == 2
    assert "cleaned by Open Image Denoise" in page


@pytest.mark.usefixtures("both_parts")
def test_what_cannot_be_cleaned_is_said_before_anything_is_drawn(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command, "build_program", lambda *words: pytest.fail("it was built"))
    with pytest.raises(UsageError, match=r"expected a scene of part two \(\.pbrt\)"):
        _run(project, "--denoise", "-o", str(tmp_path / "out"))
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    scene = str(project.scenes / "lessons" / "soft-shadows.pbrt")
    with pytest.raises(UsageError, match="pip install pyoidn=="):
        _run(project, scene, "--denoise", "-o", str(tmp_path / "out"))


def test_a_scene_of_part_two_needs_part_two(project: Project, tmp_path: Path) -> None:
    scene = str(project.scenes / "lessons" / "soft-shadows.pbrt")
    with pytest.raises(UsageError, match=r"ends in \.pbrt is for part two: expected step 10"):
        _run(project, scene, "--impl", "reference", "-o", str(tmp_path / "out"))


def test_without_the_first_step_there_is_no_picture(tmp_path: Path) -> None:
    course = written_course(tmp_path / "course", 2, 3)
    with pytest.raises(UsageError, match=r"^step 01 is not written yet, .* steps/01-camera-rays/camera_rays\.cpp; "):
        _run(course)


@pytest.mark.usefixtures("with_reference")
def test_a_mistake_in_the_scene_is_told_with_its_place(
    project: Project, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    scene = tmp_path / "bad.nff"
    scene.write_text(_SCENE.replace("s 0 0 0 1\n", "s 0 0 zero 1\n"))
    assert _run(project, str(scene), "--impl", "reference", "-o", str(tmp_path / "out")) == 2
    assert "bad.nff:11:7: " in capfd.readouterr().err
    assert not list((tmp_path / "out").iterdir())
    scene.write_text(_SCENE.replace("200 160", "20 16"))
    with pytest.raises(UsageError, match=r"resolution is 20x16: expected 160 to 8192 pixels .* --size"):
        _run(project, str(scene), "--impl", "reference", "-o", str(tmp_path / "out"))


def test_a_scene_without_a_page_is_told_before_anything_is_built(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(command, "build_program", lambda *words: pytest.fail("it was built"))
    scene, out = tmp_path / "small.nff", tmp_path / "out"
    scene.write_text(_SCENE.replace("resolution 200 160", "# resolution 500 500\nresolution\t9000\n160"))
    with pytest.raises(
        UsageError, match=r"small\.nff: its resolution is 9000x160: expected 160 to 8192 pixels .* --si"
    ):
        _run(project, str(scene), "-o", str(out))
    with pytest.raises(UsageError, match=r"there\.nff: is not there; expected a scene"):
        _run(project, str(tmp_path / "there.nff"), "-o", str(out))
    assert not out.exists()


def test_its_help_says_what_it_takes_in_this_kit(project: Project, tmp_path: Path) -> None:
    def offered(kit: Project) -> str:
        parsers = new_parser(kit, "finale")._subparsers
        assert parsers is not None
        choices = parsers._group_actions[0].choices
        assert isinstance(choices, dict)
        return " ".join(choices["finale"].format_help().split())

    course = written_course(tmp_path)
    assert "from 160 to 8192 pixels a side (1600x900, without a tree 640x360; of your own" in offered(project)
    assert "16 ... 64 (9, without a tree 4)" in offered(course)
    assert "--impl {mine,reference}" in offered(project)
    assert "--impl" not in offered(course)
    rmtree(course.steps / "06-octree")
    assert "without a tree" in offered(course)
    rmtree(course.steps / "09-bvh")
    assert "pixels a side (640x360; of your own" in offered(course)
    assert "16 ... 64 (4)" in offered(course)


def test_a_course_without_trees_hears_of_no_step_06(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    course = written_course(tmp_path / "course", 1)
    for step in ("06-octree", "09-bvh"):
        rmtree(course.steps / step)
    monkeypatch.setattr(command, "build_program", lambda *words: tmp_path / "raytrace-mine")
    monkeypatch.setattr(command, "run_raytrace", lambda *words: 2)
    assert _run(course, "-o", str(tmp_path / "out")) == 2
    said = capsys.readouterr().out
    assert "raysteps: every ray asks every surface, which takes long" in said
    assert "06" not in said.replace(str(tmp_path), "")


def test_a_program_that_crashes_makes_no_page(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    program = tmp_path / "raytrace-mine"
    program.write_text("#!/bin/sh\nkill -SEGV $$\n")
    program.chmod(0o755)
    monkeypatch.setattr(command, "build_program", lambda tree, name, impl: program)
    course = written_course(tmp_path / "course", 1, 2)
    assert _run(course, "-o", str(tmp_path / "out")) == 1
    told = capfd.readouterr()
    assert "your program crashed (SIGSEGV" in told.err
    assert "no finale without the large picture" in told.out
    assert not list((tmp_path / "out").iterdir())


def test_a_new_scene_never_takes_the_place_of_a_file(
    project: Project, tmp_path: Path, kit: BuiltKit, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "my scene.nff"
    assert _run(project, "--new", str(path)) == 0
    assert f"finale '{path}'\n" in capfd.readouterr().out
    assert path.read_bytes() == (project.scenes / "template.nff").read_bytes()
    path.write_text("changed")
    with pytest.raises(UsageError, match=r"my scene\.nff: is there already, and stays as it is"):
        _run(project, "--new", str(path))
    assert path.read_text() == "changed"
    with pytest.raises(UsageError, match=r"mine\.txt: expected a name that ends in \.nff"):
        _run(project, "--new", str(tmp_path / "mine.txt"))
    with pytest.raises(UsageError, match=r"no-folder/a\.nff: cannot be written"):
        _run(project, "--new", str(tmp_path / "no-folder/a.nff"))
    with pytest.raises(UsageError, match=r"a\.nff: --new writes a scene and draws none"):
        _run(project, "a.nff", "--new", str(tmp_path / "b.nff"))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--size", "640"], "expected WxH in pixels, each from 160 to 8192, like 1600x900"),
        (["--size", "100x9000"], "expected WxH in pixels"),
        (["--samples", "10"], "10: expected a square number from 1 to 64, like 16"),
        (["--threads", "0"], "expected a whole number from 1 to 1024"),
        (["--name", "x" * 61], "expected one line of at most 60 letters"),
        (["--impl", "yours"], "none of its values"),
        (["--sampels", "4"], "--sampels: there is no such option; did you mean --samples?"),
        (["--step", "4"], "--step: there is no such option\n"),
    ],
)
def test_wrong_words_are_refused_before_anything_is_built(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["finale", *words])
    assert ended.value.code == 2
    assert said in capsys.readouterr().err


def test_results_need_a_folder(project: Project, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(UsageError, match="is a file; expected a folder"):
        _run(project, "-o", str(tmp_path / "file"))


def test_a_poster_writes_what_its_letters_can(tmp_path: Path) -> None:
    picture = np.full((160, 300, 3), 200, np.uint8)
    plain, named = poster(picture, "Title", "", ""), poster(picture, "Title", "Ann", "")
    assert plain.shape == named.shape == (160 + 30 + 50, 360, 3)
    assert not np.array_equal(plain, named)
    assert has_glyphs("Ann Example")
    assert not has_glyphs("\uffff")
    assert np.array_equal(poster(picture, "Title", "\uffff", ""), plain), "better no name than a wrong one"
    long = poster(picture, "W" * 60, "", "")
    assert np.array_equal(long[:190, 35:325], plain[:190, 35:325])
    assert (long[200:, :10] == long[0, 0]).all(), "a long title keeps off the edge"


def test_large_numbers_are_told_in_words() -> None:
    assert [in_words(amount) for amount in (7, 640_000, 31_240_000, 8_166_000_000)] == [
        "7",
        "640 thousand",
        "31.2 million",
        "8.17 billion",
    ]
