"""The commands of ./raysteps in a students' kit."""

import argparse
from collections.abc import Sequence

from rich.console import Console

from raysteps.commands import for_students, update
from raysteps.kit.project import Project


def _parser() -> argparse.ArgumentParser:
    parser = for_students.new_parser("A ray tracer in graded steps.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    for_students.add_arguments(commands.add_parser)
    update.add_arguments(commands.add_parser("update", help="take in a newer kit; your own files stay"))
    return parser


def _run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    return update.run(project, arguments, console)


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one command and returns its exit code."""
    return for_students.run_line(_parser(), _run, argv)
