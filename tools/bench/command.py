"""The commands `bench ...`, and the two that need no file of their own: reading scenes, and growth."""

import argparse
import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import UsageError
from raysteps.course.project import Project, generated
from tools.bench.docs import bench_docs
from tools.bench.grading import WaitsOptions, bench_loop, bench_waits, grading
from tools.bench.mitsuba import MitsubaOptions, bench_mitsuba
from tools.bench.model import GrowthRow, ParseNumbers, ParseRow, ScaleNumbers, ScaleRow, keep
from tools.bench.pictures import ThreadsOptions, bench_threads, boxes
from tools.bench.play import bench_play
from tools.bench.programs import Programs, ask, ask_pinned, checked, listed, portable
from tools.bench.render import RenderOptions, bench_render
from tools.bench.tables import median, megabytes, milliseconds, quartiles, terminal_table

# How fast scenes are read.

_LARGE = (("tetrahedra", 9), ("rings", 30), ("mountain", 9))


def bench_parse(project: Project, scenes: list[Path], rounds: int, console: Console) -> int:
    """Measures, prints a table and writes build/bench/parse.json."""
    named = checked(scenes)
    with console.status("building the benchmarks"):
        programs = portable(project)
    with console.status("making large scenes"):
        large = named or [generated(project, kind, size) for kind, size in _LARGE]
    rows: list[ParseRow] = []
    for scene in large:
        with console.status(f"reading {escape(scene.name)}"):
            words = ("parse", scene, "--rounds", str(rounds))
            rows.append(ask_pinned(ParseRow, programs.bench, *words, scene=scene.stem))
    headings = ("scene", "size", "surfaces", "speed", "quartiles")
    table = terminal_table("reading scenes, one thread, the text already in memory", headings)
    for row in rows:
        speed = row.megabytes_per_second
        table.add_row(
            escape(row.scene),
            f"{row.bytes / 1e6:.1f} MB",
            str(row.surfaces),
            median(speed, 1, " MB/s"),
            quartiles(speed, 1),
        )
    console.print(table)
    keep(project, ParseNumbers(machine=programs.machine, rows=rows), console)
    return 0


# How building, memory and tests grow with the number of surfaces.

KINDS = ("cloud", "clusters", "terrain", "dust")
_FIT_FROM = 1000  # surfaces; below, all is in a few boxes
_ROUNDS = 3


@dataclass(frozen=True)
class ScaleOptions:
    """What `bench scale` was asked for."""

    most: int = 1_000_000
    structures: str = ""
    rounds: int = _ROUNDS


def sizes(most: int) -> list[int]:
    """100, 1000 and so on."""
    found = [100]
    while found[-1] * 10 <= most:
        found.append(found[-1] * 10)
    return found


def _measured(programs: Programs, kind: str, size: int, structure: str, rounds: int) -> ScaleRow:
    """Building on all processors; then the rays, alone on one."""
    words = ("scale", kind, str(size), structure)
    built = ask(ScaleRow, programs.bench, *words, "--rounds", str(rounds), "--size", "16", structure=structure)
    asked = ask_pinned(ScaleRow, programs.bench, *words, "--rounds", str(rounds), structure=structure)
    return replace(asked, build_seconds=built.build_seconds, peak_bytes=built.peak_bytes)


@dataclass(frozen=True)
class Growth:
    """How y grows with x: about x to the power of `exponent`, and by `per_doubling` with each doubling of x."""

    exponent: float
    per_doubling: float


def _slope(xs: Sequence[float], ys: Sequence[float]) -> float:
    middle_x, middle_y = math.fsum(xs) / len(xs), math.fsum(ys) / len(ys)
    spread = math.fsum((x - middle_x) ** 2 for x in xs)
    return math.fsum((x - middle_x) * (y - middle_y) for x, y in zip(xs, ys, strict=True)) / spread


def growth(points: Sequence[tuple[float, float]]) -> Growth:
    """Lines of least squares through at least two points: log y over log x, and y over the doublings of x."""
    doublings = [math.log2(x) for x, _ in points]
    values = [y for _, y in points]
    return Growth(_slope(doublings, [math.log2(value) for value in values]), _slope(doublings, values))


