"""Sources as editors on other systems save them, and files that are no sources."""

import codecs
from pathlib import Path

import pytest

from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.submission.encoding import decode
from raysteps.submission.entries import RejectedFile
from raysteps.submission.load import load_submission

pytestmark = pytest.mark.portable

TEXT = "// Gr\u00f6\u00dfe\n#include <a>\n\nint x = 1;\n"


def test_an_ordinary_source_stays_as_it_is() -> None:
    for text in (TEXT, "", "int x;", "\n\n", "\f\tint x;\n", 'char bell[] = "\a"; // ' + "x" * 99):
        decoded = decode(text.encode())
        assert decoded.source == text.encode()
        assert decoded.remark("a.cpp") == ""


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (codecs.BOM_UTF8 + TEXT.encode(), "UTF-8 with a byte order mark"),
        (codecs.BOM_UTF16_LE + TEXT.encode("utf-16-le"), "UTF-16"),
        (codecs.BOM_UTF16_BE + TEXT.encode("utf-16-be"), "UTF-16"),
        (codecs.BOM_UTF32_LE + TEXT.encode("utf-32-le"), "UTF-32"),
        (codecs.BOM_UTF32_BE + TEXT.encode("utf-32-be"), "UTF-32"),
        (TEXT.encode("utf-16-le"), "UTF-16"),
        (TEXT.encode("utf-16-be"), "UTF-16"),
        (TEXT.replace("\n", "\r\n").encode(), "saved with Windows line ends"),
        (TEXT.replace("\n", "\r").encode(), "saved with the line ends of an old Macintosh"),
        (TEXT.replace("\n", "\r\n").encode("utf-16"), "UTF-16 and saved with Windows line ends"),
        (TEXT.encode("latin-1"), "not UTF-8 but in an older encoding"),
    ],
)
def test_other_encodings_become_plain_utf8(data: bytes, words: str) -> None:
    decoded = decode(data)
    assert decoded.source == TEXT.encode()
    assert decoded.remark("a.cpp") == f"a.cpp was {words}; it was read as such."


def test_bytes_of_any_older_encoding_keep_lines_and_code() -> None:
    comment = bytes(byte for byte in range(0x80, 0x100)) + "日本".encode("shift_jis")
    decoded = decode(b"int a;\n// " + comment + b"\nint b;\n")
    lines = decoded.source.decode().splitlines()
    assert (lines[0], lines[-1]) == ("int a;", "int b;")
    assert decoded.source.count(b"\n") == 3


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"int a;\nint \0b;\n", "holds NUL bytes (the first in line 2)"),
        (b"PK\x03\x04" + bytes(40), "is a zip archive or an office document"),
        (b"\x7fELF\x02\x01\x01" + bytes(40), "is a compiled program"),
        (b"{\\rtf1\\ansi int a; }", "is an RTF document"),
        (b"<!DOCTYPE html>\n<html>int a;</html>", "is a web page"),
        (b"%PDF-1.7\n", "is a PDF document"),
        (bytes(range(1, 32)) * 20, "is a binary file"),
        (codecs.BOM_UTF16_LE + b"abc", "is damaged UTF-16"),
        (codecs.BOM_UTF16_LE + b"\x00\xd8a\x00", "is damaged UTF-16"),
        (codecs.BOM_UTF32_LE + b"\xff\xff\xff\xff", "is damaged UTF-32"),
    ],
)
def test_what_is_no_source_is_explained(data: bytes, words: str) -> None:
    with pytest.raises(RejectedFile) as problem:
        decode(data)
    assert str(problem.value).startswith(words)
    assert "was not taken" in str(problem.value)


def test_notes_and_remarks_reach_the_submission(tmp_path: Path, steps: list[Step]) -> None:
    (tmp_path / "shadows.cpp").write_bytes(TEXT.encode("utf-16"))
    (tmp_path / "octree.cpp").write_bytes(b"\x7fELF" + bytes(100))
    submission = load_submission(tmp_path, steps)
    assert submission.sources == {"04-shadows": TEXT.encode()}
    assert submission.remarks == {"04-shadows": "shadows.cpp was UTF-16; it was read as such."}
    assert set(submission.notes) == {"06-octree"}
    assert submission.notes["06-octree"].startswith("octree.cpp is a compiled program, not a source, and was not")


def test_a_submission_of_binaries_only_says_so(tmp_path: Path, steps: list[Step]) -> None:
    (tmp_path / "notes.txt").write_text("x")
    with pytest.raises(UsageError, match="holds no step"):
        load_submission(tmp_path, steps)
    (tmp_path / "octree.cpp").write_bytes(bytes(100))
    assert "NUL" in load_submission(tmp_path, steps).notes["06-octree"]
