"""What the page to work in is made of, beside text and pictures: packed files, and what is compiled in them."""

import io
import json
import re
import tarfile
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.text import join_and
from raysteps.play.packages import CLANG_SYSTEM, CLANG_WASM, content_mark
from raysteps.play.play_page import tar_of

_PAGE, _COMPILER, _SYSTEM, _KIT = "index.html", "clang.wasm.gz", "system.tar.gz", "kit.tar.gz"
_HEADERS = re.compile(r"steps/\d+\.pch\.gz")
_DATA = re.compile(rb'<script type="application/json" id="data">(.*?)</script>', re.S)
_HOW = "only a page that was made in a students' kit may go out"


@dataclass(frozen=True)
class Problem:
    """Why a file, or what lies in it, may not go out."""

    place: str
    text: str


@dataclass(frozen=True)
class Inside:
    """What lies in a file, still to be searched like any other."""

    place: str
    data: bytes
    compiled: bool = False


def is_page(folder: Path) -> bool:
    """By the files that no page does without."""
    return all((folder / name).is_file() for name in (_PAGE, _COMPILER, _SYSTEM, _KIT))


def folder_of_page(folder: Path, path: Path) -> Path | None:
    """The page, within the folder, that the file is a part of."""
    above = [one for one in path.parents if one == folder or folder in one.parents]
    return next((one for one in above if is_page(one)), None)


def is_part(name: str) -> bool:
    """Whether a page has a file of that name which is no text and no picture; or the page itself, which tells more."""
    return name in (_PAGE, _COMPILER, _SYSTEM, _KIT) or _HEADERS.fullmatch(name) is not None


def look_into(name: str, place: str, data: bytes, functions: Mapping[str, str]) -> Iterator[Problem | Inside]:
    """`name` is that within the page; `functions` are those of the steps, as `mangled` writes them."""
    if name == _PAGE:
        yield Inside(place, data)
        if _model(data) != "stub":
            yield Problem(place, f"the page of a whole kit, with the reference's steps; {_HOW}")
        return
    unpacked = _gunzip(data)
    if unpacked is None:
        yield Problem(place, "is not packed as the page packs it, or holds more")
    elif name == _COMPILER:
        if content_mark({"": unpacked}) != CLANG_WASM:
            yield Problem(place, "is not the compiler that the kit knows")
    elif _HEADERS.fullmatch(name):
        if not unpacked.startswith(b"CPCH"):
            yield Problem(place, "expected compiled headers")
        yield Inside(place, unpacked, compiled=True)
    else:
        yield from _in_tar(name, place, unpacked, functions)


def _model(page: bytes) -> object:
    found = _DATA.search(page)
    try:
        content = json.loads(found[1]) if found else None
    except ValueError:
        return None
    return content.get("model") if isinstance(content, dict) else None


def _gunzip(data: bytes) -> bytes | None:
    """All of it, where nothing else stands behind it."""
    unpacking = zlib.decompressobj(wbits=16 + zlib.MAX_WBITS)
    try:
        unpacked = unpacking.decompress(data)
    except zlib.error:
        return None
    return unpacked if unpacking.eof and not unpacking.unused_data else None


def _in_tar(name: str, place: str, data: bytes, functions: Mapping[str, str]) -> Iterator[Problem | Inside]:
    try:
        with tarfile.open(fileobj=io.BytesIO(data)) as archive:
            found = {info.name: file.read() for info in archive if (file := archive.extractfile(info)) is not None}
    except tarfile.TarError:
        found = {}
    if tar_of(found) != data:
        yield Problem(place, "is not packed as the page packs it, or holds more")
    if name == _SYSTEM:
        of_compiler = {path: file for path, file in found.items() if path.startswith("usr/")}
        if content_mark(of_compiler) == CLANG_SYSTEM:
            found = {path: file for path, file in found.items() if path not in of_compiler}
    for path, content in found.items():
        if name == _KIT and content.startswith((_OBJECT, _ARCHIVE)):
            yield from _in_compiled(f"{place}, {path}", content, functions)
        else:
            yield Inside(f"{place}, {path}", content)