def growth_of(rows: list[ScaleRow]) -> Iterator[GrowthRow]:
    """For each structure on each kind of scene, from a thousand surfaces on."""
    for structure, scene in dict.fromkeys((row.structure, row.scene) for row in rows):
        line = [row for row in rows if (row.structure, row.scene) == (structure, scene)]
        line = [row for row in line if row.surfaces >= 0.9 * _FIT_FROM and row.tests_per_ray > 0]
        if len(line) >= 2:
            tests = growth([(row.surfaces, row.tests_per_ray) for row in line])
            time = growth([(row.surfaces, row.ns_per_ray.median) for row in line])
            yield {
                "structure": structure,
                "scene": scene,
                "from": line[0].surfaces,
                "to": line[-1].surfaces,
                "tests_exponent": tests.exponent,
                "tests_per_doubling": tests.per_doubling,
                "time_exponent": time.exponent,
            }


def _print_scale(rows: list[ScaleRow], console: Console) -> None:
    headings = ("scene", "structure", "surfaces", "build", "structure's memory", "peak memory", "surfaces/ray",
                "boxes/ray", "ns/ray")  # fmt: skip
    table = terminal_table("how the structures grow", headings)
    for row in rows:
        table.add_row(
            row.scene,
            row.structure,
            str(row.surfaces),
            milliseconds(row.build_seconds, 2, " ms"),
            megabytes(row.bytes, unit=" MB"),
            megabytes(row.peak_bytes, 0, " MB"),
            f"{row.surface_tests_per_ray:.2f}",
            f"{row.box_tests_per_ray:.2f}",
            median(row.ns_per_ray, 0),
        )
    console.print(table)


def _print_growth(lines: list[GrowthRow], console: Console) -> None:
    for line in lines:
        console.print(
            f"{line['scene']}, {line['structure']}, {line['from']} to {line['to']} surfaces: tests grow as "
            f"N^{line['tests_exponent']:.3f}, by {line['tests_per_doubling']:.2f} with each doubling; "
            f"time as N^{line['time_exponent']:.3f}"
        )


def _chosen(programs: Programs, options: ScaleOptions) -> list[str]:
    structures = listed(programs.bench).structures
    trees = [side.name for side in structures if not side.slow and not side.foreign]
    asked = options.structures.split(",") if options.structures else trees
    for name in asked:
        if name not in [side.name for side in structures]:
            raise UsageError(f"--structures: expected names among {', '.join(trees)}, found '{name}'")
    return asked


def bench_scale(project: Project, options: ScaleOptions, console: Console) -> int:
    """Measures, prints a table and the slopes, and writes build/bench/scale.json."""
    with console.status("building the benchmarks"):
        programs = portable(project)
    rows: list[ScaleRow] = []
    for kind in KINDS:
        for structure in _chosen(programs, options):
            for size in sizes(options.most):
                with console.status(f"{kind} of {size} surfaces, {structure}"):
                    rows.append(_measured(programs, kind, size, structure, options.rounds))
    lines = list(growth_of(rows))
    _print_scale(rows, console)
    _print_growth(lines, console)
    keep(project, ScaleNumbers(machine=programs.machine, rows=rows, growth=lines), console)
    return 0


# The words of these commands.


def _number(least: int, most: int) -> Callable[[str], int]:
    """A type for argparse: whole numbers in a range."""

    def read(word: str) -> int:
        if not re.fullmatch(r"[0-9]{1,9}", word) or not least <= int(word) <= most:
            raise argparse.ArgumentTypeError(f"{word}: expected a whole number from {least} to {most}")
        return int(word)

    return read


def _add_scenes(parser: argparse.ArgumentParser, otherwise: str, kind: str = "NFF files") -> None:
    parser.add_argument("scenes", nargs="*", type=Path, metavar="SCENE", help=f"{kind} instead of {otherwise}")


def _add_size(parser: argparse.ArgumentParser, usual: int = 512) -> None:
    words = f"pixels of both sides ({usual})"
    parser.add_argument("--size", type=_number(16, 8192), default=usual, metavar="N", help=words)


def _add_rounds(parser: argparse.ArgumentParser, rounds: int) -> None:
    words = f"how often all are measured, in turns ({rounds})"
    parser.add_argument("--rounds", type=_number(1, 1000), default=rounds, metavar="N", help=words)


