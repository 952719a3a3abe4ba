"""A CSV file in which single cells can be replaced while every other byte stays as it is."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.cells import delimiter_of
from raysteps.common.errors import UsageError

_MAX_BYTES = 32 << 20
_WIDE = (b"\xff\xfe", b"\xfe\xff", b"\x00\x00\xfe\xff")


@dataclass(frozen=True)
class Cell:
    """Where a cell stands in the text, quotes included, and what it says."""

    start: int
    end: int
    text: str
    quoted: bool


@dataclass(frozen=True)
class Row:
    """One record; quoted cells may hold line breaks, so it need not be one line."""

    line: int
    cells: tuple[Cell, ...]

    def text(self, column: int) -> str:
        return self.cells[column].text if column < len(self.cells) else ""

    @property
    def is_blank(self) -> bool:
        return not any(cell.text.strip() for cell in self.cells)


class _Scanner:
    def __init__(self, path: Path, text: str, at: int, delimiter: str) -> None:
        self._path = path
        self._text = text
        self._at = at
        self._delimiter = delimiter
        self._line = 1

    def _cell(self) -> Cell:
        text, start = self._text, self._at
        if not text.startswith('"', start):
            while self._at < len(text) and text[self._at] not in (self._delimiter, "\r", "\n"):
                self._at += 1
            return Cell(start, self._at, text[start : self._at], False)
        line = self._line
        parts: list[str] = []
        self._at += 1
        while True:
            close = text.find('"', self._at)
            if close < 0:
                raise UsageError(f"{self._path}:{line}: a quoted cell that begins here has no end")
            parts.append(text[self._at : close])
            self._at = close + 1
            if not text.startswith('"', self._at):
                break
            parts.append('"')
            self._at += 1
        said = "".join(parts)
        self._line += said.count("\n") + said.count("\r") - said.count("\r\n")
        if self._at < len(text) and text[self._at] not in (self._delimiter, "\r", "\n"):
            raise UsageError(f"{self._path}:{self._line}: text after the closing quote of a cell")
        return Cell(start, self._at, said, True)

    def rows(self) -> list[Row]:
        rows, text = [], self._text
        while self._at < len(text):
            line, cells = self._line, [self._cell()]
            while text.startswith(self._delimiter, self._at):
                self._at += 1
                cells.append(self._cell())
            self._at += 2 if text.startswith("\r\n", self._at) else 1
            self._line += 1
            rows.append(Row(line, tuple(cells)))
        return rows


@dataclass(frozen=True)
class Sheet:
    """The file's text, its byte order mark included, and its records."""

    path: Path
    text: str
    delimiter: str
    rows: tuple[Row, ...]

    def filled(self, changes: Mapping[Cell, str]) -> bytes:
        """The file with these cells replaced; a cell keeps its quotes, and gets some where it needs them."""
        parts, at = [], 0
        for cell in sorted(changes, key=lambda one: one.start):
            parts += [self.text[at : cell.start], self._written(changes[cell], cell.quoted)]
            at = cell.end
        return "".join([*parts, self.text[at:]]).encode("utf-8")

    def _written(self, value: str, quoted: bool) -> str:
        if quoted or any(sign in value for sign in (self.delimiter, '"', "\n", "\r")):
            return '"' + value.replace('"', '""') + '"'
        return value


def read_sheet(path: Path) -> Sheet:
    """Reads UTF-8, with or without a byte order mark; what is written back is the same down to the byte."""
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise UsageError(f"{path}: is larger than {_MAX_BYTES >> 20} MB")
        data = path.read_bytes()
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {error.strerror or error}") from error
    if data.startswith(_WIDE) or b"\x00" in data:
        raise UsageError(f"{path}: is UTF-16 or no text at all; export or save it as CSV in UTF-8")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise UsageError(f"{path}: is not UTF-8 (byte {error.start}); export or save it as CSV in UTF-8") from error
    start = 1 if text.startswith("\ufeff") else 0
    delimiter = delimiter_of(text[start:])
    rows = _Scanner(path, text, start, delimiter).rows()
    if not rows:
        raise UsageError(f"{path}: is empty")
    return Sheet(path, text, delimiter, tuple(rows))
