"""The feedback on a submission as the cell of a gradebook."""

from collections.abc import Mapping
from pathlib import Path

from raysteps.common.cells import harmless_cell
from raysteps.common.text import number
from raysteps.exports.class_results import Graded, results_of
from raysteps.exports.summary import summary
from raysteps.exports.wording import as_html
from raysteps.kit.manifest import Step

_LIMIT = 8000


def moodle_cell(folder: Path, graded: Graded, steps: Mapping[str, Step]) -> str:
    """What the results say, as HTML on one line: Moodle shows comments as HTML."""
    document = results_of(folder, graded)
    lines = [summary(document, steps, checks=True)] if document is not None else []
    if graded.points is not None and graded.in_time is not None and graded.points != graded.in_time:
        lines.insert(0, f"{number(graded.in_time)} points, {number(graded.points)} after lateness.")
    return harmless_cell(as_html("\n".join(lines), _LIMIT))
