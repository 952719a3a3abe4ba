"""The table of `dev check`, and what is not as it should be."""

from collections.abc import Sequence
from dataclasses import dataclass

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.upkeep.truth.verdicts import Seen

LEAST_NAMED = 0.95  # of all mistakes
LEAST_BY_TESTS = 0.80  # of all mistakes, by the visible tests alone
LEAST_PAIRS = 0.90  # of the pairs of mistakes


@dataclass(frozen=True)
class Row:
    """What came of one step's files; one row more sums up."""

    name: str
    stub: float
    reference: float
    mutants: int
    caught: int
    by_tests: int
    by_pictures: int
    named: int
    alternatives: int
    full: int


def row_of(name: str, seen: Sequence[Seen]) -> Row:
    """Counts each file once, however often it was handed in."""
    wrong = {one.entrant.name: one for one in seen if one.entrant.kind == "mutant"}
    others = {one.entrant.name for one in seen if one.entrant.kind == "alternative"}
    less = {one.entrant.name for one in seen if one.entrant.kind == "alternative" and one.problem}
    return Row(
        name,
        sum(one.result.points for one in seen if one.entrant.kind == "stub"),
        min((one.result.points for one in seen if one.entrant.kind == "reference"), default=0.0),
        len(wrong),
        sum(not one.problem for one in wrong.values()),
        sum(one.tests_noticed for one in wrong.values()),
        sum(one.pictures_noticed for one in wrong.values()),
        sum(one.named for one in wrong.values()),
        len(others),
        len(others - less),
    )


def total(rows: Sequence[Row]) -> Row:
    """The sum of all steps."""
    sums = [sum(getattr(row, field) for row in rows) for field in list(Row.__dataclass_fields__)[1:]]
    return Row("all", *sums)


def table_of(rows: Sequence[Row]) -> Table:
    """One row for each step, and their sum."""
    table = Table(title="Is a grade true?", title_justify="left")
    headings = ("step", "stub", "reference", "mistakes", "caught", "by tests", "by pictures", "named", "other ways")
    for heading in (*headings, "full marks"):
        table.add_column(heading, justify="left" if heading == "step" else "right")
    for row in [*rows, total(rows)]:
        numbers = (row.mutants, row.caught, row.by_tests, row.by_pictures, row.named, row.alternatives, row.full)
        table.add_row(escape(row.name), f"{row.stub:g}", f"{row.reference:g}", *map(str, numbers))
    return table


def problems_of(rounds: Sequence[Sequence[Seen]]) -> list[str]:
    """What is not true, each with the files that were handed in with it."""
    found = []
    for seen in rounds:
        beside = ", ".join(f"{one.entrant.step[:2]} {one.entrant.name}" for one in seen if not one.entrant.is_right)
        for one in seen:
            if one.problem:
                place = f"{one.entrant.step}: {one.entrant.kind} {one.entrant.name}"
                found.append(f"{place}: {one.problem} (wrong in this round: {beside or 'none'})")
    return list(dict.fromkeys(found))


def shortfalls(summed: Row) -> list[str]:
    """Shares that are too small."""
    found = []
    if summed.mutants and summed.named < LEAST_NAMED * summed.mutants:
        found.append(f"{summed.named} of {summed.mutants} mistakes are named, fewer than {LEAST_NAMED:.0%}")
    if summed.mutants and summed.by_tests < LEAST_BY_TESTS * summed.mutants:
        found.append(f"the visible tests notice {summed.by_tests} of {summed.mutants}, fewer than {LEAST_BY_TESTS:.0%}")
    return found


def print_notes(console: Console, seen: Sequence[Seen]) -> None:
    """The mistakes that the visible tests do not notice, and those that are called something else."""
    wrong = {(one.entrant.step, one.entrant.name): one for one in seen if one.entrant.kind == "mutant"}
    for (step, name), one in wrong.items():
        if not one.named:
            console.print(f"not named: {step} {name}; said is {one.said}", markup=False, highlight=False)
    missed: dict[str, list[str]] = {}
    for (step, name), one in wrong.items():
        if not one.tests_noticed:
            missed.setdefault(step, []).append(name)
    for step, names in missed.items():
        console.print(f"not noticed by the visible tests: {step}: {', '.join(names)}", markup=False, highlight=False)
