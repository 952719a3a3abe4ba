"""Who did it with the least work: reads a graded class or results.json files, ranks them and tells the order."""

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal

from msgspec import Meta
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.classroom.class_document import OTHER_FORM, read_class_document
from raysteps.classroom.database import CLASS_JSON, FILE, LATEST, explained_sqlite_errors, open_readonly
from raysteps.common.documents import Amount, Count, Text, checked
from raysteps.common.errors import UsageError
from raysteps.common.text import count, name_order, print_plain, printable, size
from raysteps.course.manifest import Step
from raysteps.results.model import Results
from raysteps.results.store import RESULTS, read_results, stored_results
from raysteps.results.work_ratio import NoWorkRatio, WorkRatio, work_ratio_of

_WANTED = "expected the folder of a graded class, its class.json or class.sqlite, or a results.json"
_WHY_NOT = {
    "fault": "not graded, because of a fault of the grader",
    "unreadable": "it could not be read",
    "graded": OTHER_FORM,
}
_QUERY = (
    "SELECT submissions.name, results.status, results.document FROM submissions LEFT JOIN results "  # noqa: S608
    f"ON results.submission = submissions.id AND run = ({LATEST}) WHERE scope = 'here'"
)


@dataclass(frozen=True)
class LeaderboardEntry:
    """One submission; without results, why there is none."""

    name: str
    results: Results | None
    why: str = ""
    source: str = ""


def _without(name: str, status: str | None) -> LeaderboardEntry:
    return LeaderboardEntry(name, None, _WHY_NOT.get(status or "", "not graded yet"))


def _of_database(path: Path) -> list[LeaderboardEntry]:
    """Results of the kit that graded then: what this one cannot read is nobody's fault."""
    entered = []
    with open_readonly(path) as connection, explained_sqlite_errors(path, "read"):
        for row in connection.execute(_QUERY):
            results = stored_results(row["document"]) if row["status"] == "graded" else None
            entered.append(
                _without(row["name"], row["status"]) if results is None else LeaderboardEntry(row["name"], results)
            )
    return entered


def _of_class(path: Path) -> list[LeaderboardEntry]:
    """class.json, and the results.json files that it names."""
    home = path.parent.resolve()
    entered = []
    for one in read_class_document(path).submissions:
        if one.status != "graded" or one.results is None:
            entered.append(_without(one.name, one.status))
            continue
        place = (home / one.results).resolve()
        if not place.is_relative_to(home):
            raise UsageError(f"{path}: names {one.results}, which lies outside of its folder")
        entered.append(LeaderboardEntry(one.name, read_results(place)))
    return entered


def _is_class(path: Path) -> bool:
    """Whether a file holds a class.json."""
    try:
        facts = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return False  # read_results says what is wrong
    return isinstance(facts, dict) and facts.get("schema") == "raysteps/class/v1"


def _of_place(place: Path) -> list[LeaderboardEntry]:
    path = place
    if place.is_dir():
        names = (FILE, CLASS_JSON, RESULTS)
        path = next((place / name for name in names if (place / name).is_file()), place)
        if path == place:
            raise UsageError(f"{place}: holds none of {', '.join(names)}; {_WANTED}")
    if not path.exists():
        raise UsageError(f"{place}: is not there; {_WANTED}")
    if path.suffix == Path(FILE).suffix:
        return _of_database(path)
    if _is_class(path):
        return _of_class(path)
    results = read_results(path)
    return [LeaderboardEntry(results.submission, results, source=str(place))]


def read_entries(places: Sequence[Path]) -> list[LeaderboardEntry]:
    """All of all places. Where two are called alike, the place tells them apart."""
    entered = [replace(one, source=one.source or str(place)) for place in places for one in _of_place(place)]
    seen = Counter(one.name for one in entered)
    return [replace(one, name=f"{one.name} ({one.source})") if seen[one.name] > 1 else one for one in entered]


# Ranks submissions by the work of one step.


