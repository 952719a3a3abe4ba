"""What `inspect` accepts, how it ends, and when two records are the same."""

import argparse
import copy
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from raysteps.cli.app import main
from raysteps.cli.inspect import InspectOptions, InspectResult, add_arguments, compare, inspect, last_good_step
from raysteps.cli.inspect import run as start
from raysteps.cli.render import build_program
from raysteps.common.documents import convert, plain
from raysteps.common.errors import UsageError
from raysteps.common.process import run
from raysteps.course.manifest import read_all_steps, read_steps
from raysteps.course.project import Project
from raysteps.images.compare import read_ppm
from raysteps.inspector.divergence import find_divergence
from raysteps.inspector.model import RayCounts, Record
from raysteps.toolchain.cmake import release_tree

SIZE = ("--size", "40x30")
Change = Callable[[Record], None]


@pytest.fixture(scope="session")
def program(project: Project) -> Path:
    return build_program(release_tree(project), "inspect", "reference")


@pytest.fixture(scope="session")
def raytrace(project: Project) -> Path:
    tree = release_tree(project)
    with tree.locked():
        assert tree.build(["raytrace-reference"]).code == 0
    return tree.program("raytrace-reference")


def pixel_of(project: Project, scene: str, x: int, y: int, step: int = 8, *options: str) -> InspectOptions:
    path = project.scenes / "lessons" / f"{scene}.nff"
    return InspectOptions(str(path), str(x), str(y), step, (*SIZE, *options))


@pytest.fixture(scope="session")
def record(project: Project, program: Path) -> Record:
    """A pixel on a mirror, in which another ball is seen."""
    found = inspect(program, pixel_of(project, "three-spheres", 24, 15)).record
    assert found is not None
    return found


def script(folder: Path, text: str) -> Path:
    path = folder / "inspect-mine"
    path.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
    path.chmod(0o755)
    return path


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["scene.nff", "1", "2"], "scene.nff: is not there; expected a scene"),
        (["scene.nff", "1", "2", "--step", "16"], "there is no step '16'"),
        (["scene.nff", "1", "2", "--impl", "reference", "--against", "reference"], "expected your own steps"),
    ],
)
def test_what_cannot_be_inspected_is_said(words: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", *words]) == 2
    assert says in capsys.readouterr().err


@pytest.mark.parametrize("words", [["80,60"], ["80,60", "1"], ["one", "2"], ["80", "-6"], ["80x60"]])
def test_a_pixel_that_is_not_two_numbers_is_said(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["inspect", "scene.nff", *words])
    assert caught.value.code == 2
    wrong = next(word for word in words if not word.isdecimal())
    assert f"expected X and Y, two whole numbers from 0 on like 80 60, found '{wrong}'" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ((40, 3), "expected X from 0 to 39 and Y from 0 to 29"),
        ((3, 3, 8, "--depth", "0"), "--depth: expected a whole number"),
        ((3, 3, 8, "--accel", "wide"), "expected none, boxes, octree or bvh"),
    ],
)
def test_the_program_refuses_too(project: Project, program: Path, options: tuple[Any, ...], says: str) -> None:
    with pytest.raises(UsageError, match=says.replace(".", r"\.")):
        inspect(program, pixel_of(project, "three-spheres", *options))


def test_a_scene_that_is_none_is_named(project: Project, program: Path, tmp_path: Path) -> None:
    scene = tmp_path / "scene.nff"
    scene.write_text("s 0 0 zero 1\n", encoding="utf-8")
    with pytest.raises(UsageError, match=r"scene\.nff:1"):
        inspect(program, InspectOptions(str(scene), "1", "1", 8))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("kill -SEGV $$", "crashed (SIGSEGV: memory"),
        ("sleep 30", "did not come to an end"),
        ("exit 7", "gave up with exit code 7"),
        ("exit 0", "left no record"),
        (
            'echo \'{"schema": "raysteps/inspect/v2"}\' > "$7"',
            "left no record that can be read: $.schema: invalid",
        ),
        ('echo "{" > "$7"', "left no record that can be read: is not JSON, or only a part of it (line 2, column 1)"),
    ],
)
def test_how_a_program_of_a_student_may_end(tmp_path: Path, text: str, says: str) -> None:
    ended = inspect(script(tmp_path, text), InspectOptions("scene.nff", "1", "2", 8), seconds=0.5)
    assert says in ended.problem
    assert ended.record is None


def test_the_last_step_that_still_works_is_found(tmp_path: Path, project: Project) -> None:
    program = script(tmp_path, 'test "$5" -lt 5 || kill -SEGV $$')
    assert last_good_step(program, InspectOptions("scene.nff", "1", "2", 8), read_all_steps(project)) == 4


