"""The command `similar`: which submissions of a class have more in common than others, as a page and a short table."""

import argparse
import math
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

from markupsafe import escape as escaped
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.documents import checked, plain
from raysteps.common.errors import UsageError
from raysteps.common.files import encoded, refuse_to_write, write_out
from raysteps.common.text import clean, count, print_plain, printable
from raysteps.course.manifest import STEPS_HELP, Step, chosen_steps, read_steps
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub
from raysteps.exports.similar_pairs import (
    MAX_SUBMISSIONS,
    MAX_TOKENS,
    REVIEW_THRESHOLD,
    ComparedSubmission,
    Comparison,
    Likeness,
    Origin,
    Passage,
    Similarity,
    SimilarPair,
    TokenSequence,
    all_hashes,
    compare,
    groups,
    is_read_whole,
    passages,
)
from raysteps.exports.similarity import base_code, known_solutions, started_of_class
from raysteps.release.secrets import public_names
from raysteps.report.class_page import aliases
from raysteps.report.page import render_page

_MAX_PAIRS, _MAX_KNOWN = 100, 10_000  # in the table; that groups are made of
_MAX_CODE, _MAX_BYTES = 40, 15_000_000  # pairs of which the page shows the code; of all their code
_FIRST = 10  # pairs in the terminal


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """A class, what it is compared with, and where the page goes."""
    parser.add_argument("folder", type=Path, metavar="CLASS", help="one folder, zip or tar per submission")
    parser.add_argument("--out", type=Path, default=Path("similar.html"), metavar="FILE", help="the page")
    parser.add_argument("--steps", nargs="+", default=[], metavar="STEP", help=STEPS_HELP)
    parser.add_argument(
        "--before",
        type=Path,
        nargs="+",
        default=[],
        metavar="CLASS",
        help="classes of earlier terms; they are compared with this one, not among themselves",
    )
    parser.add_argument(
        "--solutions", action="store_true", help="the kit's own solutions, too, as if somebody had handed them in"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the pairs there, too")


# What is compared.


def _handed(project: Project, stubs: dict[Step, str], arguments: argparse.Namespace) -> list[ComparedSubmission]:
    """Of the class under their own names, of earlier terms with the folder before them."""
    every = read_steps(project)
    written = [path for path in (arguments.out, arguments.json) if path is not None]
    often = Counter(folder.resolve().name for folder in arguments.before)
    places: list[tuple[Path, str, Origin]] = [(arguments.folder, "", "class")]
    for folder in arguments.before:
        name = folder.resolve().name
        places.append((folder, f"{name if often[name] == 1 else folder}/", "before"))
    return [
        ComparedSubmission(
            prefix + name, {step.id: data.decode("utf-8", "replace") for step, data in started.items()}, origin
        )
        for folder, prefix, origin in places
        for name, started in started_of_class(folder, every, stubs, written).items()
    ]


# What the page shows of two sources.

_WHOLE = 24_000  # characters: a longer file is shown around its passages only
_EDGE = 1_500  # characters of what is left out are shown at either end
_MAX_FILE = 60_000  # characters of a file in all
_COLOURS = 6


@dataclass(frozen=True)
class Piece:
    """Some of a source; a passage has a number."""

    text: str
    number: int = 0
    colour: int = 0


@dataclass(frozen=True)
class ShownFile:
    """One file of a pair."""

    step: str
    pieces: Sequence[Piece]


def _shortened(text: str, *, whole: bool) -> str:
    if whole or len(text) <= 2 * _EDGE:
        return text
    return f"{text[:_EDGE]}\n… {len(text) - 2 * _EDGE} characters left out …\n{text[-_EDGE:]}"


def _pieces(source: str, marks: Sequence[tuple[int, int, int]]) -> list[Piece]:
    whole, at, shown = len(source) <= _WHOLE, 0, 0
    found = []
    for start, end, number in (*marks, (len(source), len(source), 0)):
        for text, of in ((source[at:start], 0), (source[start:end], number)):
            if text and shown < _MAX_FILE:
                piece = Piece(clean(_shortened(text, whole=whole), _MAX_FILE), of, (of - 1) % _COLOURS)
                found.append(piece)
                shown += len(piece.text)
        at = end
    return [*found, Piece("\n… the rest is left out …")] if shown >= _MAX_FILE else found


def _files(handed: ComparedSubmission, words: TokenSequence, places: Sequence[tuple[int, int]]) -> dict[str, ShownFile]:
    """The files in which a passage lies; `places`: where each begins, and how many words it has."""
    found, offset = {}, 0
    for step, code in words.files.items():
        inside = sorted(
            (code[at - offset].start, code[at - offset + length - 1].end, number)
            for number, (at, length) in enumerate(places, start=1)
            if offset <= at < offset + len(code)
        )
        if inside:
            found[step] = ShownFile(step, _pieces(handed.sources[step], inside))
        offset += len(code) + 1
    return found


@dataclass(frozen=True)
class ShownPair:
    """A row of the table, and for the first ones the sources."""

    number: int
    pair: Likeness
    words: int
    longest: int
    same: int  # files, letter by letter
    both: int  # files that both have
    steps: Sequence[tuple[ShownFile | None, ShownFile | None]]  # step by step, side by side


def _bytes(shown: ShownPair) -> int:
    """About what its code takes in the page, where it is escaped and each passage has a link."""
    files = [file for both in shown.steps for file in both if file is not None]
    return sum(len(escaped(piece.text)) + 200 for file in files for piece in file.pieces)


def _shown(
    number: int,
    pair: Likeness,
    handed: Sequence[ComparedSubmission],
    sides: Sequence[TokenSequence],
    found: list[Passage],
) -> ShownPair:
    steps: list[tuple[ShownFile | None, ShownFile | None]] = []
    if number <= _MAX_CODE:
        left = _files(handed[pair.first], sides[0], [(one.first, one.length) for one in found])
        right = _files(handed[pair.second], sides[1], [(one.second, one.length) for one in found])
        steps = [(left.get(step), right.get(step)) for step in sorted({*left, *right})]
    lengths = [one.length for one in found]
    ours, theirs = handed[pair.first].sources, handed[pair.second].sources
    both = ours.keys() & theirs.keys()
    same = sum(ours[step] == theirs[step] for step in both)
    return ShownPair(number, pair, sum(lengths), max(lengths, default=0), same, len(both), steps)


# The page, the table and the JSON.


_HARDLY_READ = (
    f"only the first {MAX_TOKENS:,} words are compared, and an honest file has fewer than 3000; look at it yourself."
)


def _hardly_read(handed: Sequence[ComparedSubmission], public: Collection[str]) -> list[tuple[int, str]]:
    """Submissions by their places, and the steps of them whose files are longer than what is compared."""
    files = [(at, step, text) for at, one in enumerate(handed) for step, text in one.sources.items()]
    return [(at, step) for at, step, text in files if not is_read_whole(text, public)]


def _page(
    project: Project,
    handed: Sequence[ComparedSubmission],
    shown: Sequence[ShownPair],
    compared: Comparison,
    hardly_read: Sequence[tuple[int, str]],
) -> str:
    known = {step.id: f"{step.number} {step.title}" for step in read_steps(project)}
    own = [one.name for one in handed if one.origin == "class"]
    by_name = dict(zip(own, aliases(own), strict=True))
    context = {
        "names": [printable(one.name) for one in handed],
        "aliases": [by_name.get(one.name, f"earlier {at}") for at, one in enumerate(handed, start=1)],
        "titles": known,
        "amount": len(own),
        "earlier": sum(one.origin == "before" for one in handed),
        "compared": compared,
        "shown": shown,
        "groups": groups(compared.pairs),
        "hardly_read": hardly_read,
        "why_hardly": _HARDLY_READ,
        "look_from": REVIEW_THRESHOLD,
        "whole_percent": _percent,
        "percent_at_most": _percent_at_most,
    }
    return render_page("similar", "Similar submissions", context, ("similar",), ("similar",))


def _document(
    handed: Sequence[ComparedSubmission], steps: Collection[Step], shown: Sequence[ShownPair], compared: Comparison
) -> Similarity:
    return checked(
        Similarity(
            "raysteps/similarity/v1",
            [one.name for one in handed if one.origin == "class"],
            [one.name for one in handed if one.origin == "before"],
            [step.id for step in steps],
            compared.amount,
            compared.median,
            compared.nine_in_ten,
            REVIEW_THRESHOLD,
            [
                SimilarPair(
                    handed[one.pair.first].name,
                    handed[one.pair.second].name,
                    one.pair.value,
                    one.pair.most,
                    one.pair.whole,
                    one.pair.steps,
                    one.words,
                    one.longest,
                )
                for one in shown
            ],
            [[handed[at].name for at in group] for group in groups(compared.pairs)],
        ),
        "the comparison",
    )


def _percent(share: float) -> int:
    """Rounded down, but for the error of binary fractions: 100 * 0.29 is less than 29."""
    return math.floor(round(100 * share, 9))


def _percent_at_most(share: float) -> int:
    return math.ceil(round(100 * share, 9))


def _rank(likeness: float) -> str:
    """Without the sign of per cent: it is made smaller where there is little code, and so a share of nothing."""
    return str(_percent(likeness))


def _print(
    console: Console, handed: Sequence[ComparedSubmission], shown: Sequence[ShownPair], compared: Comparison
) -> None:
    table = Table(title="The most alike", title_justify="left")
    for heading in ("likeness", "first", "second", "most alike in", "of first", "of second", "longest", "same files"):
        table.add_column(heading, justify="left" if heading in ("first", "second") else "right", overflow="fold")
    for one in shown[:_FIRST]:
        names = [escape(printable(handed[at].name)) for at in (one.pair.first, one.pair.second)]
        shares = [f"{_percent(share)} %" for share in (one.pair.whole.first, one.pair.whole.second)]
        table.add_row(
            *(_rank(one.pair.value), *names, one.pair.most[:2] or "all", *shares),
            *(f"{one.longest} words", f"{one.same} of {one.both}"),
        )
    console.print(table)
    console.print(
        f"{count(compared.to_review, 'pair')} of {compared.amount} from likeness {_rank(REVIEW_THRESHOLD)} on, which "
        f"is worth a look; half of all have {_percent_at_most(compared.median)} at most. Likeness is from 0 to 100, "
        "and less where there is little code; the shares are per cent of one's own code.",
        highlight=False,
    )
    console.print("A high number is a reason to look and to talk, never a verdict.", highlight=False)


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """0 when the page was made, whatever is in it."""
    for path in filter(None, (arguments.out, arguments.json)):
        refuse_to_write(path)
    stubs = {step: pristine_stub(project, step) for step in chosen_steps(project, arguments.steps)}
    handed = _handed(project, stubs, arguments)
    kit = known_solutions(project, stubs, "before" if arguments.solutions else "background")
    amount = len([*handed, *(kit if arguments.solutions else [])])
    if amount < 2 or not any(one.origin == "class" for one in handed):
        raise UsageError(f"{arguments.folder}: holds {count(len(handed), 'submission')} with work; expected two")
    if amount > MAX_SUBMISSIONS:
        raise UsageError(
            f"{arguments.folder}: {amount} submissions; expected at most {MAX_SUBMISSIONS}: "
            "compare with one earlier term after the other, and a larger class group by group"
        )
    handed += kit
    public = public_names(project)
    given = all_hashes(base_code(project, stubs), public)
    compared = compare(handed, public, given, _MAX_KNOWN)
    nobodys = frozenset(given.tolist())

    @lru_cache(maxsize=64)
    def words(at: int) -> TokenSequence:
        return TokenSequence(handed[at], public)

    shown, room = [], _MAX_BYTES
    for number, pair in enumerate(compared.pairs[:_MAX_PAIRS], start=1):
        sides = (words(pair.first), words(pair.second))
        one = _shown(number, pair, handed, sides, passages(*sides, nobodys))
        size = _bytes(one)
        shown.append(one if size <= room else replace(one, steps=()))
        room -= size if size <= room else 0
    hardly_read = _hardly_read(handed, public)
    write_out(arguments.out, _page(project, handed, shown, compared, hardly_read).encode("utf-8", "replace"))
    if arguments.json is not None:
        write_out(arguments.json, encoded(plain(_document(handed, stubs, shown, compared))))
    _print(console, handed, shown, compared)
    for at, step in hardly_read:
        console.print(f"{printable(handed[at].name)}, {step}: {_HARDLY_READ}", markup=False, highlight=False)
    print_plain(console, f"Page: {arguments.out}")
    if arguments.json is not None:
        print_plain(console, f"Pairs: {arguments.json}")
    return 0
