"""Looks through every file of a folder."""

import gzip
import io
import re
import subprocess
import tarfile
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UTF16_MARKS, UsageError, reason
from raysteps.common.files import PNG_SIGNATURE
from raysteps.common.text import count, join_and
from raysteps.release.page_parts import Problem, folder_of_page, is_part, look_into
from raysteps.release.secrets import Secrets, words_in
from raysteps.submission.archives import DAMAGED
from raysteps.updater.release_list import CACHE, HISTORY, all_places

# What a file of a release may be: text, or a PNG picture that is nothing else.

LIVE_PROGRAM = b"globalThis.raystepsProgram = "  # of the live figures of a site
# The first bytes of what somebody may leave behind, for better words. What is not known is refused just as well.
_COMPILED = (
    LIVE_PROGRAM,
    b"\x7fELF", b"!<arch>\n", b"!<thin>\n", b"\xcf\xfa\xed\xfe", b"\xce\xfa\xed\xfe", b"\xca\xfe\xba\xbe", b"\x64\x86",
    b"\x4c\x01", b"\x64\xaa", b"\0\0\xff\xff", b"BC\xc0\xde", b"\0asm", b"gpch", b"MZ",
)  # fmt: skip
_CHUNKS = {
    b"IHDR", b"PLTE", b"IDAT", b"IEND", b"tRNS", b"gAMA", b"cHRM", b"sRGB", b"sBIT", b"bKGD", b"pHYs", b"tIME", b"tEXt",
    b"zTXt", b"iTXt",
}  # fmt: skip
_NOT_OF_TEXT = bytes(set(range(32)) - set(b"\t\n\r\f"))


