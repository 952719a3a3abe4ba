"""A board as a table, and all boards as JSON."""

from collections import Counter
from collections.abc import Sequence
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.commands.leaderboard.ranking import Board
from raysteps.common.errors import GraderFault
from raysteps.common.schemas import complaint, read_schema
from raysteps.common.text import count, printable, size

_HIDDEN = "-"
_ROOM = 110  # columns of a terminal in which the pictures have room, too
_CAPTION = (
    "work: tests per ray, as a multiple of the reference's. A surface test and a box test weigh alike; over the "
    "pictures it is the geometric mean. Equal work: less memory comes first."
)
_COUNTED = "The counters come from the kit's framework inside the student's program. No points hang on a rank."


def _table(board: Board, width: int, *, anonymous: bool) -> Table:
    pictures = board.step.limited_pictures if width >= _ROOM else ()
    table = Table(title=escape(f"{board.step.number} {board.step.title}"), title_justify="left")
    table.add_column("rank", justify="right")
    table.add_column("submission", overflow="fold")
    for heading in ("work", *pictures, "memory"):
        table.add_column(escape(heading), justify="right", no_wrap=True)
    for one in board.ranked:
        works = (f"{value:.3f}" for value in (one.effort.relative, *(one.effort.pictures[name] for name in pictures)))
        name = _HIDDEN if anonymous else escape(printable(one.name))
        table.add_row(str(one.rank), name, *works, size(one.effort.bytes))
    if board.reference_bytes is not None:
        ones = ["1.000"] * (1 + len(pictures))
        table.add_row("", "the reference", *ones, size(board.reference_bytes), style="dim")
    return table


def _others(board: Board, *, anonymous: bool) -> list[str]:
    if anonymous:
        reasons = Counter(other.reason for other in board.not_ranked)
        return [f"{count(amount, 'submission')}: {reason}" for reason, amount in sorted(reasons.items())]
    return [f"{other.name}: {other.reason}" for other in board.not_ranked]


def print_board(console: Console, board: Board, *, anonymous: bool) -> None:
    """The table, and below it who has no place."""
    if board.ranked:
        console.print(_table(board, console.width, anonymous=anonymous))
    else:
        console.print(f"{board.step.number} {board.step.title}: nobody is ranked", markup=False, highlight=False)
    if not board.ranked and not board.not_ranked:
        console.print("  there is no submission", highlight=False)
    if board.not_ranked:
        console.print("Not ranked", style="bold")
        for line in _others(board, anonymous=anonymous):
            console.print(f"  {printable(line)}", markup=False, highlight=False, soft_wrap=True)
    if len(board.kits) > 1:
        console.print(
            f"Graded by {count(len(board.kits), 'kit')} ({', '.join(board.kits)}), each with a reference of its own: "
            "grade all with one to compare them",
            markup=False,
            highlight=False,
        )


def print_caption(console: Console) -> None:
    """How to read the tables."""
    console.print(_CAPTION, style="dim", highlight=False)
    console.print(_COUNTED, style="dim", highlight=False)


def _board(board: Board, *, anonymous: bool) -> dict[str, Any]:
    return {
        "id": board.step.id,
        "title": board.step.title,
        "pictures": list(board.step.limited_pictures),
        "kits": list(board.kits),
        "reference_bytes": board.reference_bytes,
        "ranked": [
            {
                "rank": one.rank,
                "name": None if anonymous else one.name,
                "work": one.effort.relative,
                "bytes": one.effort.bytes,
                "pictures": dict(one.effort.pictures),
            }
            for one in board.ranked
        ],
        "not_ranked": [
            {"name": None if anonymous else other.name, "reason": other.reason} for other in board.not_ranked
        ],
    }


def to_json(boards: Sequence[Board], *, anonymous: bool) -> dict[str, Any]:
    """Checked against its schema."""
    document = {
        "schema": "raysteps/leaderboard/v1",
        "anonymous": anonymous,
        "steps": [_board(board, anonymous=anonymous) for board in boards],
    }
    problem = complaint(document, read_schema("raysteps.commands.leaderboard", "leaderboard.schema.json"))
    if problem:
        raise GraderFault(f"the leaderboard would break its schema: {problem}")
    return document
