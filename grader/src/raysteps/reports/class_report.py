"""The page of a class: class.html beside class.json."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any
from urllib.parse import quote

from raysteps.common.files import write_bytes
from raysteps.pages.page import render_page
from raysteps.reports.class_attention import groups, marks
from raysteps.reports.class_mistakes import CommonMistake, common_mistakes
from raysteps.reports.class_rows import STATUSES, Row, table_rows
from raysteps.reports.class_statistics import StepFigures, graded, span, step_figures, times, total_bars
from raysteps.reports.drawing import divided, histogram

FILE = "class.html"
Document = Mapping[str, Any]
_PARTS = 240  # width of a step's bar
_FILES = ("report.html", "results.json", "fault.txt")


def _links(folder: Path) -> Callable[[str], str | None]:
    """The best there is of a submission: its page, else its facts."""

    def link(name: str) -> str | None:
        place = f"submissions/{name}"
        found = next((file for file in _FILES if (folder / place / file).is_file()), None)
        return f"submissions/{quote(name, safe='')}/{found}" if found else None

    return link


def _step(figures: StepFigures, mistakes: list[CommonMistake]) -> dict[str, object]:
    counts = [(status, figures.statuses.get(status, 0)) for status in STATUSES]
    return {
        "figures": figures,
        "number": figures.id[:2],
        "parts": divided(counts, _PARTS),
        "counts": [(status, STATUSES[status], amount) for status, amount in counts if amount],
        "drawing": histogram(figures.bars, _PARTS, 92),
        "mistakes": [mistake for mistake in mistakes if mistake.step == figures.id],
    }


def _facts(document: Document) -> dict[str, object]:
    """What stands over everything."""
    figures = step_figures(document)
    mistakes = common_mistakes(document)
    regular = sum(step["points"] for step in document["steps"] if not step["bonus"])
    bonus = sum(step["points"] for step in document["steps"] if step["bonus"])
    finals = [one["final"] for one in graded(document)]
    return {
        "steps": [_step(one, mistakes) for one in figures],
        "regular": regular,
        "bonus": bonus,
        "finals": finals,
        "totals": histogram(total_bars(finals, regular + bonus), 640, 200),
        "times": times(document),
        "span": span,
        "isolations": sorted({one["isolation"] for one in document["submissions"] if one["isolation"]}),
    }


def _data(document: Document, rows: list[Row]) -> dict[str, object]:
    """What the scripts sort and filter by; rows are in the order of the table."""
    by_row: dict[int, list[int]] = {}
    for mistake in common_mistakes(document):
        for row in mistake.rows:
            by_row.setdefault(row, []).append(mistake.number)
    return {
        "rows": [
            {
                "who": row.who,
                "alias": row.alias,
                "words": row.words,
                "keys": row.keys,
                "statuses": [cell.status if cell is not None else "" for cell in row.cells],
                "mistakes": by_row.get(index, []),
                "look": bool(row.marks),
                "late": row.days > 0,
            }
            for index, row in enumerate(rows)
        ],
        "mistakes": [{"step": mistake.step[:2], "title": mistake.title} for mistake in common_mistakes(document)],
    }


def class_page(document: Document, link: Callable[[str], str | None]) -> str:
    """The page. `link` gives the address of what is known of a submission."""
    apart = groups(document)
    rows = table_rows(document, marks(apart), link)
    late = any(row.days for row in rows)
    context = {
        "run": document["run"],
        "policy": document["late_policy"],
        "statistics": document["statistics"],
        "apart": apart,
        "rows": rows,
        "late": late,
        "statuses": STATUSES,
        "look": sum(1 for row in rows if row.marks),
        **_facts(document),
    }
    scripts = ("class-rows", "class-filter", "class-names", "class-page")
    return render_page("class", "Class report", context, scripts, ("class", "class-table"), _data(document, rows))


def write_class_report(document: Document, folder: Path) -> Path:
    """FOLDER/class.html, of a class document and the files that lie beside it."""
    path = folder / FILE
    write_bytes(path, class_page(document, _links(folder)).encode("utf-8", "replace"))
    return path


def try_class_report(document: Document, folder: Path, say: Callable[[str], None]) -> None:
    """As `write_class_report`; no page is worth the grades of a class."""
    try:
        write_class_report(document, folder)
    except Exception as error:  # whatever it is, the tables are written
        say(f"no {FILE}: {error!r}")
