"""The command `check`: a student's own steps."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from rich.console import Console
from rich.text import Text

from raysteps.common.platform import own_command
from raysteps.course.manifest import STEPS_HELP, chosen_steps
from raysteps.course.project import Project
from raysteps.grading.scoring import exit_code
from raysteps.progress.check import check_steps
from raysteps.progress.standing import ALL_DONE
from raysteps.report.terminal import print_details, print_diagnoses, print_files, print_table, progress
from raysteps.report.wording import replay_command, watch_command
from raysteps.results.store import RESULTS
from raysteps.updater.release_list import about_changed

if TYPE_CHECKING:
    from raysteps.progress.own_check import CheckResult
    from raysteps.results.model import HiddenResult, ImageResult, StepResult, TestResult


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which steps."""
    parser.add_argument("steps", nargs="*", metavar="STEP", help=f"{STEPS_HELP}; all when none is given")


def _is_unexplained(result: StepResult) -> bool:
    """Wrong, and neither for want of a function nor by a crash or a hang, of which the line is told."""
    items: list[TestResult | ImageResult | HiddenResult] = [*result.tests, *result.images, *result.hidden]
    wrong = [item for item in items if not item.passed and not item.waits_for]
    return bool(wrong) and all(item.outcome == "wrong" for item in wrong)


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Checks the steps in the repository and explains what is wrong."""
    chosen = chosen_steps(project, arguments.steps)
    out = project.build / "check"
    told = False

    def tell(found: CheckResult) -> None:
        nonlocal told
        told = True
        print_details(console, found.results, found.kit.steps, out, replay_command, own=True)
        console.print()
        print_table(console, found.results, visible_only=not project.has_reference)
        print_files(console, out / RESULTS, found.page)

    with console.status("starting") as status:
        checked = check_steps(project, chosen, progress(console, status), tell)
    has_learned = told and project.has_reference
    if not told:
        tell(checked)
    if any(result.diagnoses for result in checked.results.steps):
        print_diagnoses(console, checked.results, checked.kit.steps)
    elif has_learned and any(map(_is_unexplained, checked.results.steps)):
        console.print("The known mistakes are learned; none of them explains what is wrong.")
    changed = about_changed(project.root)
    if changed:
        console.print(Text(changed, "yellow"))
    code = exit_code(checked.results)
    if code == 0 and checked.following is not None:
        console.print(f"Next: {watch_command(checked.following.id)}")
    elif code == 0:
        console.print(ALL_DONE.format(own_command()))
    return code
