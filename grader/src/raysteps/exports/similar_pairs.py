"""Pairs of submissions that have more in common than others: what is rare in a class weighs more than what is usual."""

import hashlib
import math
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import accumulate
from typing import Annotated, Literal, NamedTuple

import numpy as np
import numpy.typing as npt
from msgspec import Meta

from raysteps.common.documents import Count, Share, Text
from raysteps.course.stubs import placed_tokens

# What is left of a source when names, layout and spelling count for nothing, and its fingerprints by winnowing.
# S. Schleimer, D. Wilkerson, A. Aiken: Winnowing: local algorithms for document fingerprinting, SIGMOD 2003.

MAX_TOKENS = 20_000  # of a file, from its beginning; the longest honest ones have 3000
GRAM = 9  # words: what is alike in fewer is never found
WINDOW = 4
GUARANTEED_MATCH = GRAM + WINDOW - 1  # what is alike in so many words is always found

_LOOPS = {"for", "while", "do"}
_TYPES = {
    *("auto", "bool", "char", "double", "float", "int", "long", "short", "signed", "unsigned", "void", "size_t"),
    *("int8_t", "int16_t", "int32_t", "int64_t", "uint8_t", "uint16_t", "uint32_t", "uint64_t", "ptrdiff_t"),
    *(f"{kind}{shape}{size}" for kind in ("", "d", "i", "u") for shape in ("vec", "mat") for size in (2, 3, 4)),
}
_CASTS = {"static_cast", "const_cast", "reinterpret_cast", "dynamic_cast"}
_SAYS_NOTHING = {
    *("const", "constexpr", "consteval", "constinit", "static", "inline", "noexcept", "override", "final", "explicit"),
    *("virtual", "mutable", "typename", "volatile", "extern", "this", "std", "glm", "raysteps", "namespace", "using"),
    *("(", ")", "{", "}", ";", ":", "::"),
}
_KEYWORDS = {
    *("if", "else", "return", "break", "continue", "switch", "case", "default", "struct", "class", "enum", "new"),
    *("delete", "throw", "try", "catch", "template", "operator", "sizeof", "true", "false", "nullptr", "public"),
    *("private", "goto", "friend", "union"),
}
_WORDS_OF_SIGNS = {"and": "&&", "or": "||", "not": "!"}
_DOUBLE = {"&&", "||", "==", "!=", "<=", ">=", "+=", "-=", "*=", "/=", "++", "--", "->", "::", "<<", ">>"}
_NO_CODE = {"include", "pragma", "line", "error", "warning"}


class Token(NamedTuple):
    """A token without what can be changed at no cost, and where it stands."""

    text: str
    start: int
    end: int


def _paired(source: str) -> list[Token]:
    """The tokens, without comments and what is included; signs of two characters in one piece."""
    found: list[Token] = []
    directive: list[str] | None = None
    for text, start in placed_tokens(source):
        if text == "\n":
            directive = None
        elif text == "#" or (directive is not None and not directive):
            directive = [] if text == "#" else [text]
        elif directive is None or directive[0] not in _NO_CODE:
            last = found[-1] if found else None
            if last is not None and last.end == start and last.text + text in _DOUBLE:
                found[-1] = Token(last.text + text, last.start, start + 1)
            else:
                found.append(Token(text, start, start + len(text)))
        if len(found) > 2 * MAX_TOKENS:
            break
    return found


def _plain(code: Sequence[Token], at: int, public: Collection[str]) -> str:
    """What a token counts as; nothing for one that does not count."""
    text = code[at].text
    before = code[at - 1].text if at else ""
    after = code[at + 1].text if at + 1 < len(code) else ""
    if text in _SAYS_NOTHING or (text == "->" and before == "this"):
        return ""
    if text in _LOOPS:
        return "loop"
    if text in _TYPES or text in _CASTS:
        return "type"
    if text in ("&", "*") and (before in _TYPES or before == ">"):
        return ""  # of a type
    if text[0].isdigit() or (text[0] == "." and len(text) > 1):
        return "number"
    if text[-1] in "\"'":
        return "text"
    if text == "->":
        return "."
    if not (text[0].isalpha() or text[0] == "_"):
        return text
    if text in _KEYWORDS:
        return text
    if text in _WORDS_OF_SIGNS:
        return _WORDS_OF_SIGNS[text]
    fixed = text in public and (before in (".", "->") or after in ("(", "{", "::"))
    return text if fixed else "name"


