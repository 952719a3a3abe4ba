"""Takes text apart into words and signs, whatever it is written in, and finds sequences of them again."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from raysteps.kit.cpp_tokens import tokens

SHORTEST = 5  # words of a sequence that can be looked for
_WORD = re.compile(r"[^\W\d]\w*|\d[\w.]*|::|->|&&|\|\||[-+*/<>=!]=|\+\+|--|\n|\S")
_COMMENT_MARK = re.compile(r"//+!?|/\*+|\*/|^[ \t]*(?:\*|#|>)(?=[ \t])", re.M)
_ESCAPED = re.compile(r"\\+[nrt]|\\+(?=[\"'])")

Words = tuple[str, ...]


@dataclass(frozen=True)
class Word:
    """And the line that it stands in."""

    text: str
    line: int


def words_in(text: str) -> list[Word]:
    """All words: code in a comment, in a JSON string or quoted in a page is code, too."""
    plain = _COMMENT_MARK.sub(" ", _ESCAPED.sub(" ", text))
    found, line = [], 1
    for match in _WORD.finditer(plain):
        if match[0] == "\n":
            line += 1
        else:
            found.append(Word(match[0], line))
    return found


def code_words(source: str) -> Words:
    """Of C++, without its comments and what it includes."""
    plain = re.sub(r"^\s*#.*", "", source, flags=re.M)
    return tuple(word.text for word in words_in(" ".join(tokens(plain))))


def plain_words(text: str) -> Words:
    return tuple(word.text for word in words_in(text))


@dataclass
class Sequences:
    """Sequences of words, each with where it comes from."""

    by_start: dict[Words, dict[Words, str]] = field(default_factory=dict)

    def add(self, words: Words, origin: str, length: int, shortest: int) -> None:
        """All parts of that length; of something shorter the whole, unless it is too short to say anything."""
        if len(words) < max(shortest, SHORTEST):
            return
        for at in range(max(1, len(words) - length + 1)):
            part = words[at : at + length]
            self.by_start.setdefault(part[:SHORTEST], {}).setdefault(part, origin)

    def matches(self, words: Sequence[Word]) -> Iterator[tuple[Word, Words, str]]:
        """Where sequences begin, which ones, and where they come from."""
        texts = tuple(word.text for word in words)
        for at in range(len(texts) - SHORTEST + 1):
            candidates = self.by_start.get(texts[at : at + SHORTEST])
            if candidates is None:
                continue
            for sequence, origin in candidates.items():
                if texts[at : at + len(sequence)] == sequence:
                    yield words[at], sequence, origin

    def join(self, other: "Sequences") -> None:
        """Those of both."""
        for start, sequences in other.by_start.items():
            self.by_start.setdefault(start, {}).update(sequences)

    def allow(self, text: str) -> None:
        """What stands in a text that everybody may read is no secret."""
        for _, sequence, _ in list(self.matches(words_in(text))):
            self.by_start[sequence[:SHORTEST]].pop(sequence, None)
