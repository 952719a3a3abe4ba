"""The database of a class, and the tables made from it."""

import csv
import io
import json
import re
import sqlite3
import unicodedata
from contextlib import closing
from pathlib import Path

import pytest
from class_documents import without_times

from raysteps.classroom.class_files import csv_bytes, safe_cell
from raysteps.classroom.database import (
    VERSION,
    ClassDatabase,
    RegisteredEntry,
    RunFacts,
    StudentEntries,
    explained_sqlite_errors,
    open_database,
    open_readonly,
    transaction,
)
from raysteps.classroom.jobs import Job, JobResult, from_line, to_line
from raysteps.classroom.session import submission_key
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.text import FORMULA_SIGNS
from raysteps.results.model import Results, Settings, StepResult
from raysteps.submission.load import Submission

_SETTINGS = Settings()


def _facts(uid: str) -> RunFacts:
    return RunFacts(uid, "kit", "/in", "1/1", _SETTINGS, [], "", [])


def _begin(database: ClassDatabase, uid: str = "a") -> int:
    return database.begin_run(
        _facts(uid), [RegisteredEntry("ann.zip", "ann", "here")], [StudentEntries("1", "Ann", "", ("ann.zip",))]
    )


def _results(points: float = 1.0) -> Results:
    return Results.of("ann", [StepResult("01-camera-rays", "partial", points, 10.0, False)])


def _answer(points: float, **pictures: bytes) -> JobResult:
    return JobResult(
        "ann", "graded", _results(points), {f"pictures/{name}.png": data for name, data in pictures.items()}
    )


def _count(database: ClassDatabase, table: str) -> int:
    return int(database.connection.execute(f"SELECT count(*) FROM {table}").fetchone()[0])


def test_a_result_is_kept_once_per_run(tmp_path: Path) -> None:
    with closing(ClassDatabase(tmp_path)) as database:
        run = _begin(database)
        assert database.record(run, _answer(5, a=b"x", b=b"y"), "key")
        assert not database.record(run, _answer(9, a=b"z"), "key")
        current = database.current("ann")
        assert current is not None
        assert current["points"] == 5
        again = _begin(database, "b")
        assert database.record(again, _answer(7, a=b"x"), "key")
        current = database.current("ann")
        assert current is not None
        assert (current["points"], current["run"]) == (7, again)
        assert database.pictures(current["submission"], run) == {"pictures/a.png": b"x", "pictures/b.png": b"y"}
        assert (_count(database, "results"), _count(database, "blobs")) == (2, 2)
        states = [row["state"] for row in database.connection.execute("SELECT state FROM runs ORDER BY number")]
        assert states == ["interrupted", "running"]


def test_half_a_result_is_none(tmp_path: Path) -> None:
    with closing(ClassDatabase(tmp_path)) as database:
        run = _begin(database)
        broken = JobResult("ann", "graded", _results(), {"a.png": b"x", "b.png": None})  # type: ignore[dict-item]
        with pytest.raises(TypeError):
            database.record(run, broken, "key")
        assert (_count(database, "results"), _count(database, "blobs"), _count(database, "pictures")) == (0, 0, 0)


def test_the_schema_holds(tmp_path: Path) -> None:
    with closing(ClassDatabase(tmp_path)) as database:
        run = _begin(database)
        mode = database.connection.execute("PRAGMA journal_mode").fetchone()[0]
        assert mode == "wal"
        row = "INSERT INTO results VALUES (?, ?, 'k', ?, ?, ?, '', '', 'w', 1, 't')"
        for values in ((99, run, "graded", 1, "{}"), (1, run, "graded", None, "{}"), (1, run, "fault", 1, "")):
            with pytest.raises(sqlite3.IntegrityError):
                database.connection.execute(row, values)


def test_other_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "class.sqlite"
    path.write_text("not a database at all, but long enough to look at" * 20)
    with pytest.raises(UsageError, match="cannot be opened"):
        open_database(path)
    path.unlink()
    with closing(sqlite3.connect(path)) as other:
        other.execute("CREATE TABLE mine (a)")
    with pytest.raises(UsageError, match="not one of a class"):
        open_database(path)
    path.unlink()
    with closing(open_database(path)) as connection:
        connection.execute(f"PRAGMA user_version = {VERSION + 1}")
    with pytest.raises(UsageError, match=f"has version {VERSION + 1}"):
        open_database(path)


