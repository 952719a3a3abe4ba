"""The command `bench render`: nanoseconds a ray, beside Embree and POV-Ray."""

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.course.project import Project
from tools.bench.model import BuildRays, PovrayRow, ProgramTimes, RenderNumbers, SceneRays, Spread, geometric_mean, keep
from tools.bench.povray import Race, race_povray
from tools.bench.programs import (
    Programs,
    accelerations,
    ask_pinned,
    checked,
    default_scenes,
    listed,
    native,
    portable,
    what_is_missing,
)
from tools.bench.tables import counted, median, megabytes, milliseconds, quartiles, ratio, terminal_table

# Tables of `bench render`.

PEER = "embree"
Times = Callable[[ProgramTimes], Spread]
COMPARED: tuple[Times, Times] = (lambda side: side.trace_seconds, lambda side: side.trace_processor_seconds)


def median_of(scene: SceneRays, name: str) -> float | None:
    """Of one structure on one scene, if it was measured."""
    return next((float(side.ns_per_ray.median) for side in scene.structures if side.name == name), None)


def names_of(scenes: list[SceneRays]) -> list[str]:
    """All structures, in the order of the program."""
    return list(dict.fromkeys(side.name for scene in scenes for side in scene.structures))


def against_embree(scenes: list[SceneRays], name: str) -> float | None:
    """The geometric mean over the scenes of a structure's time as a multiple of Embree's."""
    pairs = [(median_of(scene, name), median_of(scene, PEER)) for scene in scenes]
    ratios = [ours / theirs for ours, theirs in pairs if ours and theirs]
    return geometric_mean(ratios) if ratios and len(ratios) == len(scenes) else None


def all_against_embree(scenes: list[SceneRays]) -> list[tuple[str, float]]:
    """Of each other structure, where all scenes have both."""
    means = [(name, against_embree(scenes, name)) for name in names_of(scenes)]
    return [(name, mean) for name, mean in means if mean and name != PEER]


def faster(theirs: ProgramTimes, ours: ProgramTimes, what: Times) -> float:
    """How many times less we take than POV-Ray; 0 where a picture is too small to be measured."""
    mine, other = float(what(ours).median), float(what(theirs).median)
    return other / mine if mine > 0.0 else 0.0


def against_povray(rows: list[PovrayRow], what: Times) -> list[tuple[str, float]]:
    """For each of our programs: how many times faster, as the geometric mean of the scenes."""
    found: dict[str, list[float]] = {}
    for row in rows:
        for side in row.programs[1:]:
            found.setdefault(side.program, []).append(faster(row.programs[0], side, what))
    return [(name, geometric_mean(ratios)) for name, ratios in found.items() if min(ratios) > 0.0]


def print_rays(scenes: list[SceneRays], build: str, console: Console) -> None:
    """One line for each structure on each scene, and their means."""
    headings = ("scene", "structure", "rays", "ns/ray", "quartiles", "to Embree", "picture", "build", "memory",
                "surfaces/ray", "boxes/ray", "seen differently")  # fmt: skip
    table = terminal_table(f"{build} build, one thread: every ray of the picture again", headings)
    for scene in scenes:
        for number, side in enumerate(scene.structures):
            spread = side.ns_per_ray
            table.add_row(
                f"{escape(scene.scene)} ({scene.surfaces})" if number == 0 else "",
                side.name,
                str(side.rays),
                median(spread, 1),
                quartiles(spread, 1),
                ratio(spread.median, median_of(scene, PEER), " x"),
                median(side.picture_seconds, 3, " s"),
                milliseconds(side.build_seconds, 2, " ms"),
                megabytes(side.bytes, unit=" MB"),
                counted(side.surface_tests_per_ray, 2),
                counted(side.box_tests_per_ray, 2),
                str(side.differing),
                end_section=side is scene.structures[-1],
            )
    console.print(table)
    told = [f"{name} {mean:.2f} x" for name, mean in all_against_embree(scenes)]
    if told:
        mean = f"geometric mean of {len(scenes)} scene(s), below 1 is faster"
        console.print(f"Time of a ray against Embree's, {mean}: {', '.join(told)}")


