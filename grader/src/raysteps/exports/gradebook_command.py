"""`export canvas` and `export moodle`."""

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import UsageError
from raysteps.common.text import clean, count
from raysteps.exports.class_results import Graded, read_class, results_of
from raysteps.exports.csv_cells import read_sheet
from raysteps.exports.feedback import moodle_cell
from raysteps.exports.formats import write_out
from raysteps.exports.gradebook import fill
from raysteps.exports.gradebook_forms import MOODLE_COLUMNS, canvas, moodle
from raysteps.exports.hosted import by_id
from raysteps.kit.manifest import read_steps
from raysteps.kit.project import Project


def _renamed(text: str) -> tuple[str, str]:
    kind, _, name = text.partition("=")
    if kind not in MOODLE_COLUMNS or not name.strip():
        raise argparse.ArgumentTypeError(
            f"'{text}': expected KIND=HEADING with KIND one of {', '.join(MOODLE_COLUMNS)}"
        )
    return kind, name.strip()


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
            add.add_argument(
                "--column",
                type=_renamed,
                action="append",
                default=[],
                metavar="KIND=HEADING",
                help=f"a heading in another language; KIND is one of {', '.join(MOODLE_COLUMNS)}",
            )


def _is_same_file(one: Path, other: Path) -> bool:
    return one.resolve() == other.resolve()


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

    def feedback(one: Graded) -> str | None:
        return moodle_cell(documents.get(one.submission), one, steps)

    # Moodle leaves a grade above the maximum out without a word.
    filled = fill(sheet, book, graded, feedback, points=arguments.points, clip=is_moodle)
    for note in (*book.notes, *filled.notes):
        print(f"raysteps: {clean(note)}", file=sys.stderr)
    if not filled.graded:
        raise UsageError(
            f"{arguments.template}: no student in it is in {arguments.results / 'results.csv'}; nothing was written. "
            "Expected are the same ids, email addresses or names in both, such as by a --roster for grade-class"
        )
    write_out(arguments.out, sheet.filled(filled.changes))
    console.print(f"{escape(str(arguments.out))}: {count(filled.graded, 'grade')}", soft_wrap=True, highlight=False)
    return 0
