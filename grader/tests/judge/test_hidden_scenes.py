"""Twins of the visible pictures, and made-up scenes."""

from dataclasses import replace
from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.judge.hidden_scenes import HiddenScene, hidden_scenes, perturbed_scene
from raysteps.judge.plan import read_plan
from raysteps.judge.random_source import RandomSource

pytestmark = pytest.mark.portable


def _scenes(project: Project, step: Step, seed: int) -> list[HiddenScene]:
    plan = read_plan(project, step)
    assert plan is not None
    return hidden_scenes(project, step, plan, seed)


def _lines(nff: str) -> list[str]:
    return [line for line in nff.splitlines() if not line.startswith("#")]


def test_every_picture_has_a_twin_in_another_size(project: Project, steps: list[Step]) -> None:
    for step in steps:
        scenes = _scenes(project, step, 1)
        twins = {scene.twin_of: scene for scene in scenes if scene.twin_of}
        assert list(twins) == [image.name for image in step.images]
        assert len({scene.name for scene in scenes}) == len(scenes)
        for image in step.images:
            twin = twins[image.name]
            assert len(twin.args) == len(image.args)
            assert sum(a != b for a, b in zip(twin.args, image.args, strict=True)) == 1, "only the size"
            assert 0.3 < twin.max_wrong / image.max_wrong < 3, "a twin shows nearly the same"
            assert (twin.max_share is None) == (image.max_share is None)


def test_a_twin_moves_the_camera_a_little_and_keeps_the_rest(project: Project, steps: list[Step]) -> None:
    for step in steps:
        for scene in _scenes(project, step, 1):
            image = next((image for image in step.images if image.name == scene.twin_of), None)
            if image is None:
                continue
            before = _lines((project.root / image.scene).read_text(encoding="utf-8"))
            after = _lines(scene.nff)
            differing = [(a, b) for a, b in zip(before, after, strict=True) if a != b]
            assert [a for a, _ in differing if a.startswith(("from ", "LookAt "))], scene.name
            assert all(a.startswith(("from ", "s ", "LookAt ")) and a[:2] == b[:2] for a, b in differing), scene.name
            for a, b in differing:
                old, new = ([float(word) for word in line.split()[1:]] for line in (a, b))
                is_view = a.startswith(("from ", "LookAt "))
                reach = 0.15 * max(1.0, *(abs(x) for x in old)) if is_view else 0.06 * old[3]
                assert all(abs(x - y) < max(reach, 1.0 * is_view) for x, y in zip(old, new, strict=True))


def test_the_seed_decides(project: Project, steps: list[Step]) -> None:
    for step in steps:
        assert _scenes(project, step, 1) == _scenes(project, step, 1)
        pairs = zip(_scenes(project, step, 1), _scenes(project, step, 2), strict=True)
        assert all(one.nff != other.nff for one, other in pairs)


def test_a_scene_of_an_unknown_form_is_the_kits_fault() -> None:
    with pytest.raises(GraderFault, match="from x y z"):
        perturbed_scene("v\nfrom\n1 2 3\nat 0 0 0\nup 0 1 0\n", RandomSource("seed"), spheres=False)


def test_spheres_that_are_seen_from_inside_stay() -> None:
    nff = "from 0 0 9\nat 0 0 0\nup 0 1 0\ns 0 0 0 1\ns 0 0 0 -40\n"
    lines = perturbed_scene(nff, RandomSource("seed"), spheres=True).splitlines()
    assert lines[4] == "s 0 0 0 -40"
    assert lines[3] != "s 0 0 0 1"


def test_a_scene_of_pbrts_form_moves_the_eye_and_nothing_else() -> None:
    scene = "Scale -1 1 1\nLookAt 0 2 9  0 1 0  0 1 0\nWorldBegin\n"
    before, line, after = perturbed_scene(scene, RandomSource("seed"), spheres=False).splitlines()
    assert (before, after) == ("Scale -1 1 1", "WorldBegin")
    words = line.split()
    assert words[0] == "LookAt"
    assert words[4:] == ["0", "1", "0", "0", "1", "0"]
    assert words[1:4] != ["0", "2", "9"]


def test_a_picture_without_a_twin_is_named(project: Project, steps: list[Step]) -> None:
    step = steps[0]
    names = [image.name for image in step.images]
    more = replace(step, images=(*step.images, replace(step.images[0], name="mine")))
    said = f"must list a twin for each .*: {', '.join(names)}, mine; found {', '.join(names)}"
    with pytest.raises(GraderFault, match=said):
        read_plan(project, more)


def test_a_scene_that_is_not_there_is_told_with_its_line_in_the_manifest(project: Project, steps: list[Step]) -> None:
    step = steps[3]
    images = (step.images[0], replace(step.images[1], scene="scenes/lessons/nope.nff"), *step.images[2:])
    lines = (project.steps / step.id / "step.toml").read_text().splitlines()
    line = [at for at, text in enumerate(lines, start=1) if text.startswith("scene = ")][1]
    with pytest.raises(GraderFault, match=rf"step.toml:{line}:1: scene: scenes/lessons/nope.nff is not there"):
        read_plan(project, replace(step, images=images))


def test_a_scene_that_is_not_there_is_told_without_hidden_cases(
    project: Project, steps: list[Step], tmp_path: Path
) -> None:
    step, course = steps[3], Project(tmp_path)
    (course.steps / step.id).mkdir(parents=True)
    (course.steps / step.id / "step.toml").write_text((project.steps / step.id / "step.toml").read_text())
    assert read_plan(course, step) is None  # a students' kit
    (course.solutions / step.id).mkdir(parents=True)
    with pytest.raises(GraderFault, match=rf"step.toml:\d+:1: scene: {step.images[0].scene} is not there"):
        read_plan(course, step)
