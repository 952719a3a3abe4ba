"""Tables of what was measured: columns and figures, as both the terminal and docs/benchmarks.md write them.

A page names a unit in the heading, the terminal behind each figure."""

from collections.abc import Iterable, Sequence

from rich.table import Table

from tools.bench.model import Spread

# These columns stand left; numbers stand right.
_LEFT = ("accel", "figure", "program", "scene", "step", "structure", "way")


def _stands_left(heading: str) -> bool:
    return heading.split(" ")[0] in _LEFT


def terminal_table(title: str, headings: Sequence[str]) -> Table:
    """One table, without rows yet."""
    table = Table(title=title, title_justify="left")
    for heading in headings:
        table.add_column(heading, justify="left" if _stands_left(heading) else "right")
    return table


def markdown(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """One table."""
    marks = ["|---" if _stands_left(heading) else "|---:" for heading in headings]
    lines = ["| " + " | ".join(headings) + " |", "".join(marks) + "|"]
    lines += ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
    return "\n".join(lines)


# Figures; nothing where something was not measured.


def median(spread: Spread | None, digits: int, unit: str = "") -> str:
    return f"{spread.median:.{digits}f}{unit}" if spread else ""


def quartiles(spread: Spread, digits: int) -> str:
    return f"{spread.q1:.{digits}f} to {spread.q3:.{digits}f}"


def spread(found: Spread | None, digits: int) -> str:
    """The median, and the quartiles in brackets."""
    return f"{median(found, digits)} ({quartiles(found, digits)})" if found else ""


def milliseconds(seconds: Spread, digits: int, unit: str = "") -> str:
    return f"{seconds.median * 1e3:.{digits}f}{unit}"


def megabytes(size: int | None, digits: int = 2, unit: str = "") -> str:
    return f"{size / 1e6:.{digits}f}{unit}" if size else ""


def counted(tests: float, digits: int) -> str:
    """Nobody can count what Embree tests by itself."""
    return f"{tests:.{digits}f}" if tests else ""


def ratio(value: float, other: float | None, unit: str = "") -> str:
    return f"{value / other:.2f}{unit}" if value and other else ""
