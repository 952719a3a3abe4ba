"""The command lines of `list`, `next`, `hint` and `reset`."""

import argparse
from collections.abc import Callable

from rich.console import Console

from raysteps.commands.course.hints import print_hint
from raysteps.commands.course.listing import list_steps, next_step
from raysteps.commands.course.reset import reset
from raysteps.commands.course.standing import chosen_or_next
from raysteps.common.errors import UsageError
from raysteps.kit.manifest import choose, read_steps
from raysteps.kit.project import Project

COMMANDS = ("list", "next", "hint", "reset")
STEP_NAMES = "02, 2 or 02-intersection"

AddCommand = Callable[..., argparse.ArgumentParser]


def add_arguments(add_command: AddCommand) -> None:
    """Adds all four; `add_command` takes a name and its help."""
    add_command("list", help="the steps, and where you stand")
    add_command("next", help="which step to work on, what to open and what to type")
    add = add_command("hint", help="the next hint of a step")
    add.add_argument("step", nargs="?", metavar="STEP", help=f"{STEP_NAMES}; the next one when none is given")
    which = add.add_mutually_exclusive_group()
    which.add_argument("--level", type=int, metavar="N", help="this hint, counted from 1")
    which.add_argument("--all", action="store_true", help="all hints of the step")
    which.add_argument("--again", action="store_true", help="those that you have read")
    add = add_command("reset", help="begin a step again: your file is kept in build/reset/")
    add.add_argument("step", metavar="STEP", help=STEP_NAMES)
    add.add_argument("--yes", action="store_true", help="do not ask")


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
            step = choose(read_steps(project), [arguments.step])[0]
            return reset(project, step, console, yes=arguments.yes)
