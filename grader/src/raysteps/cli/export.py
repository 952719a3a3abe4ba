"""The command `export`: results, autograders, gradebooks and reports for other systems."""

import argparse
import json
import re
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console

from raysteps.classroom.class_files import refuse_unwritten
from raysteps.classroom.database import SUBMISSIONS
from raysteps.cli.give_back import SYSTEMS as WAYS_BACK
from raysteps.cli.give_back import add_give_back_arguments, add_renamed_columns, give_back
from raysteps.common.errors import UsageError
from raysteps.common.files import write_out
from raysteps.common.text import clean, count, print_plain
from raysteps.course.manifest import STEPS_HELP, Step, chosen_steps, course_steps, read_steps, steps_words
from raysteps.course.project import Project
from raysteps.course.settings import read_course
from raysteps.exports import hosted as running
from raysteps.exports.autograders import (
    autolab_tar,
    classroom50_autograder,
    github_workflow,
    gradescope_zip,
    into_folder,
    prairielearn_course,
)
from raysteps.exports.autolab import as_lines, to_autolab
from raysteps.exports.class_results import GradedStudent, moodle_cell, read_class, results_of
from raysteps.exports.formats import validate, write
from raysteps.exports.github import release_assets
from raysteps.exports.gradebook import canvas, fill, moodle, read_sheet
from raysteps.exports.gradescope import VISIBILITIES, submitters, to_gradescope
from raysteps.exports.hosted import Options, by_id
from raysteps.exports.prairielearn import SECONDS, to_prairielearn
from raysteps.exports.similarity import add_similarity_arguments, export_similarity
from raysteps.grading.withhold import withhold
from raysteps.results.store import read_results
from raysteps.toolchain.limits import LIMIT_HELP, parse_limits

# `export canvas` and `export moodle`.


def add_gradebook_arguments(systems: "argparse._SubParsersAction[Any]") -> None:
    """Both fill a file that was exported from the system."""
    for system, title in (("canvas", "a gradebook exported from Canvas"), ("moodle", "a Moodle grading worksheet")):
        add = systems.add_parser(system, help=f"fill in {title}")
        add.add_argument("--template", type=Path, required=True, metavar="FILE", help=title)
        add.add_argument("--results", type=Path, required=True, metavar="DIR", help="the output of grade-class")
        add.add_argument("--out", type=Path, required=True, metavar="FILE", help="the filled file")
        add.add_argument(
            "--points", choices=["scale", "as-is"], help="what to do when the maximum there is not the kit's"
        )
        if system == "canvas":
            add.add_argument("--assignment", metavar="NAME", help="its name or number, when there are several")
        else:
            add_renamed_columns(add)


def _is_same_file(one: Path, other: Path) -> bool:
    return one.resolve() == other.resolve()


_ALL_NAMES = 1_000_000  # characters: one line may name a whole class