def png_chunks(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Kind and content of each, up to the end or to the first that is cut off."""
    at, kind = len(PNG_SIGNATURE), b""
    while at + 12 <= len(data) and kind != b"IEND":
        size, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        yield kind, data[at + 8 : at + 8 + size]
        at += 12 + size


def _is_whole_picture(data: bytes) -> bool:
    """Chunks of known kinds with right sums up to the last byte, and pixels that are pixels."""
    made, pixels, kinds = [PNG_SIGNATURE], b"", []
    for kind, body in png_chunks(data):
        made += [len(body).to_bytes(4, "big"), kind, body, zlib.crc32(kind + body).to_bytes(4, "big")]
        kinds.append(kind)
        pixels += body if kind == b"IDAT" else b""
    if b"".join(made) != data or kinds[:1] != [b"IHDR"] or kinds[-1] != b"IEND" or not _CHUNKS.issuperset(kinds):
        return False
    unpacking = zlib.decompressobj()
    try:
        unpacking.decompress(pixels)
    except zlib.error:
        return False
    return unpacking.eof and not unpacking.unused_data


def _is_text(data: bytes) -> bool:
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return False
    return not data.translate(None, delete=bytes(set(range(256)) - set(_NOT_OF_TEXT)))


def unexpected_content(data: bytes) -> str | None:
    """What is wrong with a file of another shape."""
    if data.startswith(PNG_SIGNATURE):
        return None if _is_whole_picture(data) else "a PNG that is damaged, or that holds more than a picture"
    if data.startswith(_COMPILED):
        return "something compiled, which a release has none of"
    return None if _is_text(data) else "neither UTF-8 text nor a PNG picture, and a release has nothing else"


# What can be read in a file: its text, what a picture says beside its pixels, and what lies in an archive.

_RUN = re.compile(rb"[\t\n\r\x20-\x7e]{4,}")
_WIDE_RUN = re.compile(rb"(?:[\t\n\r\x20-\x7e]\x00){4,}")
_MAX = 64 << 20  # bytes of something unpacked
_DEEPEST = 4


@dataclass(frozen=True)
class Piece:
    """Text, and where it stands. Lines count in text files only."""

    place: str
    text: str
    has_lines: bool = True


def _strings(data: bytes) -> str:
    wide = (found[0].decode("utf-16-le") for found in _WIDE_RUN.finditer(data))
    return "\n".join([*(found[0].decode("ascii") for found in _RUN.finditer(data)), *wide])


def _inflated(data: bytes) -> bytes:
    try:
        return zlib.decompressobj().decompress(data, _MAX)
    except zlib.error:
        return data


def _png(place: str, data: bytes) -> Iterator[Piece]:
    """All chunks but the pixels; compressed ones as they are meant, and what follows the end."""
    at = len(PNG_SIGNATURE)
    for kind, body in png_chunks(data):
        at += 12 + len(body)
        if kind == b"IDAT":
            continue
        texts = [body]
        if kind in (b"zTXt", b"iCCP"):
            texts.append(_inflated(body.partition(b"\0")[2][1:]))
        elif kind == b"iTXt":
            rest = body.partition(b"\0")[2]
            text = rest[2:].partition(b"\0")[2].partition(b"\0")[2]
            texts.append(_inflated(text) if rest[:1] == b"\1" else text)
        shown = "\n".join(text.decode("utf-8", "replace") for text in texts)
        yield Piece(f"{place} ({kind.decode('latin-1')})", shown, has_lines=False)
    if at < len(data):
        yield Piece(f"{place} (after its end)", _strings(data[at:]), has_lines=False)


def _members(data: bytes) -> Iterator[tuple[str, bytes]]:
    """Of a zip, a tar or a gzip."""
    stream = io.BytesIO(data)
    try:
        if data.startswith(b"PK\3\4"):
            with zipfile.ZipFile(stream) as archive:
                for entry in archive.infolist():
                    with archive.open(entry) as member:
                        yield entry.filename, member.read(_MAX)
        elif data.startswith(b"\x1f\x8b"):
            with gzip.open(stream) as packed:
                yield "unpacked", packed.read(_MAX)
        elif data[257:262] == b"ustar":
            with tarfile.open(fileobj=stream) as tar:
                for item in tar:
                    file = tar.extractfile(item)
                    if file is not None:
                        yield item.name, file.read(_MAX)
    except DAMAGED:
        return


def pieces(place: str, data: bytes, depth: int = 0) -> Iterator[Piece]:
    """Everything that can be read."""
    if data.startswith(PNG_SIGNATURE):
        yield from _png(place, data)
    elif data.startswith(UTF16_MARKS):
        yield Piece(place, data.decode("utf-16", "replace"))
    elif b"\0" not in data and not data.startswith(b"\x1f\x8b"):
        yield Piece(place, data.decode("utf-8", "replace"))
    else:
        yield Piece(place, _strings(data), has_lines=False)
        if depth < _DEEPEST:
            for name, member in _members(data):
                yield from pieces(f"{place}, {name}", member, depth + 1)


# Which files of a folder are searched for leaks, and what is left out.


def _refuse(error: OSError) -> None:
    raise UsageError(f"{error.filename}: cannot be looked through: {reason(error)}") from error


def to_search(folder: Path, *, tried: bool) -> list[Path]:
    """All files and folders but the history; where the kit was set up and tried, without what that makes."""
    if not tried:
        return sorted(path for path in folder.rglob("*") if path.relative_to(folder).parts[0] != HISTORY)
    return sorted(place.path for place in all_places(folder, _refuse) if not place.made)


def not_searched(folder: Path) -> str:
    """The folders that `to_search` leaves out, in words; nothing where there are none."""
    made = sorted(place.name for place in all_places(folder) if place.made)
    caches = [name for name in made if name.rpartition("/")[2] == CACHE]
    named = [name for name in made if name not in caches]
    if len(caches) > 1:
        caches = [f"{count(len(caches), 'folder')} {CACHE}"]
    return join_and([*named, *caches]) if made else ""


# The 1 of _GLOBAL__N_1, a namespace without a name, is no part of the length after it.
_LENGTH = re.compile(r"((?<![0-9])(?<!GLOBAL__N_)|(?<=GLOBAL__N_1))[0-9]{1,3}(?=[A-Za-z_])")
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
        problem = unexpected_content(data) if ", blob " in place else None
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
        page = folder_of_page(folder, path)
        name = path.relative_to(page).as_posix() if page else ""
        if is_part(name):
            yield from _in_page(secrets, name, place.as_posix(), path.read_bytes())
        else:
            yield from _in_data(secrets, place.as_posix(), path.read_bytes())


def _in_data(secrets: Secrets, place: str, data: bytes) -> Iterator[Leak]:
    problem = unexpected_content(data)
    if problem:
        yield Leak(place, None, "whatever it was made of", problem)
    yield from _leaks_in(secrets, place, data)


def _in_page(secrets: Secrets, name: str, place: str, data: bytes) -> Iterator[Leak]:
    """A part of the page to work in."""
    for found in look_into(name, place, data, secrets.functions):
        if isinstance(found, Problem):
            yield Leak(found.place, None, "whatever it was made of", found.text)
        elif found.compiled:
            yield from _leaks_in(secrets, found.place, found.data)
        else:
            yield from _in_data(secrets, found.place, found.data)


def find_leaks(secrets: Secrets, folder: Path, *, tried: bool = False) -> list[Leak]:
    """In every file, in what files hold, and in git's objects. Where the kit was tried, not in what setting it up has
    made there."""
    found = [leak for path in to_search(folder, tried=tried) for leak in _in_file(secrets, folder, path)]
    return [*found, *leaks_in_history(secrets, folder)]
