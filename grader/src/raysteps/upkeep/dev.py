"""The commands `dev ...`, for those who maintain the kit."""

import argparse

from rich.console import Console

from raysteps.commands.progress import progress
from raysteps.kit.project import Project
from raysteps.upkeep import maintenance
from raysteps.upkeep.calibration.command import calibrate
from raysteps.upkeep.new_step import command as new_step
from raysteps.upkeep.truth.command import check_truth


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds one command below `dev` for each thing to do."""
    commands = parser.add_subparsers(dest="what", required=True, metavar="WHAT")
    new_step.add_arguments(commands)
    for name, made in (
        ("stubs", "the stubs in steps/"),
        ("samples", "the samples in grader/samples/"),
    ):
        add = commands.add_parser(name, help=f"make {made} from the solutions")
        add.add_argument("--check", action="store_true", help="only tell what is out of date")
    commands.add_parser(
        "learn", help="learn the known mistakes of all steps now, and not with the first wrong submission"
    )
    add = commands.add_parser("mistakes", help="make docs/mistakes/ from the catalogue of mistakes")
    add.add_argument("--check", action="store_true", help="only tell what is out of date")
    add = commands.add_parser("calibrate", help="measure how many pixels of each picture may be wrong (15 minutes)")
    add.add_argument("--check", action="store_true", help="only tell which limits are out of date")
    add.add_argument("--only", nargs="+", default=[], metavar="STEP", help="these steps only")
    add.add_argument("--marks", action="store_true", help="grade every correct solution in every setting instead")
    add = commands.add_parser(
        "check", help="grade stubs, references, known mistakes and alternatives, and judge the grades"
    )
    add.add_argument("--only", nargs="+", default=[], metavar="STEP", help="these steps only")
    add.add_argument("--pairs", type=int, default=0, metavar="N", help="also random pairs of mistakes in two steps")
    add.add_argument("--seed", type=int, default=1, metavar="N", help="of the hidden cases and of the pairs (1)")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Runs one of them."""
    match arguments.what:
        case "new":
            return new_step.run(project, arguments)
        case "stubs":
            return maintenance.stubs(project, check=arguments.check)
        case "samples":
            return maintenance.samples(project, check=arguments.check)
        case "learn":
            with console.status("starting") as status:
                return maintenance.learn(project, progress(console, status))
        case "mistakes":
            with console.status("starting") as status:
                return maintenance.mistakes(project, progress(console, status), check=arguments.check)
        case "calibrate":
            with console.status("starting") as status:
                say = progress(console, status)
                return calibrate(project, arguments.only, console, say, check=arguments.check, grades=arguments.marks)
        case _:
            with console.status("starting") as status:
                say = progress(console, status)
                only, pairs, seed = arguments.only, arguments.pairs, arguments.seed
                return check_truth(project, console, say, only=only, pairs=pairs, seed=seed)