def tokenize(source: str, public: Collection[str]) -> list[Token]:
    """`public`: the names of the contracts and the framework, which nobody can choose. They stay where a member or a
    function is meant."""
    code = _paired(source)
    found: list[Token] = []
    for at, one in enumerate(code):
        plain = _plain(code, at, public)
        if plain and not (plain == "type" and found and found[-1].text == "type"):
            found.append(Token(plain, one.start, one.end))
    return found[:MAX_TOKENS]


def is_read_whole(source: str, public: Collection[str]) -> bool:
    """Whether no word of it is left out: somebody may have written many to hide those that follow."""
    if len(source) < MAX_TOKENS:
        return True
    return len(_paired(source)) <= 2 * MAX_TOKENS and len(tokenize(source, public)) < MAX_TOKENS


@cache
def _number(word: str) -> int:
    return int.from_bytes(hashlib.blake2b(word.encode("utf-8", "replace"), digest_size=8).digest(), "little")


Hashes = npt.NDArray[np.uint64]


def kgram_hashes(words: Sequence[Token]) -> Hashes:
    """One for each GRAM words in a row."""
    if len(words) < GRAM:
        return np.zeros(0, np.uint64)
    numbers = np.array([_number(word.text) for word in words], np.uint64)
    amount = len(words) - GRAM + 1
    hashes = np.zeros(amount, np.uint64)
    for at in range(GRAM):
        hashes = hashes * np.uint64(0x9E3779B97F4A7C15) + numbers[at : at + amount]
    hashes ^= hashes >> np.uint64(31)
    return hashes * np.uint64(0xBF58476D1CE4E5B9)


def winnowed(hashes: Hashes) -> list[int]:
    """The places of the hashes that are fingerprints: of every WINDOW in a row the least, of equal ones the one that
    was taken already, else the last."""
    if not len(hashes):
        return []
    size = min(WINDOW, len(hashes))
    windows = np.lib.stride_tricks.sliding_window_view(hashes, size)
    last_least = np.arange(len(windows)) + size - 1 - windows[:, ::-1].argmin(axis=1)
    chosen: list[int] = []
    for start, at in enumerate(last_least.tolist()):
        if not chosen or chosen[-1] < start or hashes[chosen[-1]] != hashes[at]:
            chosen.append(at)
    return chosen


# Pairs that have more of these in common than others.

USUAL = 0.75  # what more than this share of all have says nothing about two of them
LONG = 600.0  # fingerprints: the longest honest files weigh as much; what is more of a file counts for nothing
SHORT = 60.0  # fingerprints: code of this weight that is all alike is half as alike as long code
REVIEW_THRESHOLD = 0.3  # from this likeness on a pair is worth a look
MAX_SUBMISSIONS = 2000
_BLOCK = 2048  # fingerprints at a time
_DIGITS = 4  # of a likeness: what comes after them depends on the machine

Matrix = npt.NDArray[np.float32]


Origin = Literal["class", "before", "background"]


@dataclass(frozen=True)
class ComparedSubmission:
    """What somebody has handed in, as text by step. `before`, in an earlier term or by the kit, is compared with the
    class only; `background` only tells what is usual."""

    name: str
    sources: Mapping[str, str]
    origin: Origin = "class"


@dataclass(frozen=True)
class Shares:
    """How much of what is the first one's own is in the second, and the other way round."""

    first: Share
    second: Share


@dataclass(frozen=True)
class Likeness:
    """Two submissions by their places, and what they share: in all, and of each step that both have."""

    first: int
    second: int
    value: float  # from 0 to 1; less than the larger share where there is little code
    most: str  # the step that is most alike, or nothing where all together is
    whole: Shares
    steps: Mapping[str, Shares]


def fingerprints(source: str, public: Collection[str]) -> Hashes:
    """Each once."""
    hashes = kgram_hashes(tokenize(source, public))
    return np.unique(hashes[winnowed(hashes)])


def all_hashes(texts: Sequence[str], public: Collection[str]) -> Hashes:
    """Of all that stands in these texts: nobody's own."""
    found = [kgram_hashes(tokenize(text, public)) for text in texts]
    return np.unique(np.concatenate([*found, np.zeros(0, np.uint64)]))


# Who shares what with whom: a matrix with a row for each file and a column for each submission.


def _weights(often: npt.NDArray[np.int64], amount: int) -> Matrix:
    """Of fingerprints that so many of `amount` have: 1 for what no third one has, and 0 for what is usual."""
    rare = np.log(amount / np.maximum(1, often - 1)) / math.log(amount)
    weights: Matrix = np.where(often > max(2, USUAL * amount), 0.0, rare).astype(np.float32)
    return weights


