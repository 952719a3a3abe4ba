"""Two trees on the terminal, with the first difference marked."""

from collections.abc import Iterator

from rich import box
from rich.console import Console, RenderableType
from rich.markup import escape
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from raysteps.common.text import count
from raysteps.course.manifest import Step
from raysteps.inspector.model import Record
from raysteps.inspector.pixel_page import Key, Line, lines_of
from raysteps.inspector.records import Difference, agreement

_WIDE = 110  # columns; below, one tree stands under the other
_WIDEST = 180
_DEEPEST = 12
_MARK = ">"


def _aligned(mine: list[Line], reference: list[Line]) -> Iterator[tuple[Line | None, Line | None]]:
    """Lines with the same key beside each other; what one tree lacks leaves a gap."""
    at = 0
    keys = [line.key for line in reference]
    for line in mine:
        if line.key in keys[at:]:
            end = keys.index(line.key, at)
            yield from ((None, other) for other in reference[at:end])
            yield line, reference[end]
            at = end + 1
        else:
            yield line, None
    yield from ((None, other) for other in reference[at:])


def _marked(keys: list[Key], place: Key | None) -> Key | None:
    """The line of the difference, or the nearest one above it in the tree."""
    while place:
        if place in keys:
            return place
        if (*place[:-1], "ray") in keys:
            return (*place[:-1], "ray")
        place = place[:-1]
    return None


def _cell(line: Line | None, style: str) -> RenderableType:
    """Indented by its level, also where it takes more than one line."""
    if line is None:
        return ""
    return Padding(Text(line.text, style=style), (0, 0, 0, 2 * min(line.level, _DEEPEST)), expand=False)


def _style(mine: Line | None, reference: Line | None, *, first: bool) -> str:
    if first:
        return "bold red"
    if mine is None or reference is None:
        return "yellow"
    return "" if mine.text == reference.text else "dim" if mine.cost else "yellow"


def print_trees(console: Console, mine: Record, reference: Record, divergence: Difference | None) -> None:
    """Columns where there is room for them, else one tree under the other."""
    rows = list(_aligned(lines_of(mine), lines_of(reference)))
    keys = [line.key for row in rows for line in row if line is not None]
    place = _marked(keys, divergence.place if divergence else None)
    if console.width >= _WIDE:
        _print_columns(console, rows, place)
        return
    for at, title in enumerate(("yours", "reference")):
        console.print(Text(title, style="bold"))
        for row in rows:
            line = row[at]
            if line is not None:
                first = line.key == place
                mark = f"{_MARK if first else ' '} {'  ' * min(line.level, _DEEPEST)}"
                console.print(Text(mark + line.text, style=_style(*row, first=first)), soft_wrap=True)
        console.print()


def _print_columns(console: Console, rows: list[tuple[Line | None, Line | None]], place: Key | None) -> None:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1), width=min(console.width, _WIDEST))
    table.add_column("", width=1)
    table.add_column("yours", ratio=1, overflow="fold")
    table.add_column("reference", ratio=1, overflow="fold")
    for mine, reference in rows:
        line = mine or reference
        first = line is not None and line.key == place
        style = _style(mine, reference, first=first)
        table.add_row(Text(_MARK if first else "", style=style), _cell(mine, style), _cell(reference, style))
    console.print(table)


# What the comparison of two records comes to, in words.


def step_of(steps: list[Step], function: str) -> Step | None:
    """The step whose function it is."""
    return next((step for step in steps if function in step.functions), None)


def cost_words(mine: Record, reference: Record) -> str:
    """What the pixel cost both; nothing where it is the same."""
    if mine.counts == reference.counts:
        return ""
    told = [
        f"{count(record.counts.box_tests, 'box test')} and {count(record.counts.surface_tests, 'surface test')}"
        for record in (mine, reference)
    ]
    return f"Cost: yours {told[0]}, the reference {told[1]}."


def print_verdict(
    console: Console, steps: list[Step], mine: Record, reference: Record, divergence: Difference | None
) -> None:
    """The first difference and the function that it points to."""
    cost = cost_words(mine, reference)
    if divergence is None:
        console.print(f"[green]No difference[/green]: {agreement(mine, reference)}.")
    else:
        console.print(f"[bold red]First difference[/bold red]: {escape(divergence.words)}.", highlight=False)
        if divergence.why:
            console.print(f"  {escape(divergence.why[:1].upper() + divergence.why[1:])}.", highlight=False)
        step = step_of(steps, divergence.function)
        if step is not None:
            place = f"[bold]{escape(divergence.function)}[/bold] in steps/{escape(step.path.as_posix())}"
            console.print(f"  Look at {place} (step {step.number}).", highlight=False)
    if cost:
        console.print(cost, highlight=False, style="dim")
