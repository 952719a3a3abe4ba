"""What the plots show: counted, never timed, and kept beside the built kit."""

import hashlib
import json
import tempfile
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.common.files import file_lock, write_json
from raysteps.common.process import run
from raysteps.common.text import shorten
from raysteps.course.manifest import Step
from raysteps.course.mutants import reference_source, replaced_once
from raysteps.course.project import generated
from raysteps.images.compare import Pixels, parse_ppm, pixel_differences
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.sandbox.task import Input, Output, Task, Word
from raysteps.toolchain.compile import Program, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import limits_of

# A step from another source: a constant of the reference is read at the start, and one program draws a whole curve.

# Read once, from what the program gets on its standard input; the kit's programs never read it otherwise.
_READER = """
#include <cstdio>

namespace {

float knob(int number) {
    static float values[2] = {0.0F, 0.0F};
    [[maybe_unused]] static const int read = std::scanf("%f %f", &values[0], &values[1]);
    return values[number];
}

}  // namespace
"""


@dataclass(frozen=True)
class RenderedVariant:
    """A picture and the counters that stand beside it."""

    pixels: Pixels
    stats: dict[str, Any]


def with_knobs(kit: BuiltKit, step: Step, changes: Mapping[str, str]) -> str:
    """The reference's source, with knob(0) and knob(1) in place of constants."""
    source = reference_source(kit.project, step)
    for old, new in changes.items():
        source = replaced_once(source, old, new, f"figures: '{old}' in solutions/{step.path.as_posix()}")
    return _READER + source


class Variant:
    """One step from another source, compiled as a student's step is, and linked with the kit."""

    def __init__(self, kit: BuiltKit, step: Step, source: str) -> None:
        self._kit, self._air = kit, LimitsOnly()
        self._limits = limits_of(step, {})
        self._folder = tempfile.TemporaryDirectory(prefix="raysteps-", ignore_cleanup_errors=True)
        build = StudentBuild(kit.in_one_process(), self._air, Path(self._folder.name))
        compiled = build.compile(step, source.encode(), self._limits)
        if compiled.binary is None:
            raise GraderFault(f"figures: {step.id} does not build: {shorten(compiled.ran.outcome.stderr, 1000)}")
        program, _ = build.program("raytrace", step, {step.number: compiled.binary}, self._limits)
        if program is None:
            raise GraderFault(f"figures: {step.id} cannot be linked")
        self._program: Program = program

    def draw(self, scene: str, args: Sequence[str], knobs: Sequence[float] = ()) -> RenderedVariant:
        """One picture; `knobs` are the two numbers that the source asks for with knob(0) and knob(1)."""
        words: list[Word] = [
            *self._program.words,
            Input(self._kit.project.root / scene, f"scene{Path(scene).suffix}"),
            *args,
            "--quiet",
        ]
        words += ["-o", Output("picture"), "--stats", Output("stats")]
        told = " ".join(str(value) for value in [*knobs, 0, 0][:2]).encode()
        ran = self._air.run(Task(tuple(words), self._limits.of_program(), stdin=told))
        if ran.outcome.code != 0 or "picture" not in ran.outputs:
            raise GraderFault(f"figures: {scene} cannot be rendered: {shorten(ran.outcome.stderr, 1000)}")
        return RenderedVariant(parse_ppm(ran.outputs["picture"]), json.loads(ran.outputs["stats"]))


# What is counted with them.

Measurement = dict[str, Any]

_SIZE = ("--size", "48x36")
_SECONDS = 120
_GROWING = {"sphereflake": (1, 2, 3, 4), "mountain": (2, 3, 4, 5, 6)}
_SEARCHES = ("none", "boxes", "octree", "bvh")
_DEPTHS = range(8)
_THRESHOLDS = (1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3, 1e-2, 3e-2, 1e-1, 3e-1, 1.0)
_ACNE_SCENES = ("three-spheres", "acne-corner")
_BOUNCES = range(1, 11)
_DEPTH_KNOB = {
    "constexpr int k_max_depth = 12;": "const int k_max_depth = static_cast<int>(knob(0));",
    "constexpr std::size_t k_max_growth = 4; ": "constexpr std::size_t k_max_growth = 1000000; ",
    "constexpr std::uint64_t k_max_references = 24;": "constexpr std::uint64_t k_max_references = 1000000;",
    "    // Separating axes": "    if (knob(1) > 0.0F) {\n        return true;\n    }\n    // Separating axes",
}
_THRESHOLD_KNOB = {"k_shadow_threshold * hit.normal": "knob(0) * hit.normal"}


