"""The command `check`: a student's own steps."""

import argparse

from rich.console import Console

from raysteps.course.manifest import choose, read_steps
from raysteps.course.project import Project
from raysteps.grading.scoring import exit_code
from raysteps.progress.check import check_steps
from raysteps.report.terminal import print_details, print_files, print_table, progress
from raysteps.report.wording import replay_command


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which steps."""
    parser.add_argument("steps", nargs="*", metavar="STEP", help="02, 2 or 02-intersection; all when none is given")


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Checks the steps in the repository and explains what is wrong."""
    chosen = choose(read_steps(project), arguments.steps)
    out = project.build / "check"
    with console.status("starting") as status:
        checked = check_steps(project, chosen, progress(console, status))
    print_details(console, checked.results, checked.kit.steps, out, replay_command)
    console.print()
    print_table(console, checked.results, visible_only=not project.has_reference)
    print_files(console, out / "results.json", checked.page)
    return exit_code(checked.results)
