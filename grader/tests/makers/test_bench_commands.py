"""Benchmarks: what is said of wrong arguments and missing programs, and one real run."""

import json
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from rich.console import Console

from raysteps.cli.app import main
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.process import run
from raysteps.course.project import Project
from tools.bench.docs import bench_docs
from tools.bench.programs import ask, can_pin_processor, checked, pinned, portable, what_is_missing
from tools.bench.records import keep, kept
from tools.bench.scale import KINDS


@pytest.mark.parametrize(
    "words",
    [
        ["bench"],
        ["bench", "speed"],
        ["bench", "render", "--rounds", "0"],
        ["bench", "render", "--size", "8"],
        ["bench", "scale", "--most", "ten"],
        ["bench", "threads", "--rounds", "-1"],
    ],
)
def test_wrong_arguments(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert ended.value.code == 2
    assert "usage: raysteps bench" in capsys.readouterr().err


@pytest.mark.parametrize("what", ["render", "threads", "parse"])
def test_an_unknown_scene(what: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", what, "no-such-scene.nff"]) == 2
    assert capsys.readouterr().err == "raysteps: no-such-scene.nff: there is no such scene\n"


def test_an_unknown_step(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["bench", "loop", "99"]) == 2
    assert "there is no step '99'" in capsys.readouterr().err


def test_two_scenes_of_one_name_could_not_be_told_apart(tmp_path: Path) -> None:
    scenes = [tmp_path / folder / "rings.nff" for folder in ("a", "b")]
    for scene in scenes:
        scene.parent.mkdir()
        scene.touch()
    with pytest.raises(UsageError, match="two scenes have this name"):
        checked(scenes)


def test_what_is_missing_are_named_with_the_way_to_install_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    highway, embree, povray = what_is_missing({"embree_version": "", "structures": [{"name": "bvh"}]})
    assert "apt-get install libhwy-dev" in highway
    assert "apt-get install libembree-dev" in embree
    assert "apt-get install povray" in povray
    assert what_is_missing({"embree_version": "3.13.5", "structures": [{"name": "wide"}]}) == [povray]


@pytest.mark.skipif(not can_pin_processor(), reason="this system pins no programs")
def test_pinning_ends_with_the_measurement() -> None:
    before = os.sched_getaffinity(0)
    with pinned() as works:
        assert works
        assert os.sched_getaffinity(0) == {max(before)}
    assert os.sched_getaffinity(0) == before


def test_only_what_fits_its_schema_is_written(tmp_path: Path) -> None:
    project = Project(tmp_path)
    with pytest.raises(GraderFault, match="not what `bench parse` writes"):
        keep(project, "parse", {"schema": "raysteps/bench-parse/v1"}, Console(quiet=True))
    assert kept(project, "parse") is None


def test_docs_without_any_measurement(tmp_path: Path) -> None:
    (tmp_path / "docs").mkdir()
    (tmp_path / "docs" / "benchmarks.md").write_text("", encoding="utf-8")
    with pytest.raises(UsageError, match="nothing has been measured yet"):
        bench_docs(Project(tmp_path), Console(quiet=True))


def test_numbers_that_somebody_broke(tmp_path: Path) -> None:
    project = Project(tmp_path)
    place = tmp_path / "build" / "bench" / "scale.json"
    place.parent.mkdir(parents=True)
    place.write_text("{", encoding="utf-8")
    with pytest.raises(UsageError, match=r"not JSON.*measure again: \./raysteps bench scale"):
        kept(project, "scale")


@pytest.fixture
def bench_folder(project: Project, tmp_path: Path) -> Iterator[Path]:
    """Where numbers go. Those that were measured in earnest are put back."""
    folder = project.build / "bench"
    if folder.is_dir():
        shutil.copytree(folder, tmp_path / "kept")
    yield folder
    if (tmp_path / "kept").is_dir():
        shutil.copytree(tmp_path / "kept", folder, dirs_exist_ok=True)


@pytest.mark.slow
def test_a_small_run_of_render(project: Project, bench_folder: Path) -> None:
    scene = project.scenes / "lessons" / "many-spheres.nff"
    words = ["bench", "render", str(scene), "--size", "32", "--rounds", "1", "--every", "8", "--no-povray"]
    assert main(words) == 0
    document = json.loads((bench_folder / "render.json").read_text(encoding="utf-8"))
    (measured,) = document["builds"][0]["scenes"]
    kinds = measured["rays"]
    assert kinds["eye"] == 32 * 32
    assert kinds["all"] == sum(kinds[kind] for kind in ("eye", "shadow", "reflect", "refract"))
    sides = {side["name"]: side for side in measured["structures"]}
    assert sides["none"]["rays"] == -(-kinds["all"] // 8)
    assert sides["octree"]["surface_tests_per_ray"] < sides["none"]["surface_tests_per_ray"] <= measured["surfaces"]
    assert sides["octree"]["rays"] == kinds["all"]
    assert all(side["differing"] == 0 for name, side in sides.items() if not name.startswith("embree"))


@pytest.mark.slow
def test_the_recorded_rays_are_those_of_the_picture(project: Project, tmp_path: Path) -> None:
    programs = portable(project)
    scene, stats = project.scenes / "lessons" / "glass.nff", tmp_path / "stats.json"
    drawn: list[str | Path] = [programs.raytrace, scene, "-o", tmp_path / "glass.ppm", "--stats", stats, "--quiet"]
    assert run([*drawn, "--size", "48x48", "--accel", "octree"], seconds=300).code == 0
    measured = ask(programs.bench, "render", scene, "--size", "48", "--rounds", "1", "--structures", "octree")
    told = json.loads(stats.read_text(encoding="utf-8"))
    kinds = ("eye", "shadow", "reflect", "refract")
    assert {kind: measured["rays"][kind] for kind in kinds} == {kind: told["rays"][kind] for kind in kinds}
    assert all(measured["rays"][kind] > 0 for kind in kinds)
    (side,) = measured["structures"]
    assert side["surface_tests_per_ray"] == pytest.approx(told["tests_per_ray"], rel=1e-6)
    assert side["box_tests_per_ray"] * side["rays"] == pytest.approx(told["box_tests"], rel=1e-6)


@pytest.mark.slow
def test_a_small_run_of_scale_and_parse(project: Project, bench_folder: Path) -> None:
    assert main(["bench", "scale", "--most", "100", "--rounds", "1", "--structures", "octree"]) == 0
    rows = json.loads((bench_folder / "scale.json").read_text(encoding="utf-8"))["rows"]
    assert [row["scene"] for row in rows] == list(KINDS)
    assert all(0 < row["surface_tests_per_ray"] < row["surfaces"] for row in rows)
    scene = project.scenes / "lessons" / "glass.nff"
    assert main(["bench", "parse", str(scene), "--rounds", "1"]) == 0
    (row,) = json.loads((bench_folder / "parse.json").read_text(encoding="utf-8"))["rows"]
    assert row["bytes"] == scene.stat().st_size
