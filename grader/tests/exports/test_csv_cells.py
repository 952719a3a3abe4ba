"""A CSV file in which cells are replaced and nothing else changes."""

import csv
import io
import random
from pathlib import Path

import pytest

from raysteps.common.errors import UsageError
from raysteps.exports.gradebook import Sheet, read_sheet

pytestmark = pytest.mark.portable


def _sheet(tmp_path: Path, data: bytes) -> Sheet:
    path = tmp_path / "in.csv"
    path.write_bytes(data)
    return read_sheet(path)


@pytest.mark.parametrize(
    "data",
    [
        b"a,b\n1,2\n",
        b"a,b\r\n1,2",
        b'\xef\xbb\xbfa;b\r\n"1;5";2\r\n\r\n',
        b'a,"b\nc"\r"x""y",\r\r',
        "Größe\tß\n\u2028\tü\n".encode(),
        b"a,b\n  ,\t\n,,,\n\n\n",
        b'"a","b"\r\n"",""\r\n',
    ],
)
def test_without_changes_nothing_changes(tmp_path: Path, data: bytes) -> None:
    assert _sheet(tmp_path, data).filled({}) == data


def test_a_cell_keeps_its_quotes_and_gets_some_where_it_needs_them(tmp_path: Path) -> None:
    sheet = _sheet(tmp_path, b'\xef\xbb\xbfname;grade;"text"\r\nAnn;;""\r\nBob; 7 ;"old"\r\n;;\r\n')
    ann, bob, last = (row.cells for row in sheet.rows[1:])
    filled = sheet.filled({bob[2]: 'a "b"', ann[1]: "8,5", ann[2]: "ok", bob[1]: "a;b", last[2]: "two\nlines"})
    assert filled == b'\xef\xbb\xbfname;grade;"text"\r\nAnn;8,5;"ok"\r\nBob;"a;b";"a ""b"""\r\n;;"two\nlines"\r\n'


@pytest.mark.parametrize("seed", range(60))
def test_cells_are_those_of_the_csv_module(tmp_path: Path, seed: int) -> None:
    chance = random.Random(seed)
    letters = ["a", "b", " ", ",", ";", '"', "\n", "\r\n", "\t", "é"]
    rows = [["".join(chance.choices(letters, k=chance.randrange(6))) for _ in range(4)] for _ in range(8)]
    rows[0] = ["one", "two", "three", "four"]
    delimiter, ending = chance.choice(",;\t"), chance.choice(["\n", "\r\n"])
    out = io.StringIO(newline="")
    csv.writer(out, delimiter=delimiter, lineterminator=ending, quoting=chance.choice([0, 1])).writerows(rows)
    data = out.getvalue().encode()
    sheet = _sheet(tmp_path, data)
    assert sheet.delimiter == delimiter
    assert [[cell.text for cell in row.cells] for row in sheet.rows] == rows
    changed = sheet.rows[chance.randrange(8)].cells[chance.randrange(4)]
    again = _sheet(tmp_path, sheet.filled({changed: 'new, "value"; \n'}))
    expected = [[('new, "value"; \n' if cell is changed else cell.text) for cell in row.cells] for row in sheet.rows]
    assert [[cell.text for cell in row.cells] for row in again.rows] == expected


def test_lines_are_counted(tmp_path: Path) -> None:
    sheet = _sheet(tmp_path, b'a,b\r\n"1\r\n2\n3",x\r\ny,z\n')
    assert [row.line for row in sheet.rows] == [1, 2, 5]


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        ("a,b\n".encode("utf-16"), "UTF-16"),
        ("a,b\n".encode("utf-16-le"), "UTF-16"),
        ("ä,b\n".encode("latin-1"), "not UTF-8"),
        (b"", "empty"),
        (b'a,b\n1,"2\n', "in.csv:2: a quoted cell"),
        (b'a,b\n1,"2"3\n', "in.csv:2: text after"),
    ],
)
def test_what_cannot_be_kept_is_refused(tmp_path: Path, data: bytes, complaint: str) -> None:
    with pytest.raises(UsageError, match=complaint):
        _sheet(tmp_path, data)


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="cannot be read"):
        read_sheet(tmp_path / "none.csv")