def test_a_transaction_is_all_or_nothing(tmp_path: Path) -> None:
    with closing(ClassDatabase(tmp_path)) as database:

        def interrupted() -> None:
            with transaction(database.connection):
                database.connection.execute("INSERT INTO blobs VALUES ('a', x'00')")
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            interrupted()
        assert _count(database, "blobs") == 0


def test_keys_depend_on_all_that_a_grade_depends_on() -> None:
    submission = Submission("ann", {"01": b"x"}, {"02": "none"}, {})
    key = submission_key(submission, "kit", _SETTINGS)
    assert key == submission_key(Submission("ann", {"01": b"x"}, {"02": "none"}, {}), "kit", Settings())
    others = [
        submission_key(Submission("ann", {"01": b"y"}, {"02": "none"}, {}), "kit", _SETTINGS),
        submission_key(Submission("ann", {"01": b"x"}, {"02": "other"}, {}), "kit", _SETTINGS),
        submission_key(Submission("ann", {"01": b"x"}, {"02": "none"}, {"01": "odd"}), "kit", _SETTINGS),
        submission_key(Submission("bob", {"01": b"x"}, {"02": "none"}, {}), "kit", _SETTINGS),
        submission_key(submission, "kit2", _SETTINGS),
        *(
            submission_key(submission, "kit", settings)
            for settings in (
                Settings(seed=2),
                Settings(only=("01",)),
                Settings("score"),
                Settings(limits={"wall_seconds": 1}),
            )
        ),
    ]
    assert len({key, *others}) == 10


def test_without_times() -> None:
    document = {"timing": {"seconds": 1}, "steps": [{"images": [{"seconds": 2, "name": "a"}], "points": 3}]}
    assert without_times(document) == {"steps": [{"images": [{"name": "a"}], "points": 3}]}
    assert document["timing"] == {"seconds": 1}


@pytest.mark.parametrize(
    "text", ["=1+1", "+1", "-1", "@SUM(A1)", "\t1", "\r=1", " =1", "\uff1d1+1", "\u200b=1", "\x1b[2J"]
)
def test_cells_that_a_spreadsheet_would_run(text: str) -> None:
    assert safe_cell(text) == f"'{text}"


@pytest.mark.parametrize(
    ("text", "cell"),
    [
        ("a;=1+1", "a;'=1+1"),
        ("a; \u3000-1;b", "a; \u3000'-1;b"),
        ("a\t@x;+1", "a\t'@x;'+1"),
        ("\t=1", "'\t'=1"),
        ("a;\uff1d1", "a;'\uff1d1"),
        ("a;b-1=2", "a;b-1=2"),
    ],
)
def test_nor_where_semicolons_or_tabs_separate_cells(text: str, cell: str) -> None:
    assert safe_cell(text) == cell


def test_all_signs_that_are_read_as_those_of_a_formula_are_known() -> None:
    found = {chr(code) for code in range(0x110000) if unicodedata.normalize("NFKC", chr(code))[:1] in set("=+-@")}
    assert found <= set(FORMULA_SIGNS), [hex(ord(sign)) for sign in found - set(FORMULA_SIGNS)]


@pytest.mark.parametrize(
    ("value", "cell"), [("ann", "ann"), (-1.5, "-1.5"), (10.0, "10"), (None, ""), ("a=b", "a=b"), ("a\0b", "ab")]
)
def test_other_cells_stay(value: str | float | None, cell: str) -> None:
    assert safe_cell(value) == cell


def test_csv_reads_back() -> None:
    rows = [["a", "b"], ['with "quotes", commas\nand lines', "é"]]
    data = csv_bytes(rows)
    assert list(csv.reader(io.StringIO(data.decode("utf-8-sig"), newline=""))) == rows