@dataclass(frozen=True)
class _Files:
    """The weight of all that is one's own in each file, LONG at most, and of what of it is in each submission, in
    whatever step."""

    rows: Sequence[tuple[int, str]]  # submission and step
    own: Matrix
    shared: Matrix


def _compared(prints: Sequence[Mapping[str, Hashes]], given: Hashes) -> _Files:
    rows = [(at, step) for at, by_step in enumerate(prints) for step in by_step]
    files = [prints[at][step] for at, step in rows]
    every, which = np.unique(np.concatenate([*files, np.zeros(0, np.uint64)]), return_inverse=True)
    row = np.repeat(np.arange(len(rows)), [len(one) for one in files])
    owner = np.array([at for at, _ in rows], np.int64)[row]
    had, having = np.unique(np.stack([which, owner]), axis=1)
    often = np.bincount(had, minlength=len(every))
    weights = _weights(often, max(2, len(prints)))
    weights[np.isin(every, given)] = 0
    own = np.minimum(np.bincount(row, weights[which], len(rows)), LONG).astype(np.float32)
    wanted = np.flatnonzero((often > 1) & (weights > 0))
    column = np.full(len(every), -1)
    column[wanted] = np.arange(len(wanted))
    shared = np.zeros((len(rows), len(prints)), np.float32)
    for start in range(0, len(wanted), _BLOCK):
        size = min(_BLOCK, len(wanted) - start)
        mine, theirs = np.zeros((len(rows), size), np.float32), np.zeros((len(prints), size), np.float32)
        here = (column[which] >= start) & (column[which] < start + size)
        mine[row[here], column[which[here]] - start] = weights[which[here]]
        there = (column[had] >= start) & (column[had] < start + size)
        theirs[having[there], column[had[there]] - start] = 1
        shared += mine @ theirs.T
    return _Files(rows, own, shared)


@dataclass(frozen=True)
class Comparison:
    """All pairs that may be asked for, the most alike first, and how alike two of this class usually are."""

    pairs: Sequence[Likeness]
    median: float
    nine_in_ten: float  # are below
    amount: int  # of pairs in all
    to_review: int  # of pairs that are worth a look


class _Table:
    """Of one step or of all: the weight of each one's own, and of what each shares with each."""

    def __init__(self, amount: int) -> None:
        self.own = np.zeros(amount, np.float32)
        self.shared = np.zeros((amount, amount), np.float32)

    def likeness(self) -> Matrix:
        found: Matrix = self.shared / (self.own + np.float32(SHORT))[:, None]
        return np.minimum(np.maximum(found, found.T), np.float32(1))

    def shares(self, first: int, second: int) -> Shares:
        one, other = (
            float(self.shared[a, b] / self.own[a]) if self.own[a] > 0 else 0.0
            for a, b in ((first, second), (second, first))
        )
        return Shares(round(min(1.0, one), _DIGITS), round(min(1.0, other), _DIGITS))


def compare(handed: Sequence[ComparedSubmission], public: Collection[str], given: Hashes, most: int) -> Comparison:
    """`public`: names that nobody chose; `given`: what everybody got; `most`: so many pairs are told."""
    prints = [{step: fingerprints(text, public) for step, text in one.sources.items()} for one in handed]
    files = _compared(prints, given)
    amount = len(handed)
    tables: dict[str, _Table] = defaultdict(lambda: _Table(amount))
    for (owner, step), own, shared in zip(files.rows, files.own, files.shared, strict=True):
        for table in (tables[""], tables[step]):
            table.own[owner] += own
            table.shared[owner] += shared
    names = sorted(tables)
    best, place = np.zeros((amount, amount), np.float32), np.zeros((amount, amount), np.int8)
    for at, name in enumerate(names):
        found = tables[name].likeness()
        place[found > best] = at
        best = np.maximum(best, found)
    ours, others = (np.array([one.origin == origin for one in handed]) for origin in ("class", "before"))
    asked = (ours[:, None] & (ours | others)) | (others[:, None] & ours)
    firsts, seconds = np.nonzero(np.triu(asked, 1))
    values = best[firsts, seconds].round(_DIGITS)
    chosen = np.lexsort((seconds, firsts, -values))[:most]
    pairs = []
    for first, second, value in zip(firsts[chosen].tolist(), seconds[chosen].tolist(), values[chosen], strict=True):
        steps = {
            name: tables[name].shares(first, second)
            for name in names
            if name in handed[first].sources or name in handed[second].sources
        }
        whole = tables[""].shares(first, second)
        pairs.append(Likeness(first, second, float(value), names[place[first, second]], whole, steps))
    median, most_are = (round(float(np.quantile(values, part)), _DIGITS) if len(values) else 0.0 for part in (0.5, 0.9))
    return Comparison(pairs, median, most_are, len(values), int((values >= REVIEW_THRESHOLD).sum()))


