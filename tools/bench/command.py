"""The commands `bench ...`."""

import argparse
import re
from collections.abc import Callable
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.course.project import Project, generated
from tools.bench.docs import bench_docs
from tools.bench.grading import WaitsOptions, bench_loop, bench_waits, grading
from tools.bench.mitsuba import MitsubaOptions, bench_mitsuba
from tools.bench.model import ParseNumbers, ParseRow, keep
from tools.bench.pictures import ThreadsOptions, bench_threads, boxes
from tools.bench.play import bench_play
from tools.bench.programs import ask_pinned, checked, portable
from tools.bench.render import RenderOptions, bench_render
from tools.bench.scale import ScaleOptions, bench_scale
from tools.bench.tables import median, quartiles, terminal_table

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
