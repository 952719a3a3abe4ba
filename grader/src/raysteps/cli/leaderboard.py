"""The command `leaderboard`."""

import argparse
from pathlib import Path

from rich.console import Console

from raysteps.classroom.leaderboard import (
    leaderboard,
    nowhere_ranked,
    print_board,
    print_caption,
    print_nowhere_ranked,
    rank,
    read_entries,
)
from raysteps.common.documents import plain
from raysteps.common.errors import UsageError
from raysteps.common.files import encoded, write_out
from raysteps.common.text import join_and, print_plain
from raysteps.course.manifest import Step, chosen_steps, course_steps, read_steps
from raysteps.course.project import Project


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where the results are, and what to make of them."""
    parser.add_argument(
        "places",
        nargs="+",
        type=Path,
        metavar="PLACE",
        help="the folder of a graded class, its class.json or class.sqlite, or results.json files",
    )
    parser.add_argument(
        "--step",
        action="append",
        default=[],
        metavar="STEP",
        help="such as 06 or 6,9 (those of the course with counters)",
    )
    parser.add_argument("--anonymous", action="store_true", help="leave the names out")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the ranking there, too")


def _steps(project: Project, names: list[str]) -> list[Step]:
    counted = [step.id for step in read_steps(project) if step.limited_pictures]
    ours = [step.id for step in course_steps(project) if step.id in counted]
    if not (counted if names else ours):
        raise UsageError("no step of this course has a tree whose work is counted, so there is nothing to rank")
    chosen = chosen_steps(project, names or ours)
    for step in chosen:
        if step.id not in counted:
            raise UsageError(f"--step: in {step.id} no work is counted; expected {join_and(counted)}")
    return chosen


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """0 when the boards were made, also where nobody can be ranked."""
    steps = _steps(project, arguments.step)
    entered = read_entries(arguments.places)
    boards = [rank(entered, step) for step in steps]
    document = leaderboard(boards, anonymous=arguments.anonymous)
    nowhere = nowhere_ranked(boards)
    for board in boards:
        print_board(console, board, anonymous=arguments.anonymous, told=nowhere)
        console.print()
    if nowhere is not None:
        print_nowhere_ranked(console, nowhere, anonymous=arguments.anonymous)
        console.print()
    print_caption(console)
    if arguments.json is not None:
        write_out(arguments.json, encoded(plain(document)))
        print_plain(console, f"Ranking: {arguments.json}")
    return 0
