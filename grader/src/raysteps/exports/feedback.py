"""The feedback on a submission as the cell of a gradebook."""

import re
from collections.abc import Mapping

from raysteps.common.cells import FORMULA_SIGNS, harmless_cell
from raysteps.common.text import number
from raysteps.exports.class_results import Graded
from raysteps.exports.summary import Document, summary
from raysteps.exports.wording import as_html
from raysteps.kit.manifest import Step

_LIMIT = 8000
_SIGNS = re.compile(rf"(?<=;)[\s{re.escape(FORMULA_SIGNS)}]+")


def _plain_signs(html: str) -> str:
    """An entity ends with a semicolon: what a spreadsheet might take for a formula after it becomes one, too."""
    signs = {ord(one): f"&#{ord(one)};" for one in FORMULA_SIGNS}
    return _SIGNS.sub(lambda found: found[0].translate(signs), html)


def moodle_cell(document: Document | None, graded: Graded, steps: Mapping[str, Step]) -> str | None:
    """What the results say, as HTML on one line: Moodle shows comments as HTML. None where there are none."""
    if document is None:
        return None
    lines = [summary(document, steps, checks=True)]
    if graded.points is not None and graded.in_time is not None and graded.points != graded.in_time:
        lines.insert(0, f"{number(graded.in_time)} points, {number(graded.points)} after lateness.")
    return harmless_cell(_plain_signs(as_html("\n".join(lines), _LIMIT)))
