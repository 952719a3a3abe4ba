"""The options of `export`."""

import argparse
import re
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.exports.gradebook_command import add_gradebook_arguments
from raysteps.exports.gradescope import VISIBILITIES
from raysteps.exports.similarity import add_similarity_arguments

_NUMBER = re.compile(r"[0-9]{1,18}")
_MOST_MINUTES = 24 * 60


def _seed(text: str) -> str:
    if not _NUMBER.fullmatch(text):
        raise argparse.ArgumentTypeError(f"'{text}' is not a seed; expected a whole number from 0 on")
    return text


def _minutes(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value <= _MOST_MINUTES:
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
        help="only these; all when none is given",
    )
    group.add_argument("--limit", action="append", default=[], metavar="NAME=VALUE", help="such as memory_mb=512")
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
    add = systems.add_parser("prairielearn", help="a folder for serverFilesCourse, or one results.json")
    _add_results(add)
    _add_grading(add)
    add_gradebook_arguments(systems)
    add_similarity_arguments(systems)


def grading_words(arguments: argparse.Namespace) -> list[str]:
    """The options that are passed on to `grade`."""
    words = ["--require-sandbox"] if arguments.require_sandbox else []
    words += ["--seed", arguments.seed] if arguments.seed is not None else []
    words += ["--feedback", arguments.feedback] if arguments.feedback is not None else []
    for limit in arguments.limit:
        words += ["--limit", limit]
    return words + (["--only", *arguments.steps] if arguments.steps else [])


def refuse_grading_words(arguments: argparse.Namespace) -> None:
    """With --results everything is graded already; only --feedback still makes a difference."""
    for word in grading_words(arguments):
        if word.startswith("--") and word != "--feedback":
            option = "--steps" if word == "--only" else word
            raise UsageError(f"--results converts what is graded already; leave {option} out, it is for grading")


def script_words(arguments: argparse.Namespace) -> list[str]:
    """The same options as `export` takes them, for the scripts that call it."""
    words = ["--minutes", f"{arguments.minutes:g}", *grading_words(arguments)]
    words = ["--steps" if word == "--only" else word for word in words]
    return ["--hidden", arguments.hidden, *words] if arguments.system == "gradescope" else words


def out_file(arguments: argparse.Namespace, what: str) -> Path:
    """--out, where it cannot be left away."""
    if arguments.out is None:
        raise UsageError(f"say where it goes with --out {what}")
    path: Path = arguments.out
    return path