def groups(pairs: Sequence[Likeness]) -> list[list[int]]:
    """Three or more that hang together by pairs worth a look, the largest group first."""
    group: dict[int, set[int]] = {}
    for pair in pairs:
        if pair.value >= REVIEW_THRESHOLD:
            joined = group.get(pair.first, {pair.first}) | group.get(pair.second, {pair.second})
            group.update(dict.fromkeys(joined, joined))
    found = {min(one): sorted(one) for one in group.values() if len(one) > 2}
    return sorted(found.values(), key=lambda one: (-len(one), one))


# Which passages two submissions have in common, word by word.

_MAX_PLACES = 16  # of one fingerprint that are looked at
_MAX_WORK = 400_000  # words compared for one pair


@dataclass(frozen=True)
class Passage:
    """Words in a row that are alike: where they begin in each, counted over all steps, and how many."""

    first: int
    second: int
    length: int


class TokenSequence:
    """A submission as one row of words; no passage goes on from one file into the next, whatever both are called."""

    def __init__(self, handed: ComparedSubmission, public: Collection[str]) -> None:
        self.files: dict[str, list[Token]] = {step: tokenize(text, public) for step, text in handed.sources.items()}
        self.words: list[str] = []
        self.hashes: dict[int, list[int]] = {}
        self.seeds: list[tuple[int, int]] = []  # places and hashes of the fingerprints
        for step, words in self.files.items():
            start = len(self.words)
            hashes = kgram_hashes(words)
            for at, value in enumerate(hashes.tolist(), start=start):
                self.hashes.setdefault(value, []).append(at)
            self.seeds += [(start + at, int(hashes[at])) for at in winnowed(hashes)]
            self.words += [*(word.text for word in words), f"\0{id(self)}/{step}"]


def _candidates(one: TokenSequence, other: TokenSequence, given: Collection[int]) -> Iterator[Passage]:
    """As long as they can be; none begins again inside itself."""
    work = 0
    ends: dict[int, int] = {}  # of the last passage with the same distance between both places
    for at, value in one.seeds:
        for place in other.hashes.get(value, [])[:_MAX_PLACES] if value not in given else ():
            if at < ends.get(at - place, 0):
                continue
            first, second, length = at, place, GRAM
            while first and second and one.words[first - 1] == other.words[second - 1]:
                first, second, length = first - 1, second - 1, length + 1
            while one.words[first + length] == other.words[second + length]:
                length += 1
            ends[at - place] = first + length
            work += length
            yield Passage(first, second, length)
        if work > _MAX_WORK:
            return


def passages(one: TokenSequence, other: TokenSequence, given: Collection[int]) -> list[Passage]:
    """What both have in common, the longest first, each word in one passage only: greedy string tiling."""
    taken = (bytearray(len(one.words)), bytearray(len(other.words)))
    found = []
    for long in sorted(set(_candidates(one, other, given)), key=lambda each: (-each.length, each.first, each.second)):
        free = [not (taken[0][long.first + at] or taken[1][long.second + at]) for at in range(long.length)]
        runs = list(accumulate(free, lambda run, is_free: run + 1 if is_free else 0))
        length = max(runs)
        if length >= GUARANTEED_MATCH:
            start = runs.index(length) - length + 1
            piece = Passage(long.first + start, long.second + start, length)
            taken[0][piece.first : piece.first + length] = b"\1" * length
            taken[1][piece.second : piece.second + length] = b"\1" * length
            found.append(piece)
    return sorted(found, key=lambda each: (-each.length, each.first))


# The form raysteps/similarity/v1.


@dataclass(frozen=True)
class SimilarPair:
    """Two submissions: what the numbers of a `Likeness` say, and the words of the passages that both have."""

    first: Text
    second: Text
    likeness: Share
    most_alike: str  # a step, or "" where that is all together
    whole: Shares
    steps: Mapping[str, Shares]
    words: Count
    longest_passage: Count


@dataclass(frozen=True)
class Similarity:
    """A class, the most alike pairs first; not all of them."""

    schema: Literal["raysteps/similarity/v1"]
    submissions: Sequence[Text]
    before: Sequence[Text]
    steps: Annotated[Sequence[str], Meta(min_length=1)]
    pairs_compared: Count
    median: Share
    nine_in_ten: Share
    look_from: Share
    pairs: Sequence[SimilarPair]
    groups: Sequence[Sequence[Text]]
