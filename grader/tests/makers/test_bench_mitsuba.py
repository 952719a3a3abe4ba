"""Benchmarks: scenes for Mitsuba, without Mitsuba."""

from pathlib import Path

import defusedxml.ElementTree
import numpy as np
import pytest
from rich.console import Console

from raysteps.cli.app import main
from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.project import Project
from tools.bench.docs import mitsuba_tables
from tools.bench.mitsuba import (
    MitsubaOptions,
    bench_mitsuba,
    mitsuba_xml,
    obj_text,
    read_matt,
    read_pfm,
    refuse_another_scene,
    time_ratio,
)
from tools.bench.model import Machine, MitsubaNumbers, MitsubaRow, PathTimes, Spread

pytestmark = pytest.mark.portable

_SCENE = """# a comment with "quotes"
Scale -1 1 1
LookAt 0 1 5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 64
WorldBegin
LightSource "infinite" "rgb L" [.5 .25 1]
MakeNamedMaterial "red" "string type" "diffuse" "rgb reflectance" [.6 .1 .1]
AttributeBegin
AreaLightSource "diffuse" "rgb L" [1 2 3] "float scale" 2
Material "diffuse" "rgb reflectance" [0 0 0]
Translate 1 2 3
Shape "sphere" "float radius" 0.5
AttributeEnd
NamedMaterial "red"
Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [0 0 0  1 0 0  0 1 0]
"""


def test_numbers_arrive_where_they_belong() -> None:
    scene = read_matt(_SCENE)
    lamp, floor = scene.shapes
    assert (lamp.ball, lamp.emission, lamp.reflectance) == (((1, 2, 3), 0.5), (2, 4, 6), (0, 0, 0))
    assert (floor.emission, floor.reflectance, floor.indices) == (None, (0.6, 0.1, 0.1), (0, 1, 2))
    assert scene.sky == (0.5, 0.25, 1)
    assert obj_text(floor) == "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    root = defusedxml.ElementTree.fromstring(mitsuba_xml(scene, 32, "independent"))
    values = {f"{one.tag} {one.get('name', '')}": one.get("value") for one in root.iter()}
    assert values["float fov"] == "40"
    assert values["integer width"] == values["integer height"] == "32"
    assert [one.get("value") for one in root.iter("rgb")] == ["0.5, 0.25, 1", "0, 0, 0", "2, 4, 6", "0.6, 0.1, 0.1"]
    look = next(root.iter("lookat"))
    assert (look.get("origin"), look.get("target")) == ("0, 1, 5", "0, 0, 0")
    assert [one.get("type") for one in root.iter("shape")] == ["sphere", "obj"]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("Scale -1 1 1", "", "begins with `Scale -1 1 1`"),
        ('"float fov" 40', '"float fov" 40 "float lensradius" 1', "lensradius"),
        ('Material "diffuse" "rgb', 'Material "conductor" "rgb', "expected matt surfaces only"),
        ('"point3 P"', '"normal N" [0 0 1 0 0 1 0 0 1] "point3 P"', "triangles without normals"),
        ("Translate 1 2 3", "Rotate 90 1 0 0", "Rotate"),
        ('"float radius" 0.5', "", "not a scene of matt surfaces"),
        ("[0 1 2]", "[0 1 2", "not a scene of matt surfaces"),
    ],
)
def test_what_has_no_counterpart_is_refused(old: str, new: str, said: str) -> None:
    assert old in _SCENE
    with pytest.raises(UsageError, match=said):
        read_matt(_SCENE.replace(old, new))


def test_the_scenes_that_are_compared_are_matt(project: Project) -> None:
    cornell = read_matt((project.scenes / "lessons" / "cornell.pbrt").read_text("utf-8"))
    assert sum(len(shape.indices) // 3 for shape in cornell.shapes) == 2 * (1 + 3 + 2 + 2 * 5)
    sky = read_matt((project.scenes / "lessons" / "open-sky.pbrt").read_text("utf-8"))
    assert [shape.ball is not None for shape in sky.shapes].count(True) == 3


def test_a_picture_is_read_from_its_last_row_up() -> None:
    rows = np.arange(12, dtype="<f4").reshape(2, 2, 3)
    data = b"PF\n2 2\n-1.0\n" + rows.tobytes()
    assert np.array_equal(read_pfm(data), rows[::-1])
    with pytest.raises(GraderFault, match="expected a PFM"):
        read_pfm(data[:-1])


def test_another_picture_is_not_compared() -> None:
    light = np.ones((32, 32, 3))
    light[:16] = 2.0
    refuse_another_scene(light * 1.005, light, "a")
    for other in (light * 1.02, light[::-1]):
        with pytest.raises(GraderFault, match="not the same picture"):
            refuse_another_scene(other, light, "a")


def test_less_noise_is_worth_as_much_as_less_time() -> None:
    theirs, ours = PathTimes("m", Spread.of([2.0]), 0.5, 1.0), PathTimes("r", Spread.of([1.0]), 1.0, 1.0)
    assert time_ratio(theirs, ours) == pytest.approx(1.0)
    machine = Machine("a processor", 2, "Linux x86_64", "g++", "-O2", pinned=True)
    row = MitsubaRow("box", [theirs, PathTimes("r", Spread.of([1.0]), 0.25, 1.0)])
    table = mitsuba_tables(MitsubaNumbers(machine=machine, version="3", size=32, samples=16, rows=[row]))
    assert "| box | r | 1.000 (1.000 to 1.000) | 0.25 | 1.00000 | 0.25 |" in table


def test_without_mitsuba_it_is_told_how_to_get_it(
    project: Project, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bench", "mitsuba"]) == 2
    assert "pip install mitsuba==" in capsys.readouterr().err
    with pytest.raises(UsageError, match="is not there"):
        bench_mitsuba(project, MitsubaOptions(tmp_path / "python", []), Console())