@dataclass(frozen=True)
class RankedSubmission:
    """A submission in its place; who is alike in work and memory shares it."""

    rank: int
    name: str
    work_ratio: WorkRatio


@dataclass(frozen=True)
class UnrankedSubmission:
    """A submission without a place."""

    name: str
    reason: str


@dataclass(frozen=True)
class Board:
    """One step."""

    step: Step
    ranked: Sequence[RankedSubmission]
    not_ranked: Sequence[UnrankedSubmission]
    kits: Sequence[str]  # that graded those in a place

    @property
    def reference_bytes(self) -> int | None:
        """None where results of several kits do not agree, or nobody is ranked."""
        known = {one.work_ratio.reference_bytes for one in self.ranked}
        return known.pop() if len(known) == 1 else None


def _work_ratio(entered: LeaderboardEntry, step: Step) -> WorkRatio | NoWorkRatio:
    if entered.results is None:
        return NoWorkRatio(entered.why)
    result = next((result for result in entered.results.steps if result.id == step.id), None)
    return NoWorkRatio("the step was not graded") if result is None else work_ratio_of(result, step.limited_pictures)


def _standing(work_ratio: WorkRatio) -> tuple[float, int]:
    return work_ratio.relative, work_ratio.bytes


def _in_place(work_ratios: Sequence[tuple[str, WorkRatio]]) -> list[RankedSubmission]:
    """Names come last: among equals their order must tell nothing, should they be hidden."""
    ordered = sorted(work_ratios, key=lambda one: (*_standing(one[1]), *one[1].pictures.values(), name_order(one[0])))
    places = [_standing(work_ratio) for _, work_ratio in ordered]
    return [RankedSubmission(places.index(_standing(work_ratio)) + 1, name, work_ratio) for name, work_ratio in ordered]


def rank(entered: Sequence[LeaderboardEntry], step: Step) -> Board:
    """Least work first, then least memory. The same results give the same board, in whatever order they come."""
    work_ratios: list[tuple[str, WorkRatio]] = []
    others: list[UnrankedSubmission] = []
    kits: set[str] = set()
    for one in entered:
        work_ratio = _work_ratio(one, step)
        if isinstance(work_ratio, NoWorkRatio):
            others.append(UnrankedSubmission(one.name, work_ratio.reason))
            continue
        work_ratios.append((one.name, work_ratio))
        kits |= {one.results.kit} if one.results is not None else set()
    others.sort(key=lambda other: (other.reason, name_order(other.name)))
    return Board(step, _in_place(work_ratios), others, sorted(kits))


# A board as a table, and all boards as JSON.

_HIDDEN = "-"
_ROOM = 110  # columns of a terminal in which the pictures have room, too
_CAPTION = (
    "work: tests per ray, as a multiple of the reference's. A surface test and a box test weigh alike; over the "
    "pictures it is the geometric mean. Equal work: less memory comes first."
)
_COUNTED = "What is tested is counted outside of the student's code where steps have boxes. No points hang on a rank."


def _table(board: Board, width: int, *, anonymous: bool) -> Table:
    pictures = board.step.limited_pictures if width >= _ROOM else ()
    table = Table(title=escape(f"{board.step.number} {board.step.title}"), title_justify="left")
    table.add_column("rank", justify="right")
    table.add_column("submission", overflow="fold")
    for heading in ("work", *pictures, "memory"):
        table.add_column(escape(heading), justify="right", no_wrap=True)
    for one in board.ranked:
        works = (
            f"{value:.3f}" for value in (one.work_ratio.relative, *(one.work_ratio.pictures[name] for name in pictures))
        )
        name = _HIDDEN if anonymous else escape(printable(one.name))
        table.add_row(str(one.rank), name, *works, size(one.work_ratio.bytes))
    if board.reference_bytes is not None:
        ones = ["1.000"] * (1 + len(pictures))
        table.add_row("", "the reference", *ones, size(board.reference_bytes), style="dim")
    return table


