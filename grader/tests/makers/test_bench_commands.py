"""Benchmarks: what is said of wrong arguments and missing programs, and one real run."""

import json
import os
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from rich.console import Console

from raysteps.cli.app import main
from raysteps.common.documents import plain
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.process import run
from raysteps.course.project import Project
from tools.bench.command import KINDS
from tools.bench.docs import bench_docs
from tools.bench.model import (
    ListedStructure,
    Listing,
    Machine,
    ParseNumbers,
    ParseRow,
    ScaleNumbers,
    SceneRays,
    Spread,
    keep,
    kept,
)
from tools.bench.programs import ask, can_pin_processor, checked, pinned, portable, what_is_missing

_MACHINE = Machine("a processor", 2, "Linux x86_64", "g++", "-O2", pinned=True)


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
    assert capsys.readouterr().err == "raysteps: no-such-scene.nff: is not there; expected a scene\n"


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
    without, complete = (
        Listing("raysteps/bench-structures/v1", version, [ListedStructure(name, False, False)])
        for version, name in (("", "bvh"), ("3.13.5", "wide"))
    )
    highway, embree, povray = what_is_missing(without)
    assert "apt-get install libhwy-dev" in highway
    assert "apt-get install libembree-dev" in embree
    assert "apt-get install povray" in povray
    assert what_is_missing(complete) == [povray]


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
        keep(project, ParseNumbers(machine=_MACHINE, rows=[]), Console(quiet=True))
    assert kept(project, ParseNumbers) is None


def test_what_was_measured_is_read_again(tmp_path: Path) -> None:
    project, time = Project(tmp_path), Spread.of([1.0, 2.0])
    numbers = ParseNumbers(machine=_MACHINE, rows=[ParseRow("rings", 10, 2, time)])
    keep(project, numbers, Console(quiet=True))
    assert kept(project, ParseNumbers) == numbers
    place = tmp_path / "build" / "bench" / "parse.json"
    document = json.loads(place.read_text(encoding="utf-8"))
    assert list(document) == ["schema", "machine", "rows"]
    del document["rows"][0]["megabytes_per_second"]["q1"]
    place.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(UsageError, match=r"parse\.json: .*\$\.rows\[0\]\.megabytes_per_second: .* q1; measure again"):
        kept(project, ParseNumbers)


def test_only_what_the_program_should_say_is_taken(tmp_path: Path) -> None:
    program = tmp_path / "raysteps-bench"
    told: dict[str, object] = {"schema": "raysteps/bench-reading/v1", "bytes": 10, "surfaces": 2}
    told["megabytes_per_second"] = plain(Spread.of([3.0]))
    for said in (told, told | {"more": 1}):
        program.write_text(f"#!/bin/sh\necho '{json.dumps(said)}'\n", encoding="utf-8")
        program.chmod(0o755)
        if said is told:
            assert ask(ParseRow, program, "parse", scene="rings") == ParseRow("rings", 10, 2, Spread.of([3.0]))
        else:
            with pytest.raises(GraderFault, match=r"raysteps-bench parse: \$: unknown key 'more'"):
                ask(ParseRow, program, "parse", scene="rings")


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
        kept(project, ScaleNumbers)


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
    measured = ask(
        SceneRays, programs.bench, "render", scene, "--size", "48", "--rounds", "1", "--structures", "octree"
    )
    told = json.loads(stats.read_text(encoding="utf-8"))
    kinds = ("eye", "shadow", "reflect", "refract")
    found = {kind: getattr(measured.rays, kind) for kind in kinds}
    assert found == {kind: told["rays"][kind] for kind in kinds}
    assert all(number > 0 for number in found.values())
    (side,) = measured.structures
    assert side.surface_tests_per_ray == pytest.approx(told["tests_per_ray"], rel=1e-6)
    assert side.box_tests_per_ray * side.rays == pytest.approx(told["box_tests"], rel=1e-6)


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
