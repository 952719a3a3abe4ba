"""Which scenes the gallery shows, what it makes of a student's steps, and the page that comes out."""

import argparse
import json
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from conftest import MakeSubmission, Sources
from rich.console import Console

from raysteps.cli import gallery as command
from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.manifest import Step, kit_steps
from raysteps.course.mutants import reference_source
from raysteps.course.project import Project
from raysteps.gallery import shots as reference
from raysteps.gallery.shots import (
    GalleryScene,
    MySteps,
    PictureOptions,
    about_scene,
    gallery_scenes,
    picture_args,
    usual_scenes,
)
from raysteps.images.render import reference_picture
from raysteps.submission.load import Submission, load_submission
from raysteps.toolchain.kit_artifacts import BuiltKit

_SIZE = "24x16"
_SMALL = PictureOptions(_SIZE, 4)


def _run(project: Project, *words: str) -> int:
    parser = argparse.ArgumentParser()
    command.add_arguments(parser)
    return command.run(project, parser.parse_args(words), Console(width=150))


def test_every_step_has_words_of_its_own(steps: list[Step]) -> None:
    words = [step.about for step in steps]
    assert len(set(words)) == len(steps)
    assert all(word != step.title for word, step in zip(words, steps, strict=True))


def test_scenes_are_found_by_name_and_by_file(project: Project, steps: list[Step], tmp_path: Path) -> None:
    assert [scene.name for scene in gallery_scenes(project, [], steps)] == usual_scenes(steps)
    file = tmp_path / "my-own.nff"
    file.write_text("# A ball in the dark: nothing else.\n# More words.\nv\n")
    found = gallery_scenes(project, ["glass", str(file), "glass"], steps)
    assert [(scene.name, scene.title) for scene in found] == [("glass", "Glass"), ("my-own", "My own")]
    assert found[1].words == "A ball in the dark"
    assert about_scene("empty", tmp_path / "nowhere.nff") == ("Empty", "")
    with pytest.raises(UsageError, match=r"--scene nowhere: is not there; expected a scene's file or one of .*glass"):
        gallery_scenes(project, ["nowhere"], steps)


def test_the_scenes_of_a_course_show_all_its_steps_and_each_only_where_it_has_something_to_show(
    project: Project,
) -> None:
    every = kit_steps(project)
    of_part = {part: [step for step in every if step.part == part] for part in (1, 2)}
    assert usual_scenes(of_part[1]) == ["showcase", "sphereflake", "facing-mirrors", "mountain", "gears"]
    assert usual_scenes(of_part[2]) == ["studio", "cornell", "plates", "still-life"]
    assert usual_scenes(every) == [name for part in (1, 2) for name in usual_scenes(of_part[part])]
    scenes = {scene.name: scene for scene in gallery_scenes(project, [], every)}
    more = replace(every[0], id="20-more")
    assert scenes["showcase"].shows(more), "a step of one's own, of part one"
    shown = {name: [step.number for step in every if scene.shows(step)] for name, scene in scenes.items()}
    assert shown["studio"] == ["09", *(step.number for step in of_part[2])]
    assert shown["showcase"][-1] == "10"
    assert shown["cornell"] == ["12", "13"]
    with pytest.raises(
        UsageError, match=r"--scene cornell: shows no step of this course; .*`parts`.*, or one of showcase,"
    ):
        gallery_scenes(project, ["cornell"], of_part[1])


def test_pictures_of_part_two_take_samples_and_are_smaller(project: Project) -> None:
    every = kit_steps(project)
    showcase, studio = gallery_scenes(project, ["showcase", "studio"], every)
    third, tenth = every[2], every[9]
    assert picture_args(third, showcase, PictureOptions()) == ("--step", "3", "--size", "800x600", "--accel", "octree")
    assert picture_args(tenth, showcase, PictureOptions()) == ("--step", "10", "--size", "800x600")
    assert picture_args(tenth, studio, PictureOptions("", 49)) == (
        *("--step", "10", "--size", "480x360"),
        *("--samples", "49"),
    )
    ninth = picture_args(every[8], studio, PictureOptions("64x48"))
    assert ninth == ("--step", "9", "--size", "64x48")
    in_capitals = replace(studio, path=Path("STUDIO.PBRT"))
    assert picture_args(tenth, in_capitals, PictureOptions()) == picture_args(tenth, studio, PictureOptions())
    assert in_capitals.shows(every[10])