def fill_gradebook(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Writes the filled file, and says on stderr whom it could not grade."""
    if _is_same_file(arguments.template, arguments.out):
        raise UsageError(f"{arguments.out}: is the template; expected another name")
    sheet = read_sheet(arguments.template)
    is_moodle = arguments.system == "moodle"
    renamed: Mapping[str, str] = dict(arguments.column) if is_moodle else {}
    book = moodle(sheet, renamed) if is_moodle else canvas(sheet, arguments.assignment)
    steps = by_id(read_steps(project))

    graded = read_class(arguments.results)
    documents = {one.submission: results_of(arguments.results, one) for one in graded if one.submission}

    def feedback(one: GradedStudent) -> str | None:
        return moodle_cell(documents.get(one.submission), one, steps)

    # Moodle leaves a grade above the maximum out without a word.
    filled = fill(sheet, book, graded, feedback, points=arguments.points, clip=is_moodle)
    for note in (*book.notes, *filled.notes):
        print(f"raysteps: {clean(note, _ALL_NAMES)}", file=sys.stderr)
    if not filled.graded:
        raise UsageError(
            f"{arguments.template}: no student in it is in {arguments.results / 'results.csv'}; nothing was written. "
            "Expected are the same ids, email addresses or names in both, such as by a --roster for grade-class"
        )
    write_out(arguments.out, sheet.filled(filled.changes))
    print_plain(console, f"{arguments.out}: {count(filled.graded, 'grade')}")
    return 0


# The options of `export`.

_NUMBER = re.compile(r"[0-9]{1,18}")
_MAX_MINUTES = 24 * 60


def _seed(text: str) -> str:
    if not _NUMBER.fullmatch(text):
        raise argparse.ArgumentTypeError(f"'{text}' is not a seed; expected a whole number from 0 on")
    return text


def _minutes(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value <= _MAX_MINUTES:
        raise argparse.ArgumentTypeError(f"'{text}' is not a time; expected minutes, such as 9")
    return value


def _add_grading(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("how submissions are graded there")
    group.add_argument("--require-sandbox", action="store_true", help="grade only where student code can be shut in")
    group.add_argument("--seed", type=_seed, metavar="N", help="of the hidden cases")
    group.add_argument("--feedback", choices=["full", "diagnosis", "score"], help="how much the results tell")
    group.add_argument(
        "--steps",
        "--only",
        dest="steps",
        nargs="+",
        default=[],
        metavar="STEP",
        help=f"only these, {STEPS_HELP}; those of course.toml, else all, when none is given",
    )
    group.add_argument("--limit", action="append", default=[], metavar="NAME=VALUE", help=LIMIT_HELP)
    group.add_argument("--minutes", type=_minutes, default=9.0, metavar="N", help="give up after that long (9)")


def _add_results(parser: argparse.ArgumentParser) -> None:
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--results", type=Path, metavar="FILE", help="a results.json of `grade`, to be converted")
    source.add_argument("--run", type=Path, metavar="PLACE", help="grade there: what the autograder itself calls")
    parser.add_argument("--out", type=Path, metavar="FILE", help="where the outcome goes")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The systems and their options."""
    systems = parser.add_subparsers(dest="system", required=True, metavar="SYSTEM")
    add = systems.add_parser("gradescope", help="autograder.zip, or one results.json")
    _add_results(add)
    add.add_argument("--hidden", choices=VISIBILITIES, default="visible", help="who sees the hidden checks (visible)")
    add.add_argument("--metadata", type=Path, metavar="FILE", help="submission_metadata.json, with --results")
    _add_grading(add)
    add = systems.add_parser("classroom50", help="result.json, its autograder.py, or a workflow")
    _add_results(add)
    add.add_argument("--legacy", action="store_true", help="the output of GitHub Classroom's autograding instead")
    add.add_argument("--repository", type=Path, default=Path(), metavar="DIR", help="the checked out submission (.)")
    add.add_argument("--workflow", type=Path, metavar="FILE", help="write a workflow that grades")
    add.add_argument("--kit", metavar="OWNER/REPOSITORY", help="where the workflow finds the kit")
    add.add_argument("--autograder", type=Path, metavar="FILE", help="write an autograder.py")
    _add_grading(add)
    add = systems.add_parser("autolab", help="a tar with Makefile and driver, or the last lines of one")
    _add_results(add)
    _add_grading(add)
    add = systems.add_parser("prairielearn", help="a question, its grader and an image, or one results.json")
    _add_results(add)
    add.add_argument("--image", default="", metavar="ACCOUNT/NAME", help="what the image that grades will be called")
    _add_grading(add)
    add_gradebook_arguments(systems)
    add_give_back_arguments(systems)
    add_similarity_arguments(systems)


def grading_words(arguments: argparse.Namespace, steps: Sequence[str]) -> list[str]:
    """The options that are passed on to `grade`."""
    words = ["--require-sandbox"] if arguments.require_sandbox else []
    words += ["--seed", arguments.seed] if arguments.seed is not None else []
    words += ["--feedback", arguments.feedback] if arguments.feedback is not None else []
    for limit in arguments.limit:
        words += ["--limit", limit]
    return words + (["--only", *steps] if steps else [])


def refuse_grading_words(arguments: argparse.Namespace) -> None:
    """With --results everything is graded already; only --feedback still makes a difference."""
    for word in grading_words(arguments, arguments.steps):
        if word.startswith("--") and word != "--feedback":
            option = "--steps" if word == "--only" else word
            raise UsageError(f"--results converts what is graded already; leave {option} out, it is for grading")


def script_words(arguments: argparse.Namespace) -> list[str]:
    """The same options as `export` takes them, for the scripts that call it."""
    chosen = [] if arguments.system == "prairielearn" else arguments.steps  # there the question says which
    words = ["--minutes", f"{arguments.minutes:g}", *grading_words(arguments, chosen)]
    words = ["--steps" if word == "--only" else word for word in words]
    return ["--hidden", arguments.hidden, *words] if arguments.system == "gradescope" else words


def out_file(arguments: argparse.Namespace, what: str) -> Path:
    """--out, where it cannot be left away."""
    if arguments.out is None:
        raise UsageError(f"say where it goes with --out {what}")
    path: Path = arguments.out
    return path


# Writes what is uploaded to another system.

_MARGIN = 30  # seconds that are left for what happens before and after grading


def package(project: Project, arguments: argparse.Namespace) -> list[Path]:
    """The files or folders that were written."""
    steps = chosen_steps(project, arguments.steps)
    parse_limits(arguments.limit)
    words = script_words(arguments)
    match arguments.system:
        case "gradescope":
            path = out_file(arguments, "autograder.zip")
            write_out(path, gradescope_zip(project, words))
        case "autolab":
            path = out_file(arguments, "raysteps-autolab.tar")
            write_out(path, autolab_tar(project, words, steps))
        case "prairielearn":
            path = out_file(arguments, "pl-raysteps")
            if arguments.minutes * 60 > SECONDS - _MARGIN:
                raise UsageError(
                    f"PrairieLearn itself ends a job after {SECONDS} seconds; "
                    f"expected --minutes {(SECONDS - _MARGIN) / 60:g} or less"
                )
            chosen = [step.number for step in steps] if arguments.steps else []
            into_folder(prairielearn_course(project, words, steps, chosen, arguments.image), path)
        case _:
            return _package_github(arguments, words, steps)
    return [path]


def _package_github(arguments: argparse.Namespace, words: list[str], steps: Sequence[Step]) -> list[Path]:
    if arguments.workflow is not None:
        write_out(arguments.workflow, github_workflow(arguments.kit, words, legacy=arguments.legacy))
    if arguments.autograder is not None:
        write_out(arguments.autograder, classroom50_autograder(words))
        listed = json.dumps(release_assets(step.id for step in steps))
        print(f'raysteps: give the assignment "release_assets": {listed}', file=sys.stderr)
    written = [path for path in (arguments.workflow, arguments.autograder) if path is not None]
    if not written:
        raise UsageError("expected --results FILE, --workflow FILE or --autograder FILE")
    return written


def _options(arguments: argparse.Namespace) -> Options:
    words = tuple(grading_words(arguments, arguments.steps))
    return Options(arguments.minutes * 60, tuple(arguments.steps), words, echo=arguments.system == "gradescope")


def _run_there(project: Project, arguments: argparse.Namespace) -> int:
    place, options = arguments.run.resolve(), _options(arguments)
    match arguments.system:
        case "gradescope":
            return running.gradescope(project, place, options, arguments.hidden)
        case "prairielearn":
            return running.prairielearn(project, place, options)
        case "autolab":
            return running.autolab(project, place, options)
        case _:
            return running.github(project, place, options, arguments.out, legacy=arguments.legacy)


def _convert(project: Project, arguments: argparse.Namespace) -> int:
    refuse_grading_words(arguments)
    home = arguments.results.resolve().parent.parent
    if home.name == SUBMISSIONS:  # of a class
        refuse_unwritten(home.parent)
    document, steps = read_results(arguments.results), by_id(read_steps(project))
    document = withhold(document, arguments.feedback or "full")
    match arguments.system:
        case "gradescope":
            names = submitters(arguments.metadata) if arguments.metadata is not None else []
            folder = arguments.results.parent
            results = to_gradescope(document, steps, hidden=arguments.hidden, names=names, folder=folder)
            write(results, "gradescope", out_file(arguments, "results.json"))
        case "prairielearn":
            results = to_prairielearn(document, steps, arguments.results.parent)
            write(results, "prairielearn", out_file(arguments, "results.json"))
        case "autolab":
            lines = to_autolab(document, steps)
            validate(lines, "autolab")
            if arguments.out is None:
                print(as_lines(lines), end="", flush=True)
            else:
                write_out(arguments.out, as_lines(lines).encode())
        case _:
            running.deliver_github(
                document,
                steps,
                arguments.out,
                arguments.repository,
                arguments.results.parent,
                legacy=arguments.legacy,
            )
    return 0


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Runs `export` and returns its exit code."""
    if arguments.system in ("canvas", "moodle"):
        return fill_gradebook(project, arguments, console)
    if arguments.system in WAYS_BACK:
        return give_back(arguments, console)
    if arguments.system == "similarity":
        return export_similarity(project, arguments)
    if arguments.run is not None:
        return _run_there(project, arguments)
    if arguments.results is not None:
        return _convert(project, arguments)
    course = read_course(project)
    if arguments.seed is None and course.seed is not None:
        arguments.seed = str(course.seed)  # what is uploaded does not take course.toml along
    if not arguments.steps and course.steps:
        arguments.steps = steps_words(course_steps(project))
    for path in package(project, arguments):
        print(f"raysteps: wrote {path}", file=sys.stderr)
    return 0
