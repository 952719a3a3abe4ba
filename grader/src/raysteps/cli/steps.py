"""The command lines of `list`, `next`, `hint` and `reset`."""

import argparse
import math
from functools import partial

from rich.console import Console

from raysteps.cli import whole_number
from raysteps.common.errors import UsageError
from raysteps.course.manifest import chosen_step
from raysteps.course.project import Project
from raysteps.progress.hints import print_hint
from raysteps.progress.standing import chosen_or_next, list_steps, next_step

STEP_NAMES = "02, 2 or 02-intersection"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Of the one whose parser it is; `list` and `next` have none."""
    name = parser.prog.rpartition(" ")[2]
    if name == "hint":
        parser.add_argument("step", nargs="?", metavar="STEP", help=f"{STEP_NAMES}; the next one when none is given")
        which = parser.add_mutually_exclusive_group()
        level = partial(whole_number, 1, math.inf)
        which.add_argument("--level", type=level, metavar="N", help="this hint, counted from 1")
        which.add_argument("--all", action="store_true", help="all hints of the step")
        which.add_argument("--again", action="store_true", help="those that you have read")
    elif name == "reset":
        parser.add_argument("step", metavar="STEP", help=STEP_NAMES)
        parser.add_argument("--yes", action="store_true", help="do not ask")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Runs one of the four."""
    match arguments.command:
        case "list":
            return list_steps(project, console)
        case "next":
            return next_step(project, console)
        case "hint":
            step = chosen_or_next(project, arguments.step)
            if step is None:
                raise UsageError("all steps are done; say which step's hint you want, such as: ./raysteps hint 02")
            wanted = arguments.level
            return print_hint(project, step, console, level=wanted, all_=arguments.all, again=arguments.again)
        case _:
            from raysteps.progress.reset import reset  # what tells differences takes long to load

            step = chosen_step(project, arguments.step)
            return reset(project, step, console, yes=arguments.yes)
