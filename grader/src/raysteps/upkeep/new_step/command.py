"""The command `dev new`."""

import argparse
import math
from typing import Any

from raysteps.kit.project import Project
from raysteps.upkeep.new_step.writing import make_step

_MOST_POINTS = 1000


def _points(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not (math.isfinite(value) and 0 < value <= _MOST_POINTS):
        raise argparse.ArgumentTypeError(f"'{text}' are no points; expected a number above 0, such as 10")
    return value


def _title(text: str) -> str:
    if not text.strip() or not text.isprintable() or len(text) > 60:
        raise argparse.ArgumentTypeError("expected a title of one line and at most 60 characters, such as 'Fog'")
    return text.strip()


def add_arguments(commands: "argparse._SubParsersAction[Any]") -> None:
    """`dev new NN-name`."""
    add = commands.add_parser("new", help="begin a step of your own: a small one that works, to be filled")
    add.add_argument("name", metavar="NN-name", help="the next number and a name, such as 10-fog")
    add.add_argument("--title", type=_title, help="as students read it (from the name)")
    add.add_argument("--points", type=_points, default=10.0, metavar="P", help="what it is worth (10)")
    add.add_argument("--bonus", action="store_true", help="its points are not needed for full marks")


def run(project: Project, arguments: argparse.Namespace) -> int:
    """Writes the step and says how to go on."""
    name = arguments.name
    title = arguments.title or name[3:].replace("-", " ").capitalize()
    for path in make_step(project, name, title, arguments.points, bonus=arguments.bonus):
        print(f"{path} written")
    print(
        f"{name} works as it is. Fill it: docs/instructors.md tells what each file is for. Then:\n"
        f"  ./raysteps dev stubs && ./raysteps dev samples\n"
        f"  ./raysteps dev check --only {name[:2]}"
    )
    return 0
