"""Looks through every file of a folder."""

import re
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.release.leaks.pieces import Piece, pieces
from raysteps.release.leaks.secrets import Secrets
from raysteps.release.leaks.shape import strange
from raysteps.release.leaks.words import words_in
from raysteps.release.searching import to_search

_LENGTH = re.compile(r"(?<![0-9])[0-9]{1,3}(?=[A-Za-z_])")
# Where the kit keeps what it knows. A release has no folder or file of such a name.
_TELLING = {
    "alternatives", "cases.toml", "course.toml", "judge", "judge.py", "mutants.toml", "samples", "solutions",
    "worker.cpp",
}  # fmt: skip


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
    words = words_in(piece.text)
    seed = secrets.tells_seed(words)
    if seed is not None:
        yield Leak(
            piece.place,
            seed.line if piece.has_lines else None,
            "course.toml",
            "the seed of the hidden cases, or a number like it",
        )
    told = set()
    for word, sequence, origin in secrets.sequences.matches(words):
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


def leaks_in_history(secrets: Secrets, folder: Path) -> list[Leak]:
    """In git's objects and in what else git keeps, where there is a history."""
    if not (folder / ".git").exists():
        return []
    found = list[Leak]()
    for place, data in _git_objects(folder):
        problem = strange(data) if ", blob " in place else None
        found += [Leak(place, None, "whatever it was made of", problem)] if problem else []
        found += _leaks_in(secrets, place, data)
    for path in sorted((folder / ".git").rglob("*")):
        if path.is_file() and folder / ".git" / "objects" not in path.parents:
            found += _leaks_in(secrets, path.relative_to(folder).as_posix(), path.read_bytes())
    return found


def _in_file(secrets: Secrets, folder: Path, path: Path) -> Iterator[Leak]:
    place = path.relative_to(folder)
    named = _TELLING.intersection(place.parts)
    if named:
        yield Leak(place.as_posix(), None, "its name", f"a release has nothing called {min(named)}")
    if path.is_symlink():
        yield Leak(place.as_posix(), None, "whatever it was made of", "a link; a release has none")
        yield from _leaks_in(secrets, place.as_posix(), str(path.readlink()).encode())
    elif path.is_file():
        data = path.read_bytes()
        problem = strange(data)
        if problem:
            yield Leak(place.as_posix(), None, "whatever it was made of", problem)
        yield from _leaks_in(secrets, place.as_posix(), data)


def find_leaks(secrets: Secrets, folder: Path, *, tried: bool = False) -> list[Leak]:
    """In every file, in what files hold, and in git's objects. Where the kit was tried, not in what setting it up has
    made there."""
    found = [leak for path in to_search(folder, tried=tried) for leak in _in_file(secrets, folder, path)]
    return [*found, *leaks_in_history(secrets, folder)]