def print_pictures(rows: list[PovrayRow], console: Console) -> None:
    """Whole pictures beside POV-Ray's."""
    headings = ("scene", "program", "tracing", "tracing, processor", "process", "process, processor",
                "POV-Ray / ours: tracing", "and of the processor", "difference of brightness")  # fmt: skip
    table = terminal_table("whole pictures beside POV-Ray, one thread each", headings)
    for row in rows:
        if row.skipped:
            table.add_row(escape(row.scene), escape(row.skipped), end_section=True)
            continue
        theirs = row.programs[0]
        for number, side in enumerate(row.programs):
            times = (side.trace_seconds, side.trace_processor_seconds, side.process_seconds, side.processor_seconds)
            table.add_row(
                escape(row.scene) if number == 0 else "",
                side.program,
                *[median(time, 3, " s") for time in times],
                *["" if number == 0 else f"{faster(theirs, side, what):.2f} x" for what in COMPARED],
                f"{row.brightness_difference:.4f}" if number == 0 else "",
                end_section=side is row.programs[-1],
            )
    console.print(table)
    for what, words in zip(COMPARED, ("on the clock", "of the processor"), strict=True):
        told = [f"{name} {mean:.2f} x" for name, mean in against_povray(rows, what)]
        if told:
            console.print(f"Tracing, seconds {words}, faster than POV-Ray, geometric mean: {', '.join(told)}")


@dataclass(frozen=True)
class RenderOptions:
    """What `bench render` was asked for."""

    scenes: list[Path]
    size: int = 512
    depth: int = 5
    rounds: int = 5
    every: int = 64
    structures: str = ""
    native: bool = False
    povray: bool = True


def _rays(programs: Programs, scene: Path, options: RenderOptions) -> SceneRays:
    words = ["--size", options.size, "--depth", options.depth, "--rounds", options.rounds, "--every", options.every]
    words += ["--structures", options.structures] if options.structures else []
    return ask_pinned(SceneRays, programs.bench, "render", scene, *[str(word) for word in words])


def _measure(programs: Programs, scenes: list[Path], options: RenderOptions, console: Console) -> BuildRays:
    rows = []
    for scene in scenes:
        with console.status(f"{programs.build} build: the rays of {escape(scene.name)}"):
            rows.append(_rays(programs, scene, options))
    print_rays(rows, programs.build, console)
    return BuildRays(programs.build, programs.machine, rows)


def _race(programs: Programs, scenes: list[Path], options: RenderOptions, console: Console) -> list[PovrayRow]:
    if shutil.which("povray") is None or not options.povray:
        return []
    rows = []
    trees = [
        name for name in accelerations(programs) if not options.structures or name in options.structures.split(",")
    ]
    if not trees:
        return []
    for scene in scenes:
        with console.status(f"POV-Ray and raytrace in turns: {escape(scene.name)}"):
            rows.append(race_povray(programs, scene, Race(options.size, options.depth, options.rounds, trees)))
    print_pictures(rows, console)
    return rows


def bench_render(project: Project, options: RenderOptions, console: Console) -> int:
    """Measures, prints tables and writes build/bench/render.json."""
    scenes = checked(options.scenes) or default_scenes(project)
    with console.status("building the benchmarks"):
        programs = portable(project)
    for line in what_is_missing(listed(programs.bench)):
        console.print(line, soft_wrap=True)
    builds = [_measure(programs, scenes, options, console)]
    if options.native:
        with console.status("building for this very processor"):
            tuned = native(project)
        builds.append(_measure(tuned, scenes, options, console))
    pictures = _race(programs, scenes, options, console)
    keep(project, RenderNumbers(builds=builds, povray=pictures), console)
    return 0