def _add_structures(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--structures", default="", metavar="LIST", help="such as octree,embree (all)")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds one command below `bench` for each thing to measure."""
    commands = parser.add_subparsers(dest="what", required=True, metavar="WHAT")

    add = commands.add_parser("render", help="time of a ray, beside Embree and POV-Ray")
    _add_scenes(add, "the kit's own five scenes")
    _add_size(add)
    _add_rounds(add, 5)
    _add_structures(add)
    add.add_argument("--depth", type=_number(1, 1000), default=5, metavar="D", help="longest chain of rays (5)")
    add.add_argument("--every", type=_number(1, 1000000), default=64, metavar="N", help="slow ones: each n-th ray (64)")
    add.add_argument("--native", action="store_true", help="also measure a build for this very processor")
    add.add_argument("--no-povray", action="store_true", help="no whole pictures beside POV-Ray's")

    add = commands.add_parser("mitsuba", help="time and noise of paths, beside Mitsuba 3")
    _add_scenes(add, "the Cornell box and balls below a sky", "pbrt files of matt surfaces")
    add.add_argument(
        "--python", type=Path, metavar="FILE", help="a Python that has mitsuba; without it: how to get one"
    )
    _add_size(add, 128)
    samples = "of a pixel: a square number (64)"
    add.add_argument("--samples", type=_number(4, 4096), default=64, metavar="N", help=samples)
    add.add_argument("--rounds", type=_number(2, 1000), default=6, metavar="N", help="pictures of each, in turns (6)")

    add = commands.add_parser("scale", help="how building, memory and tests grow with the number of surfaces")
    add.add_argument("--most", type=_number(100, 10_000_000), default=1_000_000, metavar="N", help="surfaces (1000000)")
    _add_rounds(add, 3)
    _add_structures(add)

    add = commands.add_parser("threads", help="what more processors bring to one picture")
    _add_scenes(add, "the kit's own five scenes")
    _add_size(add)
    _add_rounds(add, 5)

    add = commands.add_parser("parse", help="how fast scenes are read")
    _add_scenes(add, "three large ones")
    _add_rounds(add, 5)

    add = commands.add_parser("loop", help="from a changed file to the result of `check`")
    add.add_argument("steps", nargs="*", metavar="STEP", help="02, 2 or 02-intersection; all when none is given")
    _add_rounds(add, 5)

    add = commands.add_parser("waits", help="how long a person waits, from the first picture to the grades of a class")
    _add_rounds(add, 5)
    words = "in the class (120)"
    add.add_argument("--submissions", type=_number(1, 1000), default=120, metavar="N", help=words)

    add = commands.add_parser("play", help="from a save to the picture in the page to work in, by Chromium")
    add.add_argument("steps", nargs="*", metavar="STEP", help="02, 2 or 02-intersection; all when none is given")
    _add_rounds(add, 3)

    add = commands.add_parser("boxes", help="what boxes save, against testing every surface")
    add.add_argument("--scenes", nargs="*", type=Path, default=[], metavar="FILE", help="more scenes to measure")
    add.add_argument("--size", default="256x256", metavar="WxH", help="pixels of each picture (256x256)")

    add = commands.add_parser("grading", help="a submission in a class, against the plain way")
    _add_rounds(add, 3)

    commands.add_parser("docs", help="tables and figures of docs/benchmarks.md, from what was measured last")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Runs one of them."""
    given = arguments
    match given.what:
        case "render":
            numbers = (given.size, given.depth, given.rounds, given.every)
            options = RenderOptions(given.scenes, *numbers, given.structures, given.native, not given.no_povray)
            return bench_render(project, options, console)
        case "mitsuba":
            race = MitsubaOptions(given.python, given.scenes, given.size, given.samples, given.rounds)
            return bench_mitsuba(project, race, console)
        case "scale":
            return bench_scale(project, ScaleOptions(given.most, given.structures, given.rounds), console)
        case "threads":
            return bench_threads(project, ThreadsOptions(given.scenes, given.size, given.rounds), console)
        case "parse":
            return bench_parse(project, given.scenes, given.rounds, console)
        case "loop":
            return bench_loop(project, given.steps, given.rounds, console)
        case "waits":
            return bench_waits(project, WaitsOptions(given.rounds, given.submissions), console)
        case "play":
            return bench_play(project, given.steps, given.rounds, console)
        case "boxes":
            return boxes(project, given.scenes, given.size, console)
        case "grading":
            return grading(project, given.rounds, console)
        case _:
            return bench_docs(project, console)
