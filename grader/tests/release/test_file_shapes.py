"""A release has text and pictures; all else is a leak, whatever it is."""

import bz2
import io
import lzma
import marshal
import zipfile
import zlib
from pathlib import Path

import pytest
from PIL import Image

from raysteps.release.leaks import find_leaks, pieces, unexpected_content
from raysteps.release.secrets import NgramIndex, Secrets

pytestmark = pytest.mark.portable

_TEXT = b"int main() { return 0; }\n" * 20


def _picture() -> bytes:
    data = io.BytesIO()
    Image.new("RGB", (4, 4)).save(data, "PNG")
    return data.getvalue()


_PNG = _picture()


@pytest.mark.parametrize(
    "data",
    [
        b"\x7fELF\2\1\1\0", b"\x4c\x01\3\0", b"\x64\xaa\3\0", b"\x64\x86\3\0", b"\0\0\xff\xff\1\0", b"!<thin>\nx",
        b"BC\xc0\xde5", b"\0asm\1\0\0\0", b"gpch.013", b"MZ\x90\0",
    ],
)  # fmt: skip
def test_something_compiled(data: bytes) -> None:
    assert "compiled" in (unexpected_content(data) or "")


@pytest.mark.parametrize(
    "data",
    [
        bz2.compress(_TEXT), lzma.compress(_TEXT), zlib.compress(_TEXT), b"\x28\xb5\x2f\xfd" + _TEXT,
        b"7z\xbc\xaf\x27\x1c", marshal.dumps(compile("x = 1", "x.py", "exec")),
        b"Microsoft C/C++ MSF 7.00\r\n\x1aDS\0\0\0", "a".encode("utf-16"), b"GIF89a\1\0\1\0", b"\xff\xd8\xff\xe0",
    ],
)  # fmt: skip
def test_something_packed_or_unknown(data: bytes) -> None:
    assert "neither UTF-8 text nor a PNG" in (unexpected_content(data) or "")


@pytest.mark.parametrize("data", [b"", _TEXT, "Möller\r\n".encode(), _PNG])
def test_text_and_pictures_are_no_leak(data: bytes) -> None:
    assert unexpected_content(data) is None


def _with_chunk(kind: bytes, body: bytes) -> bytes:
    chunk = len(body).to_bytes(4, "big") + kind + body + zlib.crc32(kind + body).to_bytes(4, "big")
    return _PNG[:-12] + chunk + _PNG[-12:]


@pytest.mark.parametrize(
    "data",
    [
        _PNG + bz2.compress(_TEXT),
        _PNG[:8] + zlib.compress(_TEXT),
        _PNG[:8],
        _PNG[:-4],
        _PNG[:40] + bytes([_PNG[40] ^ 1]) + _PNG[41:],
        _with_chunk(b"raWz", zlib.compress(_TEXT)),
        _with_chunk(b"IDAT", zlib.compress(_TEXT)),
    ],
)
def test_a_picture_that_holds_something_else(data: bytes) -> None:
    assert "more than a picture" in (unexpected_content(data) or "")


def test_an_archive_that_is_damaged_ends_no_search() -> None:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_LZMA) as archive:
        archive.writestr("a.txt", _TEXT)
    data = bytearray(packed.getvalue())
    data[30 + len("a.txt") + 4] = 0xFF  # what LZMA was packed with
    assert [piece.place for piece in pieces("a.zip", bytes(data))] == ["a.zip"]


def test_a_place_that_tells_what_it_is(tmp_path: Path) -> None:
    for name in ("grader/judge/a.py", "course.toml", "x/solutions/b.txt"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("nothing\n", encoding="utf-8")
    found = {leak.place for leak in find_leaks(Secrets(NgramIndex(), {}, None), tmp_path)}
    assert {"grader/judge", "course.toml", "x/solutions"} <= found
