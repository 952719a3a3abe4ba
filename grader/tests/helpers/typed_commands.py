"""The commands that documents tell people to type."""

import re
import shlex
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.markdown import Block, blocks, code_spans
from tools.website.documents import is_shell

_SETTING = re.compile(r"[A-Za-z_]\w*=.*")


@dataclass(frozen=True)
class Typed:
    """One command line."""

    document: Path
    line: int
    text: str
    words: tuple[str, ...]
    in_prose: bool = False

    def __str__(self) -> str:
        return f"{self.document}:{self.line}: {self.text}"

    @property
    def is_synopsis(self) -> bool:
        """It says what may be written, or only names a command, and is not for typing as it stands."""
        if self.in_prose and (len(self.words) == 2 or any(word.isupper() for word in self.words)):
            return True
        return any(sign in self.text for sign in ("...", "…", "[-"))


def _words(text: str) -> list[str]:
    words = shlex.split(text, comments=True)
    while words and (_SETTING.fullmatch(words[0]) or words[0] in ("$", "exec", "xvfb-run")):
        words = words[1:]
    return words


def _lines(block: Block) -> list[tuple[int, str]]:
    """With lines put together that a backslash, or the indentation of a synopsis, continues."""
    found: list[tuple[int, str]] = []
    for number, line in enumerate(block.body.splitlines(), block.line):
        if found and (found[-1][1].endswith("\\") or line.startswith(" ")):
            found[-1] = (found[-1][0], found[-1][1].removesuffix("\\").rstrip() + " " + line.strip())
        else:
            found.append((number, line))
    return found


def _commands(document: Path, line: int, text: str, *, in_prose: bool = False) -> list[Typed]:
    found = []
    for part in re.split(r" &&? | \|\| | ; ", text):
        words = _words(part)
        if words:
            found.append(Typed(document, line, part.strip(), tuple(words), in_prose))
    return found


def commands(document: Path, block: Block) -> list[Typed]:
    """What people are to type of this block."""
    return [one for line, shown in _lines(block) for one in _commands(document, line, shown)] if is_shell(block) else []


def typed(document: Path, text: str) -> list[list[Typed]]:
    """The commands of a document, block by block."""
    return [found for block in blocks(text) if (found := commands(document, block))]


def mentioned(document: Path, text: str) -> list[Typed]:
    """The commands of the kit that stand within a line of prose, or indented by four spaces."""
    found = []
    for line, span in code_spans(text):
        if re.match(r"(?:[A-Z_]+=\S+ )?\./raysteps \S", span):
            found += _commands(document, line, span, in_prose=True)
    for line, shown in enumerate(text.splitlines(), 1):
        if re.match(r"    (?:\./raysteps|python) \S", shown):
            found += _commands(document, line, shown.strip())
    return found
