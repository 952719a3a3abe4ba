"""Looks through every file of a folder."""

import re
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.release.leaks.pieces import Piece, is_compiled, pieces
from raysteps.release.leaks.secrets import Secrets
from raysteps.release.leaks.words import words_in

_LENGTH = re.compile(r"(?<![0-9])[0-9]{1,3}(?=[A-Za-z_])")


@dataclass(frozen=True)
class Leak:
    """Where something stands that may not, and what it is."""

    place: str
    line: int | None
    origin: str
    text: str

    def __str__(self) -> str:
        where = self.place if self.line is None else f"{self.place}:{self.line}"
        return f"{where}: {self.text} (from {self.origin})"


def _in_words(secrets: Secrets, piece: Piece) -> Iterator[Leak]:
    """The first place for each origin: a file that was copied in whole is one leak."""
    told = set()
    for word, sequence, origin in secrets.sequences.matches(words_in(piece.text)):
        if origin not in told:
            told.add(origin)
            yield Leak(piece.place, word.line if piece.has_lines else None, origin, f'"{" ".join(sequence)}"')


def _in_symbols(secrets: Secrets, piece: Piece) -> Iterator[Leak]:
    """A linker writes names one after the other, each with its length before it: _ZN8raysteps9wall_hit."""
    told = set()
    for length in _LENGTH.finditer(piece.text):
        name = piece.text[length.end() : length.end() + int(length[0])]
        origin = secrets.names.get(name)
        if origin is not None and name not in told:
            told.add(name)
            yield Leak(piece.place, None, origin, f"the symbol {name}")


def _leaks_in(secrets: Secrets, place: str, data: bytes) -> Iterator[Leak]:
    if is_compiled(data):
        yield Leak(place, None, "whatever it was made of", "something compiled, which a release has none of")
    for piece in pieces(place, data):
        yield from _in_words(secrets, piece)
        if not piece.has_lines:
            yield from _in_symbols(secrets, piece)


def _git_objects(folder: Path) -> Iterator[tuple[str, bytes]]:
    """All that a history holds, whether something leads to it or not."""
    command = ["git", "-C", str(folder), "cat-file", "--batch-all-objects", "--batch"]
    try:
        done = subprocess.run(command, capture_output=True, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise UsageError(f"{folder}/.git: git cannot read its objects, so they cannot be looked through") from error
    at = 0
    while at < len(done.stdout):
        end = done.stdout.index(b"\n", at)
        name, kind, size = done.stdout[at:end].decode().split()
        at = end + 1 + int(size) + 1
        yield f".git, {kind} {name[:12]}", done.stdout[end + 1 : at - 1]


def _contents(folder: Path) -> Iterator[tuple[str, bytes]]:
    for path in sorted(folder.rglob("*")):
        place = path.relative_to(folder)
        if path.is_symlink():
            yield place.as_posix(), str(path.readlink()).encode()
        elif path.is_file() and not (place.parts[0] == ".git" and place.parts[1:2] == ("objects",)):
            yield place.as_posix(), path.read_bytes()
    if (folder / ".git").exists():
        yield from _git_objects(folder)


def find_leaks(secrets: Secrets, folder: Path) -> list[Leak]:
    """In every file, in git's objects, and in what files hold."""
    return [leak for place, data in _contents(folder) for leak in _leaks_in(secrets, place, data)]