def _others(board: Board, *, anonymous: bool) -> list[str]:
    if anonymous:
        reasons = Counter(other.reason for other in board.not_ranked)
        return [f"{count(amount, 'submission')}: {reason}" for reason, amount in sorted(reasons.items())]
    return [f"{other.name}: {other.reason}" for other in board.not_ranked]


def nowhere_ranked(boards: Sequence[Board]) -> Board | None:
    """Who has no place on any of several boards, for the same reason: to be told once. None where nobody is."""
    every = boards[0].not_ranked if len(boards) > 1 else []
    found = [one for one in every if all(one in board.not_ranked for board in boards)]
    return replace(boards[0], not_ranked=found) if found else None


def print_nowhere_ranked(console: Console, found: Board, *, anonymous: bool) -> None:
    """What `nowhere_ranked` found."""
    console.print("Ranked in none of these steps", style="bold")
    for line in _others(found, anonymous=anonymous):
        print_plain(console, f"  {printable(line)}")


def print_board(console: Console, board: Board, *, anonymous: bool, told: Board | None = None) -> None:
    """The table, and below it who has no place, without those that are `told` for all boards."""
    if told is not None:
        board = replace(board, not_ranked=[one for one in board.not_ranked if one not in told.not_ranked])
    if board.ranked:
        console.print(_table(board, console.width, anonymous=anonymous))
    else:
        console.print(f"{board.step.number} {board.step.title}: nobody is ranked", markup=False, highlight=False)
    if not board.ranked and not board.not_ranked and told is None:
        console.print("  there is no submission", highlight=False)
    if board.not_ranked:
        console.print("Not ranked", style="bold")
        for line in _others(board, anonymous=anonymous):
            print_plain(console, f"  {printable(line)}")
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


# The form raysteps/leaderboard/v1; a name is None where they are hidden.


@dataclass(frozen=True)
class RankedEntry:
    """A submission in its place; `work` is a multiple of the reference's."""

    rank: Annotated[int, Meta(ge=1)]
    name: Text | None
    work: Amount
    bytes: Count
    pictures: dict[str, Amount]


@dataclass(frozen=True)
class UnrankedEntry:
    """A submission without a place."""

    name: Text | None
    reason: Text


@dataclass(frozen=True)
class RankedStep:
    """One step; the bytes are None where nobody is ranked, or references differ."""

    id: Annotated[str, Meta(pattern="^[0-9]{2}-[a-z0-9-]+$")]
    title: str
    pictures: Annotated[Sequence[str], Meta(min_length=1)]
    kits: Sequence[str]
    reference_bytes: Count | None
    ranked: Sequence[RankedEntry]
    not_ranked: Sequence[UnrankedEntry]


@dataclass(frozen=True)
class Leaderboard:
    """All steps."""

    schema: Literal["raysteps/leaderboard/v1"]
    anonymous: bool
    steps: Sequence[RankedStep]

    def __post_init__(self) -> None:
        names = [one.name for step in self.steps for one in step.ranked]
        names += [one.name for step in self.steps for one in step.not_ranked]
        if self.anonymous and any(name is not None for name in names):
            raise ValueError("names where they are hidden")


def _ranked_step(board: Board, *, anonymous: bool) -> RankedStep:
    return RankedStep(
        board.step.id,
        board.step.title,
        board.step.limited_pictures,
        board.kits,
        board.reference_bytes,
        [
            RankedEntry(
                one.rank,
                None if anonymous else one.name,
                one.work_ratio.relative,
                one.work_ratio.bytes,
                dict(one.work_ratio.pictures),
            )
            for one in board.ranked
        ],
        [UnrankedEntry(None if anonymous else other.name, other.reason) for other in board.not_ranked],
    )


def leaderboard(boards: Sequence[Board], *, anonymous: bool) -> Leaderboard:
    """Checked: what is not of its form is the kit's fault."""
    made = Leaderboard(
        "raysteps/leaderboard/v1", anonymous, [_ranked_step(board, anonymous=anonymous) for board in boards]
    )
    return checked(made, "the leaderboard")
