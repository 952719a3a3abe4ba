"""Two trees on the terminal, with the first difference marked."""

from collections.abc import Iterator

from rich import box
from rich.console import Console, RenderableType
from rich.padding import Padding
from rich.table import Table
from rich.text import Text

from raysteps.commands.inspect.pair import Difference
from raysteps.commands.inspect.tree import Key, Line, lines_of
from raysteps.commands.inspect.values import Record

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


def print_trees(console: Console, mine: Record, reference: Record, parting: Difference | None) -> None:
    """Columns where there is room for them, else one tree under the other."""
    rows = list(_aligned(lines_of(mine), lines_of(reference)))
    keys = [line.key for row in rows for line in row if line is not None]
    place = _marked(keys, parting.place if parting else None)
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
