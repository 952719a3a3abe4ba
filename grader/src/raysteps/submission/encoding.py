"""Turns a source as editors on any system save it into plain UTF-8 with LF, so that line numbers stay right."""

import codecs
import re
from dataclasses import dataclass

from raysteps.common.files import PNG_SIGNATURE
from raysteps.common.text import join_and
from raysteps.submission.entries import RejectedFile

_BOMS = (  # UTF-32 first: its mark begins like that of UTF-16
    (codecs.BOM_UTF32_LE, "utf-32-le", "UTF-32"),
    (codecs.BOM_UTF32_BE, "utf-32-be", "UTF-32"),
    (codecs.BOM_UTF16_LE, "utf-16-le", "UTF-16"),
    (codecs.BOM_UTF16_BE, "utf-16-be", "UTF-16"),
    (codecs.BOM_UTF8, "utf-8", "UTF-8 with a byte order mark"),
)
_DOCUMENTS = (
    (b"PK\x03\x04", "a zip archive or an office document"),
    (b"\x7fELF", "a compiled program"),
    (b"MZ\x90\x00", "a compiled program"),
    (b"%PDF-", "a PDF document"),
    (b"{\\rtf", "an RTF document"),
    (b"\xd0\xcf\x11\xe0", "an office document"),
    (b"\x1f\x8b", "a compressed file"),
    (PNG_SIGNATURE[:4], "a picture"),
    (b"\xff\xd8\xff", "a picture"),
    (b"!<arch>", "a compiled library"),
)
_PAGE = re.compile(rb"\s*<(?:!doctype\s+html|html)\b", re.I)
_CONTROL = re.compile(r"[\x00-\x08\x0e-\x19\x1c-\x1f]")
_MANY_CONTROLS = 0.05
_ADVICE = "save it as plain text (UTF-8) and hand it in again"


@dataclass(frozen=True)
class Decoded:
    """A source, and what was unusual about it (words that go on after `was`)."""

    source: bytes
    oddities: tuple[str, ...]

    def remark(self, name: str) -> str:
        """A sentence about an accepted oddity, or nothing."""
        return f"{name} was {join_and(list(self.oddities))}; it was read as such." if self.oddities else ""


def _guess(data: bytes) -> tuple[str, str]:
    """UTF-16 without its mark: program text has a NUL in almost every second byte."""
    if len(data) >= 8 and len(data) % 2 == 0:
        for first, name in ((1, "utf-16-le"), (0, "utf-16-be")):
            zeros, others = data[first::2].count(0), data[1 - first :: 2].count(0)
            if zeros > len(data) // 4 and others == 0:
                return name, "UTF-16"
    return "utf-8", ""


def _encoding(data: bytes) -> tuple[int, str, str]:
    """How long its mark is, its name for Python, and its name for people where it is unusual."""
    for mark, codec, name in _BOMS:
        if data.startswith(mark):
            return len(mark), codec, name
    return 0, *_guess(data)


def _text(data: bytes) -> tuple[str, list[str]]:
    start, codec, name = _encoding(data)
    oddities = [name] if name else []
    try:
        return data[start:].decode(codec), oddities
    except UnicodeDecodeError as error:
        if codec != "utf-8":
            raise RejectedFile(f"is damaged {name} and was not taken; {_ADVICE}.") from error
    # Bytes of older encodings stand in comments; which letters they were does not matter there.
    return data[start:].decode("latin-1"), [*oddities, "not UTF-8 but in an older encoding"]


def _check(text: str) -> None:
    if "\0" in text:
        line = text.count("\n", 0, text.index("\0")) + 1
        raise RejectedFile(
            f"holds NUL bytes (the first in line {line}), which no source has, and was not taken; {_ADVICE}."
        )
    if len(_CONTROL.findall(text)) > _MANY_CONTROLS * len(text):
        raise RejectedFile(f"is a binary file, not a source, and was not taken; {_ADVICE}.")


def decode(data: bytes) -> Decoded:
    """Plain UTF-8 with LF. What is no text raises RejectedFile with words that go on after the file's name."""
    for magic, what in _DOCUMENTS:
        if data.startswith(magic):
            raise RejectedFile(f"is {what}, not a source, and was not taken; {_ADVICE}.")
    if _PAGE.match(data):
        raise RejectedFile(f"is a web page, not a source, and was not taken; {_ADVICE}.")
    text, oddities = _text(data)
    ends = "saved with Windows line ends" if "\r\n" in text else ""
    text = text.replace("\r\n", "\n")
    if "\r" in text:
        ends, text = "saved with the line ends of an old Macintosh", text.replace("\r", "\n")
    _check(text)
    return Decoded(text.encode(), (*oddities, *([ends] if ends else [])))
