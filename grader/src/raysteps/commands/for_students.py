"""The commands that students type; they are the same in the whole kit and in a students' kit."""

import argparse
from collections.abc import Callable, Sequence

from rich.console import Console

from raysteps.commands import compare, report_page
from raysteps.commands.check import check
from raysteps.commands.course import command as course
from raysteps.commands.ending import EXITS, console_here, ended
from raysteps.commands.inspect import command as inspect
from raysteps.commands.render import render
from raysteps.commands.view import view
from raysteps.commands.watch import command as watch
from raysteps.kit.project import Project, here

Commands = Callable[..., argparse.ArgumentParser]  # adds one, from its name and help
_PROGRAMS = {"render": render, "view": view}  # what follows is for the program, and not read here


def new_parser(description: str) -> argparse.ArgumentParser:
    """Of `raysteps`, without commands."""
    return argparse.ArgumentParser(
        prog="raysteps",
        description=description,
        epilog=EXITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )


def add_arguments(add_command: Commands) -> None:
    """Adds them all."""
    impl = "; --impl mine|reference" if here().has_reference else ""
    watch.add_arguments(add_command("watch", help="build, test and draw a step again with every save"))
    course.add_arguments(add_command)
    add = add_command("render", help=f"render a scene with your own steps: the arguments of raytrace{impl}")
    add.add_argument("args", nargs=argparse.REMAINDER)
    inspect.add_arguments(add_command("inspect", help="follow one pixel: its rays, tests and light"))
    add = add_command("view", help=f"a window on a scene: move the camera, click pixels{impl}")
    add.add_argument("args", nargs=argparse.REMAINDER)
    add = add_command("check", help="check your own steps")
    add.add_argument("steps", nargs="*", metavar="STEP", help="02, 2 or 02-intersection; all when none is given")
    compare.add_arguments(add_command("compare", help="two pictures, pixel by pixel"))
    report_page.add_arguments(add_command("report", help="make report.html of results that are there already"))


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int | None:
    """None where the command is not one of them."""
    match arguments.command:
        case "watch":
            return watch.run(project, arguments, console)
        case "inspect":
            return inspect.run(project, arguments, console)
        case "check":
            return check(project, arguments.steps, console)
        case "compare":
            return compare.run(arguments, console)
        case "report":
            return report_page.run(project, arguments, console)
        case name if name in course.COMMANDS:
            return course.run(project, arguments, console)
        case _:
            return None


def run_line(
    parser: argparse.ArgumentParser,
    rest: Callable[[Project, argparse.Namespace, Console], int],
    argv: Sequence[str] | None,
) -> int:
    """Runs one command and returns its exit code; `rest` runs what is not for students alone."""

    def started(words: Sequence[str]) -> int:
        project = here()
        program = _PROGRAMS.get(words[0])
        if program is not None:
            return program(project, list(words[1:]))
        arguments, console = parser.parse_args(words), console_here()
        code = run(project, arguments, console)
        return rest(project, arguments, console) if code is None else code

    return ended(started, parser, argv)
