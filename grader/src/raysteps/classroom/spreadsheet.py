"""CSV that a spreadsheet shows and never runs."""

import csv
import io
import unicodedata
from collections.abc import Iterable, Sequence

from raysteps.common.text import number

Cell = str | float | int | None
_FORMULA = "=+-@"


def safe_cell(value: Cell) -> str:
    """Text that a spreadsheet would take for a formula, or that begins with a control character, gets a `'`.

    Numbers stay numbers."""
    if value is None:
        return ""
    if isinstance(value, (int, float)):
        return number(value)
    text = value.replace("\0", "")
    first = unicodedata.normalize("NFKC", text.lstrip())[:1]  # some take the wide forms of these signs, too
    controlled = bool(text) and unicodedata.category(text[0]) in ("Cc", "Cf")
    return f"'{text}" if controlled or (first and first in _FORMULA) else text


def csv_bytes(rows: Iterable[Sequence[Cell]]) -> bytes:
    """With a byte order mark: without it, Excel takes UTF-8 for something else."""
    out = io.StringIO(newline="")
    writer = csv.writer(out)
    for row in rows:
        writer.writerow([safe_cell(cell) for cell in row])
    return out.getvalue().encode("utf-8-sig")