def _stats(kit: BuiltKit, scene: Path, *options: str) -> Measurement:
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        picture, stats = Path(folder) / "picture.ppm", Path(folder) / "stats.json"
        words: list[str | Path] = [kit.reference("raytrace"), scene, *_SIZE, *options, "--quiet", "-o", picture]
        outcome = run([*words, "--stats", stats], seconds=_SECONDS)
        if outcome.code != 0:
            raise GraderFault(f"figures: {scene.name} cannot be rendered: {outcome.stderr.strip()}")
        told: Measurement = json.loads(stats.read_text(encoding="utf-8"))
        return told


def _rays(stats: Measurement) -> int:
    return sum(int(count) for kind, count in stats["rays"].items() if kind != "eye_hit")


def _per_ray(stats: Measurement) -> float:
    """Tests of surfaces and boxes together."""
    return float(stats["surface_tests"] + stats["box_tests"]) / _rays(stats)


def growth(kit: BuiltKit) -> Measurement:
    """Tests per ray for each kind of scene and way to search: [surfaces, tests] pairs."""
    result: Measurement = {}
    for kind, sizes in _GROWING.items():
        scenes = [generated(kit.project, kind, size) for size in sizes]
        result[kind] = {
            name: [
                [stats["surfaces"], _per_ray(stats)]
                for stats in (_stats(kit, scene, "--step", "6", "--accel", name) for scene in scenes)
            ]
            for name in _SEARCHES
        }
    return result


def depths(kit: BuiltKit) -> Measurement:
    """Tests per ray and entries per surface of an octree that ends at each depth, without any other limit."""
    variant = Variant(kit, kit.steps[5], with_knobs(kit, kit.steps[5], _DEPTH_KNOB))
    args = ("--step", "6", "--accel", "octree")
    gears = "scenes/generated/gears.nff"
    result: Measurement = {"surfaces": [], "boxes": [], "precise": [], "bounds": []}
    for depth in _DEPTHS:
        stats = variant.draw(gears, (*args, *_SIZE), (depth, 0)).stats
        result["surfaces"].append([depth, stats["surface_tests"] / _rays(stats)])
        result["boxes"].append([depth, stats["box_tests"] / _rays(stats)])
        result["precise"].append([depth, stats["structure"]["references"] / stats["surfaces"]])
        stats = variant.draw(gears, (*args, "--size", "1x1"), (depth, 1)).stats
        result["bounds"].append([depth, stats["structure"]["references"] / stats["surfaces"]])
    return result


def _share(pixels: Pixels, right: Pixels) -> float:
    return float((pixel_differences(pixels, right) > 8).mean())


def thresholds(kit: BuiltKit) -> Measurement:
    """The share of wrong pixels for each threshold of the shadow ray."""
    variant = Variant(kit, kit.steps[3], with_knobs(kit, kit.steps[3], _THRESHOLD_KNOB))
    args = ("--step", "4", "--size", "96x72")
    result: Measurement = {}
    for name in _ACNE_SCENES:
        scene = f"scenes/lessons/{name}.nff"
        right = variant.draw(scene, args, (1e-3,)).pixels
        result[name] = [[at, _share(variant.draw(scene, args, (at,)).pixels, right)] for at in _THRESHOLDS]
    return result


def bounces(kit: BuiltKit) -> Measurement:
    """Rays per pixel for each ray depth."""
    scene = kit.project.scenes / "lessons" / "facing-mirrors.nff"
    rows = [(depth, _stats(kit, scene, "--step", "5", "--depth", str(depth))) for depth in _BOUNCES]
    pixels = rows[0][1]["rays"]["eye"]
    return {
        "all rays": [[depth, _rays(stats) / pixels] for depth, stats in rows],
        "reflected": [[depth, stats["rays"]["reflect"] / pixels] for depth, stats in rows],
    }


_WHAT = {"growth": growth, "depths": depths, "thresholds": thresholds, "bounces": bounces}


def _key(kit: BuiltKit, names: Sequence[str]) -> str:
    sources = [Path(__file__), *sorted(kit.project.scenes.rglob("*.nff"))]
    sources += sorted(kit.project.scenes.rglob("*.py"))
    data = b"\0".join(path.read_bytes() for path in sources)
    return hashlib.sha256(" ".join(names).encode() + data).hexdigest()[:24]


def measured(kit: BuiltKit) -> Measurement:
    """All of it, measured by whoever needs it first."""
    path = kit.folder / "figures" / f"{_key(kit, list(_WHAT))}.json"
    with file_lock(path.with_suffix(".lock")):
        if not path.is_file():
            with ThreadPoolExecutor(2) as pool:
                results = list(pool.map(lambda measure: measure(kit), _WHAT.values()))
            write_json(path, dict(zip(_WHAT, results, strict=True)))
        told: Measurement = json.loads(path.read_text(encoding="utf-8"))
        return told
