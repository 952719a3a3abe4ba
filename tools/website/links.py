"""Dead links: to files that are not there, and to headings that nobody wrote."""

import re
import shlex
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

from raysteps.common.markdown import Block, anchors, blocks, code_spans, targets


def is_elsewhere(target: str) -> bool:
    """Whether a link leaves the repository."""
    return "://" in target or target.startswith("mailto:")


def split(document: Path, target: str) -> tuple[Path, str]:
    """The file that a link leads to, and the anchor in it."""
    path, _, anchor = target.partition("#")
    return (document.parent / unquote(path)).resolve() if path else document.resolve(), anchor


def dead_links(root: Path, documents: Iterable[Path]) -> list[str]:
    """One line for each, with its place."""
    found = []
    known: dict[Path, set[str]] = {}
    for name in documents:
        document = root / name
        for line, target in targets(document.read_text(encoding="utf-8")):
            if is_elsewhere(target):
                continue
            path, anchor = split(document, target)
            if not path.exists():
                found.append(f"{name}:{line}: {target}: expected a file of the repository, found nothing of that name")
            elif not path.is_relative_to(root.resolve()):
                found.append(f"{name}:{line}: {target}: leaves the repository")
            elif anchor and path.suffix == ".md":
                if path not in known:
                    known[path] = anchors(path.read_text(encoding="utf-8"))
                if anchor not in known[path]:
                    near = ", ".join(sorted(known[path]))
                    found.append(f"{name}:{line}: {target}: no heading makes that anchor; there are: {near}")
    return found


# The commands that documents tell people to type.

_TAGS = ("sh", "bash", "shell", "console", "powershell", "bat")
_PROGRAMS = re.compile(
    r"(?:\$ )?(?:[A-Z_]+=\S+ )*"
    r"(?:\./raysteps|python3?|raytrace|cd|cmake|ctest|git|tar|zip|docker|sbatch|sqlite3|xvfb-run|sudo|wsl|winget|brew"
    r"|xcode-select|exec|ssh|jplag|java|\.venv/bin/\w+)(?: |$)"
)
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


def is_shell(block: Block) -> bool:
    """Whether people are to type it."""
    return block.tag in _TAGS or (not block.tag and _PROGRAMS.match(block.body) is not None)


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
