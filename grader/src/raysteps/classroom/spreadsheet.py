"""CSV that a spreadsheet shows and never runs."""

import csv
import io
from collections.abc import Iterable, Sequence

from raysteps.common.cells import harmless_cell
from raysteps.common.text import number

Cell = str | float | int | None


def safe_cell(value: Cell) -> str:
    """Text is made harmless; numbers stay numbers."""
    if value is None:
        return ""
    if isinstance(value, (int, float)):
        return number(value)
    return harmless_cell(value)


def csv_bytes(rows: Iterable[Sequence[Cell]]) -> bytes:
    """With a byte order mark: without it, Excel takes UTF-8 for something else."""
    out = io.StringIO(newline="")
    writer = csv.writer(out)
    for row in rows:
        writer.writerow([safe_cell(cell) for cell in row])
    return out.getvalue().encode("utf-8-sig")
