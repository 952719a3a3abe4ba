"""The command `grade`: somebody else's steps."""

import argparse
import hashlib
import os
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from rich.console import Console

from raysteps.cli import whole_number
from raysteps.common.errors import UsageError
from raysteps.common.files import file_lock
from raysteps.common.platform import kit_command, processor_count
from raysteps.common.text import join_some, print_plain
from raysteps.course.manifest import STEPS_HELP, chosen_steps, read_steps
from raysteps.course.project import Project
from raysteps.course.settings import read_course
from raysteps.grading.pipeline import grade_submission
from raysteps.grading.scoring import exit_code
from raysteps.grading.step import clear_old_results
from raysteps.grading.withhold import withhold
from raysteps.report.student import try_student_page
from raysteps.report.terminal import print_details, print_files, print_isolation, print_table, progress, short_path
from raysteps.results.model import Results, Settings
from raysteps.results.store import CASES_FOLDER, RESULTS
from raysteps.sandbox.detect import find_sandbox
from raysteps.submission.load import (
    archives_beside,
    load_submission,
    refuse_results_in,
    submission_name,
    submissions_inside,
)
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.limits import LIMIT_HELP, give_up_after, parse_limits, restart_clock


@dataclass(frozen=True)
class GradeOptions:
    """What was asked for on the command line of `grade`."""

    submission: Path
    out: Path | None = None
    settings: Settings = field(default_factory=Settings)
    require_sandbox: bool = False
    details: bool = True
    jobs: int | None = None  # steps at a time; as many as there are processors when not said


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What is graded, and how."""
    parser.add_argument("submission", type=Path, metavar="SUBMISSION", help="a folder, zip or tar")
    parser.add_argument("--out", type=Path, help="where results.json and the pictures go")
    parser.add_argument("--seed", type=int, metavar="N", help="of the hidden cases (that of course.toml, else 1)")
    parser.add_argument("--only", "--steps", nargs="+", default=[], metavar="STEP", help=f"these steps, {STEPS_HELP}")
    parser.add_argument(
        "--feedback", choices=["full", "diagnosis", "score"], default="full", help="what results.json tells"
    )
    parser.add_argument("--limit", action="append", default=[], metavar="NAME=VALUE", help=LIMIT_HELP)
    parser.add_argument("--require-sandbox", action="store_true", help="refuse to run without strong isolation")
    jobs = partial(whole_number, 1, 9999)
    parser.add_argument("--jobs", type=jobs, metavar="N", help="steps at a time (as many as there are processors)")


def seconds_at_most(words: Sequence[str]) -> float:
    """How long the command may take that begins with its name; what is wrong with its words is found later."""
    parser = argparse.ArgumentParser(add_help=False, exit_on_error=False)
    parser.add_argument("--limit", action="append", default=[])
    try:
        changes = parse_limits(parser.parse_known_args(words)[0].limit)
    except (argparse.ArgumentError, UsageError):
        changes = {}
    return give_up_after(changes)


_NAMED = 5


def _refuse_a_class(project: Project, path: Path) -> None:
    """Of two submissions in one folder neither could be taken: the student would get nothing."""
    names = submissions_inside(path, read_steps(project))
    if names:
        one, all_ = kit_command("grade", path / names[0]), kit_command("grade-class", path, "--out", "grades")
        raise UsageError(
            f"{path}: holds several submissions, among them {join_some(names, _NAMED)}. "
            f"Grade one of them with `{one}`, or all with `{all_}`"
        )


def _name_archives_beside(project: Project, path: Path, console: Console) -> None:
    """A student's own old ones, or those of a class of which one was unpacked."""
    names = archives_beside(path, read_steps(project))
    if names:
        all_ = kit_command("grade-class", path, "--out", "grades")
        print_plain(
            console, f"Not graded: {join_some(names, _NAMED)}. If they are other submissions, grade all with `{all_}`"
        )


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Grades one submission."""
    chosen = chosen_steps(project, arguments.only)
    _refuse_a_class(project, arguments.submission)
    only = [step.id for step in chosen] if chosen != read_steps(project) else []
    seed = read_course(project).seed_or(arguments.seed)
    settings = Settings(arguments.feedback, parse_limits(arguments.limit), tuple(only), seed)
    options = GradeOptions(
        arguments.submission, arguments.out, settings, arguments.require_sandbox, jobs=arguments.jobs
    )
    results = grade(project, options, console)
    _name_archives_beside(project, arguments.submission, console)
    return exit_code(results)


def _room(project: Project) -> Path:
    """For locks, and for results that nobody named a folder for: the kit's, or where it may only be read, as in an
    image, one that goes away with the container."""
    place = project.build if project.build.exists() else project.root
    if os.access(place, os.W_OK):
        return project.build
    user = "" if sys.platform == "win32" else f"-{os.getuid()}"  # there everybody has a folder of his own
    return Path(tempfile.gettempdir()) / f"raysteps{user}"


def grade(project: Project, options: GradeOptions, console: Console) -> Results:
    """Grades one submission in the sandbox, writes its results and prints what came out."""

    def again(case: str) -> str:
        return kit_command("replay", short_path(out / case), "--submission", options.submission)

    def say_of_kit(text: str) -> None:
        restart_clock()  # no submission's time
        say(text)

    if options.out is not None:
        refuse_results_in(options.submission, options.out, ("pictures", CASES_FOLDER))
    course = read_course(project).name
    sandbox = find_sandbox(require=options.require_sandbox)
    room = _room(project)
    out = (options.out or room / "grade" / submission_name(options.submission)).resolve()
    lock = hashlib.sha256(str(out).encode()).hexdigest()[:16]
    with console.status("starting") as status:
        say = progress(console, status)
        with file_lock(room / "locks" / lock, lambda: say(f"waiting for another command, which grades into {out}")):
            submission = load_submission(options.submission, read_steps(project))
            kit = build_kit(project, say_of_kit)
            restart_clock()
            replaces = (out / RESULTS).exists() and bool(options.settings.only)
            clear_old_results(out, kit.steps, kit.steps)
            jobs = options.jobs or processor_count()
            results = grade_submission(kit, submission, options.settings, sandbox, out, say, jobs=jobs, course=course)
            told = withhold(results, options.settings.feedback)  # the terminal may be the student's, too
            page = try_student_page(out, kit.steps, say)  # which may be handed back: no paths of this machine

    if options.details:
        print_details(console, told, kit.steps, out, again)
        console.print()
    print_table(console, told)
    print_isolation(console, results)
    if replaces:
        console.print("These steps take the place of all that was graded into this folder before.")
    if options.out is None and room != project.build:
        console.print("Results were not kept: the kit may only be read here. Name a folder for them with --out.")
    else:
        print_files(console, out / RESULTS, page)
    return results
