"""What can be read in a file: its text, what a picture says beside its pixels, and what lies in an archive."""

import gzip
import io
import re
import tarfile
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

from raysteps.release.leaks.shape import PNG, png_chunks

_RUN = re.compile(rb"[\t\n\r\x20-\x7e]{4,}")
_WIDE_RUN = re.compile(rb"(?:[\t\n\r\x20-\x7e]\x00){4,}")
_MOST = 64 << 20  # bytes of something unpacked
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
        return zlib.decompressobj().decompress(data, _MOST)
    except zlib.error:
        return data


def _png(place: str, data: bytes) -> Iterator[Piece]:
    """All chunks but the pixels; compressed ones as they are meant, and what follows the end."""
    at = len(PNG)
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
                        yield entry.filename, member.read(_MOST)
        elif data.startswith(b"\x1f\x8b"):
            with gzip.open(stream) as packed:
                yield "unpacked", packed.read(_MOST)
        elif data[257:262] == b"ustar":
            with tarfile.open(fileobj=stream) as tar:
                for item in tar:
                    file = tar.extractfile(item)
                    if file is not None:
                        yield item.name, file.read(_MOST)
    except (OSError, EOFError, RuntimeError, zlib.error, zipfile.BadZipFile, tarfile.TarError):
        return


def pieces(place: str, data: bytes, depth: int = 0) -> Iterator[Piece]:
    """Everything that can be read."""
    if data.startswith(PNG):
        yield from _png(place, data)
    elif data.startswith((b"\xff\xfe", b"\xfe\xff")):
        yield Piece(place, data.decode("utf-16", "replace"))
    elif b"\0" not in data and not data.startswith(b"\x1f\x8b"):
        yield Piece(place, data.decode("utf-8", "replace"))
    else:
        yield Piece(place, _strings(data), has_lines=False)
        if depth < _DEEPEST:
            for name, member in _members(data):
                yield from pieces(f"{place}, {name}", member, depth + 1)
