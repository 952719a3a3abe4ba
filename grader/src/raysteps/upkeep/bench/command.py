"""The commands `bench ...`."""

import argparse
import re
from collections.abc import Callable
from pathlib import Path

from rich.console import Console

from raysteps.common.errors import UsageError
from raysteps.kit.project import Project
from raysteps.upkeep.bench.boxes import boxes
from raysteps.upkeep.bench.grading import grading
from raysteps.upkeep.bench.render import RenderWish, bench_render


def _number(least: int, most: int) -> Callable[[str], int]:
    """A type for argparse: whole numbers in a range."""

    def read(word: str) -> int:
        if not re.fullmatch(r"[0-9]{1,7}", word) or not least <= int(word) <= most:
            raise argparse.ArgumentTypeError(f"{word}: expected a whole number from {least} to {most}")
        return int(word)

    return read


def _add_render(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("scenes", nargs="*", type=Path, metavar="SCENE", help="NFF files instead of the kit's own five scenes")
    add("--size", type=_number(16, 8192), default=512, metavar="N", help="pixels of both sides (512)")
    add("--depth", type=_number(1, 1000), default=5, metavar="D", help="longest chain of rays (5)")
    add("--rounds", type=_number(1, 1000), default=5, metavar="N", help="how often all are measured, in turns (5)")
    add("--every", type=_number(1, 1000000), default=64, metavar="N", help="none and boxes get every n-th ray (64)")
    add("--structures", default="", metavar="LIST", help="such as octree,embree (all)")
    add("--native", action="store_true", help="also measure a build for this very processor")
    add("--no-povray", action="store_true", help="no whole pictures beside POV-Ray's")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds one command below `bench` for each thing to measure."""
    commands = parser.add_subparsers(dest="what", required=True, metavar="WHAT")
    _add_render(commands.add_parser("render", help="time of a ray, beside Embree and POV-Ray"))
    add = commands.add_parser("boxes", help="what boxes save, against testing every surface")
    add.add_argument("--scenes", nargs="*", type=Path, default=[], metavar="FILE", help="more scenes to measure")
    add.add_argument("--size", default="256x256", metavar="WxH", help="pixels of each picture (256x256)")
    add = commands.add_parser("grading", help="a submission in a class, against the plain way")
    add.add_argument("--rounds", type=_number(1, 100), default=3, metavar="N", help="how often both are measured (3)")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Runs one of them."""
    match arguments.what:
        case "boxes":
            return boxes(project, arguments.scenes, arguments.size, console)
        case "grading":
            return grading(project, arguments.rounds, console)
        case "render":
            wish = RenderWish(
                arguments.scenes,
                arguments.size,
                arguments.depth,
                arguments.rounds,
                arguments.every,
                arguments.structures,
                arguments.native,
                not arguments.no_povray,
            )
            return bench_render(project, wish, console)
        case _:
            raise UsageError(f"there is no benchmark {arguments.what}")