@pytest.mark.parametrize(
    ("option", "word", "said"),
    [
        *(("--samples", word, "expected a square number from 1 to 4096") for word in ("10", "0", "4225", "many")),
        *(("--size", word, "expected WxH in pixels") for word in ("640", "8x8", "640x9999", "axb")),
    ],
)
def test_a_number_that_makes_no_sense_is_refused(
    project: Project, tmp_path: Path, option: str, word: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        _run(project, "--out", str(tmp_path), option, word)
    assert ended.value.code == 2
    assert said in capsys.readouterr().err


def test_a_scene_that_cannot_be_read_is_the_users_mistake(project: Project, kit: BuiltKit, tmp_path: Path) -> None:
    scene = tmp_path / "bad.nff"
    scene.write_text("nonsense\n")
    with pytest.raises(UsageError, match=r"bad\.nff"):
        _run(project, "--out", str(tmp_path / "out"), "--scene", str(scene), "--size", _SIZE)


def test_a_scene_that_is_too_large_to_be_traced_without_a_tree_shows_no_work(
    project: Project, steps: list[Step], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def too_slow(*_args: object) -> None:
        raise GraderFault("the reference cannot render it")

    monkeypatch.setattr(reference, "reference_picture", too_slow)
    kit: Any = SimpleNamespace(project=project, steps=steps)
    own = GalleryScene("large", "Large", "", tmp_path / "large.nff")
    assert reference.reference_work_maps(kit, own, lambda words: None) == {}
    (glass,) = gallery_scenes(project, ["glass"], steps)
    with pytest.raises(GraderFault):
        reference.reference_work_maps(kit, glass, lambda words: None)


def test_a_page_is_made_of_the_kits_own_scene(
    project: Project, kit: BuiltKit, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert _run(project, "--out", str(tmp_path), "--scene", "three-spheres", "--size", _SIZE) == 0
    page = (tmp_path / "index.html").read_text("utf-8")
    assert "Three spheres" in page
    assert page.count("data:image/png") > len(kit.steps)
    assert "three-spheres: step 09" in capsys.readouterr().err


def test_steps_that_cannot_be_shown_are_notes_and_the_others_are_shown(
    project: Project,
    kit: BuiltKit,
    steps: list[Step],
    solved: Sources,
    unsolved: Sources,
    make_submission: MakeSubmission,
    tmp_path: Path,
) -> None:
    camera, intersection, phong, shadows = (step.id for step in steps[:4])
    sources = {
        camera: solved[camera],
        intersection: "int nonsense",
        phong: unsolved[phong],
        shadows: solved[shadows],
    }
    submission = load_submission(make_submission("ann", sources), steps)
    (scene,) = gallery_scenes(project, ["three-spheres"], steps)
    mine = MySteps(kit, submission, tmp_path / "build", lambda words: None)
    shots = [shot for step in steps[:5] if (shot := mine.shot(step, scene, _SMALL)) is not None]
    assert len(shots) == 5
    assert [shot.pixels is not None for shot in shots] == [True, False, False, True, False]
    assert shots[1].note.startswith("It does not build: intersection.cpp:1")
    assert shots[2].note == "Step 03 is not started: phong_shading.cpp is still the stub."
    assert shots[3].note == "The reference stands in for 02 and 03."
    expected = reference_picture(kit, scene.path, ("--step", "4", "--size", _SIZE))
    assert np.array_equal(shots[3].pixels, expected)  # type: ignore[arg-type]
    assert mine.work_maps(scene) == {}


def test_a_walk_through_part_two_is_made_of_one_scene(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    course = tmp_path / "course.toml"
    course.write_text("parts = [2]\n")
    monkeypatch.setenv("RAYSTEPS_COURSE", str(course))
    out = tmp_path / "out"
    words = ("--scene", "studio", "--scene", "plates", "--size", _SIZE, "--samples", "4")
    assert _run(project, "--out", str(out), *words) == 0
    page = (out / "index.html").read_text("utf-8")
    data = json.loads(page.split('<script type="application/json" id="data">')[1].split("</script>")[0])
    studio, plates = data["scenes"]
    pictures = [shot["picture"] for shot in studio["reference"]]
    assert len(set(pictures)) == len(pictures) == 6, "each step of part two adds something to the studio"
    assert [shot is not None for shot in plates["reference"]] == [False] * 4 + [True] * 2


def test_ones_own_steps_of_part_two_are_shown_beside_the_references(
    project: Project, kit: BuiltKit, tmp_path: Path
) -> None:
    both = replace(kit, steps=kit_steps(project))
    chosen = [step for step in both.steps if step.number in ("11", "12")]
    meshes, soft_light = chosen
    dark = reference_source(project, soft_light).replace("return radiance * hit", "return 0.5F * radiance * hit")
    sources = {meshes.id: reference_source(project, meshes).encode(), soft_light.id: dark.encode()}
    submission = Submission("ann", sources, {})
    (studio,) = gallery_scenes(project, ["studio"], both.steps)
    mine = MySteps(both, submission, tmp_path / "build", lambda words: None)
    assert mine.shot(both.steps[0], studio, _SMALL) is None, "it is shown from step 09 on"
    shots = [mine.shot(step, studio, _SMALL) for step in chosen]
    pictures = [shot.pixels for shot in shots if shot is not None and shot.pixels is not None]
    right = [reference_picture(kit, studio.path, picture_args(step, studio, _SMALL)) for step in chosen]
    assert np.array_equal(pictures[0], right[0])
    assert pictures[1].mean() < right[1].mean() - 1