# Objects and archives of them, as clang writes them for WebAssembly. See
# https://github.com/WebAssembly/tool-conventions/blob/main/Linking.md

_OBJECT, _ARCHIVE = b"\0asm\1\0\0\0", b"!<arch>\n"
_FUNCTION, _DATA_SYMBOL, _OTHERS = 0, 1, (2, 4, 5)
_UNDEFINED, _NAMED = 0x10, 0x40


def mangled(function: str) -> str:
    """A function of a step, such as Box::clip, as the names of its symbols go on after _ZN or _ZNK."""
    return "".join(f"{len(part)}{part}" for part in ("raysteps", *function.split("::"))) + "E"


def _in_compiled(place: str, data: bytes, functions: Mapping[str, str]) -> Iterator[Problem | Inside]:
    try:
        if data.startswith(_ARCHIVE):
            for name, member in archive_members(data):
                yield from _in_compiled(f"{place}, {name}", member, functions)
            return
        yield Inside(place, data, compiled=True)
        if data.startswith(_OBJECT):
            written = _written(defined_symbols(data), functions)
            if written:
                yield Problem(place, f"holds more than the stub of {join_and(written)}; {_HOW}")
        else:
            yield Problem(place, "expected an object")
    except (IndexError, ValueError):
        yield Problem(place, "expected an object, or an archive of them, that can be read")


def _written(names: set[str], functions: Mapping[str, str]) -> list[str]:
    """Functions of steps that stand there and are no stubs: a stub remembers that it has said so."""
    found: set[str] = set()
    for name in names:
        start = re.match(r"_ZNK?(?=8raysteps)", name)
        if start and f"_ZGVZ{name[2:]}E9said_once" not in names:
            found.update(words for rest, words in functions.items() if name.startswith(rest, start.end()))
    return sorted(found)


def archive_members(data: bytes) -> Iterator[tuple[str, bytes]]:
    """Without the tables of symbols and of long names."""
    at, long_names = len(_ARCHIVE), b""
    while at < len(data):
        name, size = data[at : at + 16].rstrip(), int(data[at + 48 : at + 58])
        member = data[at + 60 : at + 60 + size]
        if data[at + 58 : at + 60] != b"`\n" or len(member) < size:
            raise ValueError("no archive")
        if name == b"//":
            long_names = member
        elif name != b"/":
            long = re.fullmatch(rb"/(\d+)", name)
            shown = long_names[int(long[1]) :].partition(b"\n")[0] if long else name
            yield shown.rstrip(b"/").decode("utf-8", "replace"), member
        at += 60 + size + size % 2


class _Reader:
    """Numbers and names of a section, one after the other."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.at = 0

    def number(self) -> int:
        value, shift = 0, 0
        while True:
            byte = self.data[self.at]
            self.at += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    def content(self) -> bytes:
        size = self.number()
        found = self.data[self.at : self.at + size]
        if len(found) < size:
            raise ValueError("cut off")
        self.at += size
        return found

    def sections(self) -> Iterator[tuple[int, bytes]]:
        """Kind and content of each, up to the end."""
        while self.at < len(self.data):
            kind = self.number()
            yield kind, self.content()


def defined_symbols(data: bytes) -> set[str]:
    """Of an object. A program that was linked has no list of them, and is refused."""
    for kind, content in _Reader(data[len(_OBJECT) :]).sections():
        section = _Reader(content)
        if kind == 0 and section.content() == b"linking":
            section.number()  # the version
            tables = [body for kind, body in section.sections() if kind == 8]
            return {name for table in tables for name in _symbols(_Reader(table))}
    raise ValueError("no list of symbols")


def _symbols(table: _Reader) -> Iterator[str]:
    for _ in range(table.number()):
        kind, flags = table.number(), table.number()
        is_defined = not flags & _UNDEFINED
        if kind == _DATA_SYMBOL:
            name = table.content()
            for _ in range(3 if is_defined else 0):  # segment, offset, size
                table.number()
        elif kind == _FUNCTION or kind in _OTHERS:
            table.number()  # its index
            name = table.content() if is_defined or flags & _NAMED else b""
        else:  # a section
            table.number()
            continue
        if is_defined:
            yield name.decode("utf-8", "replace")