def test_a_path_is_asked_for_where_there_are_paths(tmp_path: Path, project: Project) -> None:
    options = InspectOptions("a.pbrt", "1", "2", 13, path="7")
    assert options.words() == ["a.pbrt", "1", "2", "--step", "13", "--path", "7"]
    program = script(tmp_path, 'case "$*" in *--step\\ 9\\ *--path*) exit 2 ;; *--step\\ 12*) kill -SEGV $$ ;; esac')
    assert last_good_step(program, options, read_all_steps(project)) == 11


def test_two_paths_of_a_pixel_are_two_records(project: Project, program: Path) -> None:
    scene = str(project.scenes / "lessons" / "cornell.pbrt")
    found = [
        inspect(program, InspectOptions(scene, "20", "15", 13, SIZE, path)).record for path in (None, "1", "2", "2")
    ]
    records = [record for record in found if record is not None]
    assert [record.sample for record in records] == [None, 1, 2, 2]
    assert records[2] == records[3]
    assert len({str(record.color) for record in records}) == 3
    with pytest.raises(UsageError, match="--path: expected a --step of 10 or more beside it, found 8"):
        inspect(program, InspectOptions(scene, "20", "15", 8, SIZE, "1"))


def test_what_samples_of_lamps_bring_is_the_light_of_the_hit(project: Project, program: Path) -> None:
    scene = str(project.scenes / "lessons" / "soft-shadows.pbrt")
    lit = blocked = 0
    for x in range(2, 40, 6):
        for step in (11, 12):
            found = inspect(program, InspectOptions(scene, str(x), "27", step, SIZE))
            assert found.record is not None
            ray, rays = found.record.ray, found.record.rays
            if step == 11 or ray.hit is None:
                assert ray.lamps == []
                assert "\n  lamp " not in found.text
                continue
            assert [lamp.shape for lamp in ray.lamps] == ["disk", "triangle", "triangle", "sphere"]
            assert found.text.count("\n  lamp ") == 4
            assert sum(len(lamp.rays) for lamp in ray.lamps) == rays.shadow
            sums = [sum(map(float, channel)) for channel in zip(*(lamp.brought for lamp in ray.lamps), strict=True)]
            assert sums == pytest.approx(ray.local, rel=1e-4, abs=1e-6)
            lit += sum(lamp.lit for lamp in ray.lamps)
            blocked += sum(not lamp.lit and not lamp.is_dark for lamp in ray.lamps)
    assert lit > 5
    assert blocked > 2


@pytest.mark.parametrize("scene", ["acne-corner", "cones", "glass", "inside-sphere", "many-spheres", "overexposed"])
def test_a_pixel_has_the_bytes_and_the_counts_of_the_picture(
    project: Project, program: Path, raytrace: Path, tmp_path: Path, scene: str
) -> None:
    plan = [(1, "none"), (2, "boxes"), (3, "none"), (4, "octree"), (5, "boxes"), (7, "octree"), (8, "none"), (9, "bvh")]
    for at, (step, accel) in enumerate(plan):
        x, y = (7 * at + 9) % 40, (11 * at + 13) % 30
        found = inspect(program, pixel_of(project, scene, x, y, step, "--accel", accel)).record
        assert found is not None
        words: list[str | Path] = [raytrace, project.scenes / "lessons" / f"{scene}.nff", *SIZE, "--step", str(step)]
        words += ["--accel", accel, "--crop", f"{x},{y},1,1", "-o", tmp_path / "a.ppm", "--stats", tmp_path / "a.json"]
        assert run(words, seconds=60).code == 0
        stats = json.loads((tmp_path / "a.json").read_text())
        assert found.bytes == read_ppm(tmp_path / "a.ppm")[0, 0].tolist()
        assert found.counts.surface_tests == stats["surface_tests"]
        assert found.counts.box_tests == stats["box_tests"]
        assert found.rays == RayCounts(*(stats["rays"][kind] for kind in ("eye", "shadow", "reflect", "refract")))


def jitter(value: Any, share: float) -> Any:
    """All numbers with a fraction, each a little off, now up and now down."""
    if isinstance(value, dict):
        return {key: part if key in ("bytes", "fill") else jitter(part, share) for key, part in value.items()}
    if isinstance(value, list):
        return [jitter(part, share if at % 2 else -share) for at, part in enumerate(value)]
    return value * (1 + share) if isinstance(value, float) else value


def test_rounding_is_no_difference(record: Record) -> None:
    assert find_divergence(record, record) is None
    assert find_divergence(convert(jitter(plain(record), 3e-6), Record), record) is None


