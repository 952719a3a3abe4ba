"""The commands of ./raysteps in a students' kit."""

import argparse
from collections.abc import Sequence

from rich.console import Console

from raysteps.commands import report_page, update
from raysteps.commands.check import check
from raysteps.commands.course import command as course
from raysteps.commands.ending import EXITS, console_here, ended
from raysteps.commands.inspect import command as inspect
from raysteps.commands.render import render
from raysteps.commands.view import view
from raysteps.commands.watch import command as watch
from raysteps.kit.project import here


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="raysteps",
        description="A ray tracer in graded steps.",
        epilog=EXITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    watch.add_arguments(commands.add_parser("watch", help="build, test and draw a step again with every save"))
    course.add_arguments(commands.add_parser)
    add = commands.add_parser("render", help="render a scene with your own steps: the arguments of raytrace")
    add.add_argument("args", nargs=argparse.REMAINDER)
    add = commands.add_parser("view", help="a window on a scene, drawn with your own steps")
    add.add_argument("args", nargs=argparse.REMAINDER)
    inspect.add_arguments(commands.add_parser("inspect", help="follow one pixel: its rays, tests and light"))
    add = commands.add_parser("check", help="check your own steps: visible tests and pictures")
    add.add_argument("steps", nargs="*", metavar="STEP", help="02, 2 or 02-intersection; all when none is given")
    report_page.add_arguments(commands.add_parser("report", help="make report.html of results that are there already"))
    update.add_arguments(commands.add_parser("update", help="take in a newer kit; your own files stay"))
    return parser


def _run(arguments: argparse.Namespace, console: Console) -> int:
    project = here()
    match arguments.command:
        case "watch":
            return watch.run(project, arguments, console)
        case "check":
            return check(project, arguments.steps, console)
        case "inspect":
            return inspect.run(project, arguments, console)
        case "report":
            return report_page.run(project, arguments, console)
        case "update":
            return update.run(project, arguments, console)
        case _:
            return course.run(project, arguments, console)


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one command and returns its exit code."""

    def run(words: Sequence[str]) -> int:
        if words[0] == "render":
            return render(here(), list(words[1:]))
        if words[0] == "view":
            return view(here(), list(words[1:]))
        return _run(_parser().parse_args(words), console_here())

    return ended(run, _parser(), argv)
