"""What a search costs in the scene of a picture."""

import pytest

from raysteps.common.process import Outcome
from raysteps.judge.drawing import Draw
from raysteps.judge.nff_random import random_scene
from raysteps.judge.nff_reading import read_scene
from raysteps.judge.scene_probes import ProbedScene, least_share, least_shares
from raysteps.judge.worker_client import Ask
from raysteps.kit.built_kit import BuiltKit
from raysteps.kit.project import Project
from raysteps.programs.asking import reference_answers
from raysteps.programs.rendering import reference_rays
from raysteps.sandbox.task import Ran

_SIZE = ("--step", "6", "--accel", "octree", "--size", "80x60")


@pytest.mark.parametrize(
    ("scene", "surfaces", "lights"),
    [
        ("lessons/many-spheres", 70, 3),
        ("lessons/thin-triangles", 49, 4),
        ("lessons/inside-sphere", 22, 2),
        ("generated/tetrahedra", 256, 3),
    ],
)
def test_the_scenes_of_the_pictures_can_be_read(project: Project, scene: str, surfaces: int, lights: int) -> None:
    read = read_scene((project.root / "scenes" / f"{scene}.nff").read_text(encoding="utf-8"))
    assert read is not None
    assert (len(read.surfaces), len(read.lights)) == (surfaces, lights)


def test_made_up_scenes_can_be_read() -> None:
    read = read_scene(random_scene(Draw("1"), 5, 7))
    assert read is not None
    assert len(read.surfaces) == 5 + 7 + 2


@pytest.mark.parametrize("line", ["c", "pp 3", "s 0 0 0 -1", "s 0 0", "p 3", "p three"])
def test_of_other_scenes_nothing_is_said(line: str) -> None:
    assert read_scene(f"from 0 0 5\nat 0 0 0\nup 0 1 0\nangle 40\nl 1 2 3\n{line}\n") is None


def test_the_least_share() -> None:
    scene = ProbedScene("picture", "", 1.0, 10, seen=0.2, onward=0.5)
    assert least_share(scene, [1.0] * 4) == pytest.approx(0.8 * 0.7)
    assert least_share(scene, [0.5] * 4) == pytest.approx(0.8 * 0.7 / 4)
    assert least_share(scene, [1.0, 1.0, 0.0, 0.0]) == pytest.approx(0.8 * 0.2)


def _saying(line: str) -> Ask:
    """A worker that answers the one question that it is asked with this."""
    return lambda _cases, _seconds: Ran(Outcome(0, False, f"start 0\n{line}end 1\n", "", 0.1), {}, 0.1, "")


def test_a_good_tree_costs_little_and_silence_buys_nothing(kit: BuiltKit) -> None:
    path = kit.project.root / "scenes/lessons/thin-triangles.nff"
    count = reference_rays(kit, path, _SIZE)
    assert (count.surfaces, count.eye) == (49, 80 * 60)
    rays = count.eye + count.onward
    nff = path.read_text(encoding="utf-8")
    scene = ProbedScene("slivers", nff, 80 / 60, count.surfaces, count.eye_hit / rays, count.onward / rays)

    def reference(cases: bytes, _seconds: float) -> Ran:
        return reference_answers(kit, cases)

    assert 0 < least_shares([scene], reference, reference, 10)["slivers"] < 0.05
    for silent in ("", "done 0 \n", "done 0 rubbish\n", "done 0 0 miss\n", "done 0 " + "0 miss " * 200 + "\n"):
        assert least_shares([scene], _saying(silent), reference, 10)["slivers"] > 0.4

    odd = ProbedScene("odd", nff + "c\n", 1.0, 49, 0.5, 0.5)
    assert least_shares([odd], reference, reference, 10) == {}
