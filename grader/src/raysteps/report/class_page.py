"""The page of a class: class.html beside class.json."""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from raysteps.common.errors import reason_or_fault
from raysteps.common.files import write_bytes
from raysteps.common.text import number, plain_letters, printable, searchable, signed, tenths
from raysteps.report.class_overview import (
    CommonMistake,
    StepFigures,
    common_mistakes,
    divided,
    graded,
    groups,
    histogram,
    marks,
    span,
    step_figures,
    times,
    total_bars,
)
from raysteps.report.page import render_page
from raysteps.results.class_model import ClassResults, GradedSubmission
from raysteps.results.statuses import NOT_TAKEN, NOT_TAKEN_STATUS, STATUS_WORDS
from raysteps.results.store import REPORT, RESULTS

# The table of a class: what each row shows, and what it is sorted and found by.

Link = Callable[[str], str | None]

STATUSES = {str(status): found.words for status, found in STATUS_WORDS.items()} | {NOT_TAKEN_STATUS: NOT_TAKEN.words}
_NO_POINTS = {"fault": "fault", "not-graded": "not graded"}


@dataclass(frozen=True)
class Cell:
    """One step of one submission."""

    status: str
    words: str
    points: str


@dataclass(frozen=True)
class Row:
    """One submission."""

    alias: str  # what it is called while names are hidden
    who: str
    more: str
    link: str | None
    cells: Sequence[Cell | None]
    total: str
    days: int
    final: str
    seconds: str
    change: str  # of the points since something else was handed in
    marks: Sequence[str]
    changed: bool  # a person changed its points
    words: str  # it is found by
    keys: Sequence[float | None]  # the numbers that its columns are sorted by, after the name


def aliases(names: Sequence[str]) -> list[str]:
    """A number for each name, the same at every look, in an order that tells nothing about the name."""
    order = sorted(names, key=lambda name: (hashlib.sha256(name.encode("utf-8", "replace")).digest(), name))
    numbers = {name: index for index, name in enumerate(order, start=1)}
    return [f"student {numbers[name]}" for name in names]


def who_and_more(one: GradedSubmission) -> tuple[str, str]:
    """The name to show, and what else tells who it is."""
    people = [student.name or student.id or student.email for student in one.students]
    ids = [student.id for student in one.students if student.id and student.name]
    if not people:
        return printable(one.name), ""
    return printable(", ".join(people)), printable(" · ".join([*ids, one.name]))


def found_by(one: GradedSubmission) -> str:
    words = [one.name, one.entry]
    words += [word for student in one.students for word in (student.id, student.name, student.email)]
    return searchable(" ".join(dict.fromkeys(word for word in words if word)))


def step_cell(one: GradedSubmission, step: str) -> Cell | None:
    """What became of this step, for the eye; none where it was not graded."""
    result = one.steps.get(step)
    if result is None:
        return None
    status = one.shown_status(step)
    return Cell(status, STATUSES.get(status, printable(status)), tenths(result.points))


def _points(value: float | None, status: str) -> str:
    return _NO_POINTS.get(status, "") if value is None else tenths(value)


def _change(one: GradedSubmission) -> float | None:
    """Of the grader's points since the student last handed in something else; None where that was never."""
    now = one.automatic_points
    return round(now - one.earlier[-1].points, 2) if one.earlier and now is not None else None


def table_rows(document: ClassResults, marks: Mapping[int, Sequence[str]], link: Link) -> list[Row]:
    """One for each submission, in the order of class.json."""
    submissions = document.submissions
    steps = [step.id for step in document.steps]
    rows = []
    for index, (one, alias) in enumerate(zip(submissions, aliases([one.name for one in submissions]), strict=True)):
        results = [one.steps.get(step) for step in steps]
        days = one.late.days if one.late is not None else 0
        seconds, change = one.seconds, _change(one)
        who, more = who_and_more(one)
        keys = [result.points if result is not None else None for result in results]
        rows.append(
            Row(
                alias=alias,
                who=who,
                more=more,
                link=link(one.name),
                cells=[step_cell(one, step) for step in steps],
                total=_points(one.points, one.status),
                days=days,
                final="" if one.final is None else number(one.final),
                seconds="" if seconds is None else f"{seconds:.1f}",
                change=signed(change) if change is not None else "",
                marks=marks.get(index, []),
                changed=bool(one.review.changes),
                words=found_by(one),
                keys=[*keys, one.points, days, one.final, seconds, change],
            )
        )
    return rows


FILE = "class.html"
_COLUMNS = (3, 4)  # of cards in a wide window: those that leave the fewest gaps in the last row
_PARTS = 240  # width of a step's bar
_FILES = (REPORT, RESULTS, "fault.txt")


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
        "drawing": histogram(figures.bars, _PARTS, 112, "how much of the points"),
        "mistakes": [mistake for mistake in mistakes if mistake.step == figures.id],
    }


def _facts(document: ClassResults) -> dict[str, object]:
    """What stands over everything."""
    figures = step_figures(document)
    mistakes = common_mistakes(document)
    regular = sum(step.points for step in document.steps if not step.bonus)
    bonus = sum(step.points for step in document.steps if step.bonus)
    finals = [one.final for one in graded(document) if one.final is not None]
    return {
        "steps": [_step(one, mistakes) for one in figures],
        "columns": min(_COLUMNS, key=lambda columns: (-len(figures) % columns, -columns)),
        "regular": regular,
        "bonus": bonus,
        "finals": finals,
        "totals": histogram(total_bars(finals, regular + bonus), 640, 220, "points in all"),
        "times": times(document),
        "span": span,
        "isolations": sorted({one.isolation for one in document.submissions if one.isolation}),
    }


def _data(document: ClassResults, rows: list[Row]) -> dict[str, object]:
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
                "changed": row.changed,
            }
            for index, row in enumerate(rows)
        ],
        "letters": plain_letters(),
        "mistakes": [{"step": mistake.step[:2], "title": mistake.title} for mistake in common_mistakes(document)],
    }


def class_page(document: ClassResults, link: Callable[[str], str | None]) -> str:
    """The page. `link` gives the address of what is known of a submission."""
    apart = groups(document)
    rows = table_rows(document, marks(apart), link)
    late = any(row.days for row in rows)
    context = {
        "course": document.course,
        "run": document.run,
        "policy": document.late_policy,
        "statistics": document.statistics,
        "apart": apart,
        "rows": rows,
        "late": late,
        "changed": any(row.changed for row in rows),
        "again": any(row.change for row in rows),
        "statuses": STATUSES,
        "look": sum(1 for row in rows if row.marks),
        "longest_mark": max((len(", ".join(row.marks)) for row in rows), default=0),
        **_facts(document),
    }
    scripts = ("class-rows", "class-filter", "class-names", "class-page")
    return render_page("class", "Class report", context, scripts, ("class", "class-table"), _data(document, rows))


def write_class_report(document: ClassResults, folder: Path) -> Path:
    """FOLDER/class.html, of a class document and the files that lie beside it."""
    path = folder / FILE
    write_bytes(path, class_page(document, _links(folder)).encode("utf-8", "replace"))
    return path


def try_class_report(document: ClassResults, folder: Path, say: Callable[[str], None]) -> None:
    """As `write_class_report`; no page is worth the grades of a class."""
    try:
        write_class_report(document, folder)
    except Exception as error:  # whatever it is, the tables are written
        say(f"no {FILE}: {reason_or_fault(error)}")