def test_what_nobody_saw_is_no_difference(record: Record) -> None:
    """A step 05 that calls itself tells only the sum of what its reflected rays bring."""
    mine = copy.deepcopy(record)
    mine.ray.bounces[0].color = None
    assert find_divergence(mine, record) is None
    mine.ray.color = [0.5, 0.5, 0.5]
    divergence = find_divergence(mine, record)
    assert divergence is not None
    assert (divergence.place, divergence.function) == (("eye", "color"), "trace")


def test_other_boxes_and_more_tests_are_no_difference(project: Project, program: Path, record: Record) -> None:
    for accel in ("none", "boxes", "bvh"):
        other = inspect(program, pixel_of(project, "three-spheres", 24, 15, 8, "--accel", accel)).record
        assert other is not None
        assert other.counts != record.counts
        assert find_divergence(other, record) is None


def _frame(record: Record) -> None:
    record.frame.up = [0, 0, 1]


def _never_asked(record: Record) -> None:
    record.rays.eye = 0


def _normal(record: Record) -> None:
    assert record.ray.hit is not None
    record.ray.hit.normal = [2 * float(value) for value in record.ray.hit.normal]


def _shadow(record: Record) -> None:
    light = record.ray.lights[1]
    light.lit = not light.lit
    record.ray.direct = [9, 9, 9]


def _sum(record: Record) -> None:
    record.ray.direct = [0, 0, 0]


def _mirrored(record: Record) -> None:
    assert record.ray.hit is not None
    record.ray.bounces[0].direction = record.ray.hit.mirrored = [0, 1, 0]


def _deep(record: Record) -> None:
    record.ray.bounces[0].color = [0.5, 0.5, 0.5]


def _tone(record: Record) -> None:
    record.mapped = [1, 1, 1]


@pytest.mark.parametrize(
    ("change", "place", "function", "words"),
    [
        (_frame, ("frame",), "view_frame", "the camera's axis `up`"),
        (_never_asked, ("eye", "hit"), "trace", "the eye ray: yours never asks what it meets"),
        (_normal, ("eye", "normal"), "Sphere::intersect", "the normal is"),
        (_shadow, ("eye", "light2"), "is_lit", "shadow ray to light 2: yours is"),
        (_sum, ("eye", "direct"), "shade", "the sum over the lights is (0, 0, 0)"),
        (_mirrored, ("eye", "reflect", "ray"), "mirror", "the reflected ray, depth 2: yours goes towards (0, 1, 0)"),
        (_deep, ("eye", "reflect", "color"), "trace", "the reflected ray, depth 2: the colour of the ray is"),
        (_tone, ("mapped",), "tone_map", "tone mapping"),
    ],
)
def test_the_first_difference_is_named(
    project: Project, record: Record, change: Change, place: tuple[str, ...], function: str, words: str
) -> None:
    mine = copy.deepcopy(record)
    change(mine)
    divergence = find_divergence(mine, record)
    assert divergence is not None
    assert (divergence.place, divergence.function) == (place, function)
    assert words in divergence.words
    for width in (60, 160):
        console = Console(width=width, record=True, file=io.StringIO())
        assert compare(project, InspectResult(record=mine), InspectResult(record=record), console) == 1
        text = console.export_text()
        marked = [line for line in text.splitlines() if line.lstrip().startswith(">")]
        assert len(marked) == (2 if width == 60 else 1)
        assert f"Look at {function}" in text


def test_two_that_agree_are_told_so(project: Project, record: Record) -> None:
    console = Console(width=160, record=True, file=io.StringIO())
    assert compare(project, InspectResult(record=record), InspectResult(record=record), console) == 0
    assert "No difference" in console.export_text()


def test_steps_that_are_not_started_are_told_so_before_anything_is_built(
    project: Project, unsolved: dict[str, str], tmp_path: Path
) -> None:
    steps = read_steps(project)
    for step in steps:
        (tmp_path / "steps" / step.path).parent.mkdir(parents=True)
        (tmp_path / "steps" / step.path).write_text(unsolved[step.id], encoding="utf-8")
        manifest = (project.steps / step.id / "step.toml").read_text(encoding="utf-8")
        (tmp_path / "steps" / step.id / "step.toml").write_text(manifest, encoding="utf-8")
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    scene = str(project.scenes / "lessons" / "three-spheres.nff")
    with pytest.raises(UsageError, match="your steps are not started"):
        start(Project(tmp_path), parser.parse_args([scene, "1", "2"]), Console(file=io.StringIO()))