def test_messages_survive_the_way() -> None:
    job = Job(Submission("ann", {"01": b"\0\xff"}, {"02": "n"}, {"01": "r"}), _SETTINGS, "a.b:c", "kit", True, "run")
    assert from_line(to_line(job), Job) == job
    answer = JobResult("ann", "graded", _results(), {"pictures/01/a-mine.png": b"\0\xff"}, seconds=1.5, worker="w")
    assert from_line(to_line(answer), JobResult) == answer


_OUTSIDE = "key in $.pictures: expected str matching regex "
_EITHER = "$: results without a fault, or a fault without results, expected"


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"pictures": {"../../etc/passwd.png": ""}}, _OUTSIDE),
        ({"pictures": {"pictures/../../a.png": ""}}, _OUTSIDE),
        ({"pictures": {"/pictures/a.png": ""}}, _OUTSIDE),
        ({"status": "great"}, "$.status: invalid enum value 'great'"),
        ({"results": None}, _EITHER),
        ({"fault": "and yet"}, _EITHER),
        ({"seconds": -1}, "$.seconds: expected int >= 0"),
        ({"more": 1}, "$: unknown key 'more'; known are name, "),
    ],
)
def test_what_is_no_answer(change: dict[str, object], words: str) -> None:
    good = json.loads(to_line(JobResult("ann", "graded", _results())))
    with pytest.raises(GraderFault, match=re.escape(f"this is no JobResult: {words}")):
        from_line(json.dumps({**good, **change}).encode(), JobResult)


def _graded_folder(out: Path) -> Path:
    """A class with a result, and what lies beside its database."""
    with closing(ClassDatabase(out)) as database:
        run = _begin(database)
        database.record(run, _answer(5, **{f"p{n}": bytes([n]) * 5000 for n in range(50)}), "key")
        database.end_run(run, "complete", {})
    (out / "class.json").write_text("{}")
    return out / "class.sqlite"


@pytest.mark.parametrize("empty", [b"", None], ids=["no bytes", "no rows"])
def test_an_emptied_database_is_never_graded_into(tmp_path: Path, empty: bytes | None) -> None:
    """Else a whole class would be graded anew, silently, over the results that are there."""
    path = _graded_folder(tmp_path)
    if empty is None:
        path.unlink()
        with closing(ClassDatabase(tmp_path / "..")):
            (tmp_path.parent / "class.sqlite").rename(path)
    else:
        path.write_bytes(empty)
    with pytest.raises(UsageError, match=r"is empty, but class\.json beside it .* Put back a copy of it,") as told:
        ClassDatabase(tmp_path)
    assert "name another --out" in str(told.value)
    path.unlink()
    ClassDatabase(tmp_path).close()  # deleted on purpose


@pytest.mark.parametrize("where", ["start", "middle"])
def test_a_damaged_database_is_told_with_a_way_back(tmp_path: Path, where: str) -> None:
    folder = tmp_path / "a class"
    folder.mkdir()
    path = _graded_folder(folder)
    data = bytearray(path.read_bytes())
    at = 0 if where == "start" else 5 * 4096
    data[at : at + 16 * 4096 if at else 100] = b"\xa5" * (16 * 4096 if at else 100)
    path.write_bytes(data)
    for act in (lambda: ClassDatabase(folder).close(), lambda: open_readonly(path).__enter__()):
        with pytest.raises(UsageError, match=r"of a class: .* it is damaged, .* Put back a copy") as told:
            act()
        assert f"`sqlite3 '{path}' .recover`" in str(told.value)
    assert path.read_bytes() == data


def test_a_full_disk_is_the_graders_fault(tmp_path: Path) -> None:
    """And what was recorded before stays."""
    with closing(ClassDatabase(tmp_path)) as database:
        run = _begin(database)
        assert database.record(run, _answer(5), "key")
        database.connection.execute("PRAGMA max_page_count = 30")
        again = _begin(database, "b")
        with (
            pytest.raises(GraderFault, match="full; make room, then go on"),
            explained_sqlite_errors(tmp_path, "used"),
        ):
            database.record(again, _answer(9, big=bytes(1 << 20)), "key")
        current = database.current("ann")
        assert current is not None
        assert current["points"] == 5
