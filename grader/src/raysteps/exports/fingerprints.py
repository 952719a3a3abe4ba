"""What is left of a source when names, layout and spelling count for nothing, and its fingerprints by winnowing.

S. Schleimer, D. Wilkerson, A. Aiken: Winnowing: local algorithms for document fingerprinting, SIGMOD 2003."""

import hashlib
from collections.abc import Collection, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from raysteps.course.stubs import placed_tokens

MAX_TOKENS = 20_000  # of a file, from its beginning; the longest honest ones have 3000
GRAM = 9  # words: what is alike in fewer is never found
WINDOW = 4
SURE = GRAM + WINDOW - 1  # what is alike in so many words is always found

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


class Word(NamedTuple):
    """A token without what can be changed at no cost, and where it stands."""

    text: str
    start: int
    end: int


def _paired(source: str) -> list[Word]:
    """The tokens, without comments and what is included; signs of two characters in one piece."""
    found: list[Word] = []
    directive: list[str] | None = None
    for text, start in placed_tokens(source):
        if text == "\n":
            directive = None
        elif text == "#" or (directive is not None and not directive):
            directive = [] if text == "#" else [text]
        elif directive is None or directive[0] not in _NO_CODE:
            last = found[-1] if found else None
            if last is not None and last.end == start and last.text + text in _DOUBLE:
                found[-1] = Word(last.text + text, last.start, start + 1)
            else:
                found.append(Word(text, start, start + len(text)))
        if len(found) > 2 * MAX_TOKENS:
            break
    return found


def _plain(code: Sequence[Word], at: int, public: Collection[str]) -> str:
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


def words_of(source: str, public: Collection[str]) -> list[Word]:
    """`public`: the names of the contracts and the framework, which nobody can choose. They stay where a member or a
    function is meant."""
    code = _paired(source)
    found: list[Word] = []
    for at, one in enumerate(code):
        plain = _plain(code, at, public)
        if plain and not (plain == "type" and found and found[-1].text == "type"):
            found.append(Word(plain, one.start, one.end))
    return found[:MAX_TOKENS]


@cache
def _number(word: str) -> int:
    return int.from_bytes(hashlib.blake2b(word.encode("utf-8", "replace"), digest_size=8).digest(), "little")


Hashes = npt.NDArray[np.uint64]


def gram_hashes(words: Sequence[Word]) -> Hashes:
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
