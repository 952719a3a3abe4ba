"""The command `report`: the page of results that are there already, of a submission or a class."""

import argparse
from pathlib import Path

from rich.console import Console

from raysteps.common.errors import UsageError, reason
from raysteps.common.platform import own_command
from raysteps.common.text import print_plain
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.progress.own_check import own_progress
from raysteps.progress.standing import standings
from raysteps.report.attempts import OwnProgress
from raysteps.report.student import write_student_page
from raysteps.report.terminal import short_path
from raysteps.results.store import RESULTS, read_results


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where the results are."""
    parser.add_argument(
        "place",
        type=Path,
        nargs="?",
        metavar="PLACE",
        help="a results.json, the folder that it lies in, or the folder of a class; your last check when none is given",
    )


def _student_page(project: Project, place: Path) -> Path:
    path = place / RESULTS if place.is_dir() else place
    results = read_results(path)
    try:
        return write_student_page(results, path.parent, read_steps(project), progress=_own(project, path.parent))
    except OSError as error:
        raise UsageError(f"{path.parent}: the report cannot be written there: {reason(error)}") from error


def _own(project: Project, folder: Path) -> OwnProgress:
    """What `check` keeps beside its own report; of others nothing is known."""
    if folder.resolve() != (project.build / "check").resolve():
        return OwnProgress()
    return own_progress(project, folder, standings(project))


def _class_page(place: Path) -> Path | None:
    """None where no class was graded."""
    from raysteps.classroom.class_files import (
        class_source,
        remake_class_page,  # students have none
    )

    source = class_source(place)
    return remake_class_page(source) if source is not None else None


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Writes report.html beside the results of a submission, class.html beside those of a class."""
    place: Path = arguments.place or project.build / "check"
    if arguments.place is None and not (place / RESULTS).is_file():
        raise UsageError(f"there is no check yet that could be shown: expected its {RESULTS}; {own_command()} check")
    page = _class_page(place) if project.has_reference else None
    page = page or _student_page(project, place)
    print_plain(console, f"Report: {short_path(page.resolve())}")
    return 0
