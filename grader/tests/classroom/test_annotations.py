"""What people say of submissions and change in their points: it is never lost, and every file tells it."""

import csv
import io
import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from class_fakes import grade_class, write_entry

from raysteps.classroom.annotations import (
    AnnotationConflict,
    all_annotations,
    annotate,
    annotations_of,
    new_annotation,
)
from raysteps.classroom.class_files import refuse_unwritten, write_class
from raysteps.classroom.database import ClassDatabase
from raysteps.common.documents import Malformed
from raysteps.common.errors import UsageError
from raysteps.desk.annotation_files import AnnotationDraft, AnnotationWriter

pytestmark = pytest.mark.usefixtures("fake_grader")

_STEP = "01-camera-rays"
_CODE = "// points 4\nint first = 1;\nint second = 2;\nint third = 3;\n"


@pytest.fixture
def handed_in(tmp_path: Path) -> Path:
    for name in ("ann", "bob"):
        write_entry(tmp_path / "in", name, _CODE)
    return tmp_path / "in"


@pytest.fixture
def grades(tmp_path: Path, handed_in: Path) -> Path:
    assert grade_class(handed_in, "--out", tmp_path / "out") == 0
    return tmp_path / "out"


def _say(out: Path, kind: Any, name: str = "ann", **more: Any) -> str:
    """Does it, makes the files anew, and gives what it is called."""
    with closing(ClassDatabase(out)) as database:
        AnnotationWriter(database, name).write(AnnotationDraft(kind, "Ada", **{"text": "because", **more}))
        write_class(database, out)
        return all_annotations(database)[-1][1].uid


def _results(out: Path, name: str = "ann") -> dict[str, Any]:
    found: dict[str, Any] = json.loads((out / "submissions" / name / "results.json").read_text())
    return found


def _step(out: Path, name: str = "ann") -> dict[str, Any]:
    found: dict[str, Any] = _results(out, name)["steps"][0]
    return found


def _row(out: Path, name: str = "ann") -> dict[str, str]:
    rows = csv.DictReader(io.StringIO((out / "results.csv").read_text("utf-8-sig"), newline=""))
    return next(row for row in rows if row["submission"] == name)


def _class(out: Path, name: str = "ann") -> dict[str, Any]:
    document = json.loads((out / "class.json").read_text())
    found: dict[str, Any] = next(one for one in document["submissions"] if one["name"] == name)
    return found


def _report(out: Path, name: str = "ann") -> str:
    return (out / "submissions" / name / "report.html").read_text()


def test_points_and_comments_stand_in_every_file(grades: Path) -> None:
    _say(grades, "points", step=_STEP, points=6.5, text="the comment explains it")
    _say(grades, "points", points=2, text="a nice picture")
    _say(grades, "comment", step=_STEP, line=3, text="why two?")
    _say(grades, "comment", text="well done in all")
    results, step = _results(grades), _step(grades)
    assert (step["points"], step["review"]["automatic"]) == (6.5, 4)
    assert results["total"]["points"] == 8.5
    assert results["review"]["overrides"][0]["points"] == 2
    comment = step["review"]["comments"][0]
    assert (comment["line"], comment["first"], comment["since_then"]) == (3, 1, "")
    assert comment["excerpt"] == _CODE.split("\n")[:5]
    row = _row(grades)
    assert (row["points"], row[_STEP], row["automatic_points"]) == ("8.5", "6.5", "4")
    assert "01 from 4 to 6.5 by Ada: the comment explains it" in row["changed_by_hand"]
    assert _row(grades, "bob")["automatic_points"] == ""
    one = _class(grades)
    assert (one["points"], one["final"], one["review"]["automatic"], one["review"]["comments"]) == (8.5, 8.5, 4, 2)
    for words in ("the points from 4 to 6.5: the comment explains it", "why two?", "int second = 2;", "+2 points",
                  "well done in all"):  # fmt: skip
        assert words in _report(grades), words
    assert "Ada" not in _report(grades, "bob")


def test_the_printed_table_has_points_for_what_was_not_started(
    handed_in: Path, grades: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _say(grades, "points", step="03-phong-shading", points=15)
    _, steps, marks = _printed_table(handed_in, grades, "1-4", capsys)
    assert steps == ["4", "-", "15 -", "-", "19"]
    assert marks == "- not started"
    assert "bonus" in _printed_table(handed_in, grades, "1-9", capsys)[2]


def _printed_table(
    handed_in: Path, grades: Path, steps: str, capsys: pytest.CaptureFixture[str]
) -> tuple[str, list[str], str]:
    """The name and the cells of its first row, and what is said of its marks."""
    capsys.readouterr()
    assert grade_class(handed_in, "--out", grades, "--only", steps) == 0
    lines = capsys.readouterr().out.splitlines()
    name, *cells = (cell.strip() for cell in next(line for line in lines if "│ ann" in line).strip("│").split("│"))
    return name, cells, lines[next(at for at, line in enumerate(lines) if line.startswith("└")) + 1]


def test_they_survive_a_resume_and_a_whole_regrade(tmp_path: Path, handed_in: Path, grades: Path) -> None:
    _say(grades, "points", step=_STEP, points=6.5, text="x")
    _say(grades, "comment", step=_STEP, line=3, text="why two?")
    for words in (["--resume"], []):
        assert grade_class(handed_in, "--out", grades, *words) == 0
        assert (_step(grades)["points"], _row(grades)["points"]) == (6.5, "6.5")
        assert _step(grades)["review"]["comments"][0]["line"] == 3
        assert _class(grades)["review"]["look_again"] == []
    assert json.loads((grades / "class.json").read_text())["changed"] == []  # the grader gives what it gave


def test_a_line_is_found_again_in_other_code_and_points_are_to_be_looked_at(
    tmp_path: Path, handed_in: Path, grades: Path
) -> None:
    _say(grades, "comment", step=_STEP, line=3, text="why two?")
    _say(grades, "comment", step=_STEP, line=4, text="and three?")
    _say(grades, "points", step=_STEP, points=6.5, text="x")
    _say(grades, "read")
    assert _class(grades)["review"]["read"]
    write_entry(tmp_path / "in", "ann", "// points 7\n// new\n" + _CODE.split("\n", 1)[1].replace("third", "fourth"))
    assert grade_class(handed_in, "--out", grades, "--resume") == 0
    moved, gone = sorted(_step(grades)["review"]["comments"], key=lambda one: str(one["text"]), reverse=True)
    assert (moved["line"], moved["line_then"], moved["since_then"]) == (4, 3, "moved")
    assert moved["excerpt"][moved["line"] - moved["first"]] == "int second = 2;"
    assert (gone["line"], gone["since_then"]) == (4, "gone")
    assert "int third = 3;" in gone["excerpt"]
    assert _step(grades)["points"] == 7, "better work is not hurt by a favour"
    assert _step(grades)["review"]["automatic"] == 7
    assert _step(grades)["review"]["overrides"] == []
    review = _class(grades)["review"]
    assert review["look_again"] == ["01: Ada made 6.5 of the 4 that the grader gave then; now it gives 7, which counts"]
    assert not review["read"]
    assert "The code has changed since this was written. It was line 3 then." in _report(grades)
    assert "look again" in (grades / "class.html").read_text()
    assert _row(grades)["look_again"] == review["look_again"][0]


@pytest.mark.parametrize("line", ["}", "return k_black;"])
def test_a_line_among_others_is_another_line(tmp_path: Path, handed_in: Path, line: str) -> None:
    """Wherever the same words stand again."""
    write_entry(handed_in, "ann", f"// points 4\nint one() {{\n    int a;\n    {line}\n}}\n")
    out = tmp_path / "lines"
    grade_class(handed_in, "--out", out)
    _say(out, "comment", step=_STEP, line=4, text="which?")
    write_entry(handed_in, "ann", f"// points 4\n\nint two() {{\n    int a;\n    {line}\n}}\n")
    grade_class(handed_in, "--out", out, "--resume")
    comment = _step(out)["review"]["comments"][0]
    assert (comment["line"], comment["since_then"]) == (5, "moved")
    write_entry(handed_in, "ann", f"// points 4\nint b;\nint c;\nint d;\nint e;\n    {line}\n}}\nint f;\n")
    grade_class(handed_in, "--out", out, "--resume")
    assert _step(out)["review"]["comments"][0]["since_then"] == "gone"


def test_lateness_comes_after_what_people_changed(tmp_path: Path, handed_in: Path) -> None:
    policy, out = tmp_path / "late.toml", tmp_path / "late"
    policy.write_text("deadline = 2000-01-01T00:00:00Z\npercent_per_day = 0.001\n")
    roster = tmp_path / "roster.csv"
    roster.write_text("id,name,submission,submitted_at\n1,Ann,ann,2000-01-01T12:00:00Z\n")
    policy.write_text("deadline = 2000-01-01T00:00:00Z\npercent_per_day = 10\n")
    assert grade_class(handed_in, "--out", out, "--roster", roster, "--late-policy", policy) == 0
    _say(out, "points", step=_STEP, points=8, text="x")
    _say(out, "points", points=2, text="picture")
    assert (_row(out)["points"], _row(out)["late_points"]) == ("10", "9")
    assert _results(out)["handed_in"]["late"]["points"] == 9
    assert "10 - 1 = 9 points" in _row(out)["lateness"]
    _say(out, "points", points=-50, text="picture", after=_last(out, "points//"))
    assert (_row(out)["points"], _row(out)["late_points"]) == ("0", "0")


def _last(out: Path, subject: str, name: str = "ann") -> str:
    with closing(ClassDatabase(out)) as database:
        (submission,) = database.connection.execute("SELECT id FROM submissions WHERE name = ?", (name,)).fetchone()
        return [one.uid for one in annotations_of(database, submission) if one.subject == subject][-1]


def test_parts_are_changed_one_by_one_and_the_whole_step_goes_before_them(grades: Path) -> None:
    _say(grades, "points", step=_STEP, part="hidden", points=2, text="nearly")
    _say(grades, "points", step=_STEP, part="tests", points=1.5, text="one was right")
    assert _step(grades)["points"] == 7.5
    assert {one["part"]: one["automatic"] for one in _step(grades)["review"]["overrides"]} == {"hidden": 0, "tests": 0}
    assert "tests from 0 to 1.5 by Ada: one was right" in _row(grades)["changed_by_hand"]
    _say(grades, "points", step=_STEP, points=3, text="all in all")
    assert _step(grades)["points"] == 3
    _say(grades, "points", step=_STEP, points=3, text="no", withdrawn=True, after=_last(grades, f"points/{_STEP}/"))
    assert _step(grades)["points"] == 7.5


def test_what_is_taken_back_stays_as_history(grades: Path) -> None:
    first = _say(grades, "comment", text="hard words")
    again = _say(grades, "comment", text="soft words", subject=first, after=first)
    _say(grades, "comment", text="soft words", subject=first, after=again, withdrawn=True)
    assert _results(grades)["review"] is None
    with closing(sqlite3.connect(grades / "class.sqlite")) as connection:
        rows = connection.execute("SELECT author, content FROM annotations ORDER BY serial").fetchall()
    assert [json.loads(content)["text"] for _, content in rows] == ["hard words", "soft words", "soft words"]


def test_who_was_slower_is_told_and_nothing_is_written(grades: Path) -> None:
    first = _say(grades, "points", step=_STEP, points=5, text="mine")
    for after in ("", "f" * 32):
        with pytest.raises(AnnotationConflict, match="Ada has changed this meanwhile"):
            _say(grades, "points", step=_STEP, points=9, text="mine", after=after)
    assert _step(grades)["points"] == 5
    _say(grades, "points", step=_STEP, points=6, text="agreed", after=first)
    assert _step(grades)["points"] == 6


@pytest.mark.parametrize("change", ["content = '[1]'", "content = '{'", "at = x'00'"])
def test_what_nobody_said_is_the_databases_damage(grades: Path, change: str) -> None:
    _say(grades, "comment", step=_STEP, text="mine")
    with sqlite3.connect(grades / "class.sqlite") as connection:
        connection.execute("PRAGMA ignore_check_constraints = ON")
        assert connection.execute(f"UPDATE annotations SET {change}").rowcount == 1
    with closing(ClassDatabase(grades)) as database, pytest.raises(sqlite3.DatabaseError, match="annotation 1: "):
        all_annotations(database)


def test_an_answer_reaches_the_student(grades: Path) -> None:
    asked = _say(grades, "request", step=_STEP, text="was my test right?")
    assert _class(grades)["review"]["open_requests"] == 1
    assert _row(grades)["open_requests"] == "1"
    assert "It is not answered yet." in _report(grades)
    _say(grades, "request", step=_STEP, text="was my test right?", answer="It was.", subject=asked, after=asked)
    request = _step(grades)["review"]["requests"][0]
    assert (request["state"], request["answer"], request["answered_by"]) == ("answered", "It was.", "Ada")
    assert _class(grades)["review"]["open_requests"] == 0
    assert "It was." in _report(grades)


@pytest.mark.parametrize(
    ("kind", "more", "words"),
    [
        ("points", {"text": " ", "step": _STEP}, "expected a reason"),
        ("points", {"step": _STEP, "points": -1}, "expected a number from 0"),
        ("points", {"points": float("nan")}, "expected a number"),
        ("points", {"part": "tests", "points": 1}, "expected the step"),
        ("points", {"part": "all", "step": _STEP}, "Invalid enum"),
        ("comment", {"text": ""}, "expected a comment"),
        ("comment", {"text": "x" * 20_001}, "at most 20000"),
        ("comment", {"line": 3}, "expected the step"),
        ("request", {"text": ""}, "what the student asks"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_refused(kind: Any, more: dict[str, Any], words: str) -> None:
    with pytest.raises(Malformed, match=f"(?i){words}"):
        new_annotation(kind, "Ada", **{"text": "x", **more})
    with pytest.raises(Malformed, match="author"):
        new_annotation("comment", "  ", text="x")


def test_nothing_of_it_is_a_formula_or_a_page(grades: Path) -> None:
    nasty = '=HYPERLINK("http://evil.example");=1<script>alert(1)</script>\u202e'
    _say(grades, "points", step=_STEP, points=5, text=nasty)
    _say(grades, "comment", text=nasty)
    row = _row(grades)
    assert row["changed_by_hand"].startswith("01 from 4 to 5")
    assert ";'=1<script>" in row["changed_by_hand"]
    page = _report(grades)
    assert "<script>alert" not in page
    assert "\u202e" not in page
    assert "&lt;script&gt;alert(1)" in page


def test_a_database_of_an_older_kit_opens_and_gets_its_code(tmp_path: Path, handed_in: Path, grades: Path) -> None:
    with closing(sqlite3.connect(grades / "class.sqlite")) as connection:
        for table in ("annotations", "sources", "written"):
            connection.execute(f"DROP TABLE {table}")
    refuse_unwritten(grades)
    assert grade_class(handed_in, "--out", grades, "--resume") == 0
    _say(grades, "comment", step=_STEP, line=2, text="now it is there")
    assert _step(grades)["review"]["comments"][0]["line"] == 2


def test_files_that_are_older_than_what_was_said_are_not_exported(grades: Path) -> None:
    refuse_unwritten(grades)
    with closing(ClassDatabase(grades)) as database:
        annotate(database, "ann", new_annotation("comment", "Ada", text="new"), after="")
    with pytest.raises(UsageError, match=r"desk .* --write"):
        refuse_unwritten(grades)
    with closing(ClassDatabase(grades)) as database:
        write_class(database, grades)
    refuse_unwritten(grades)


def test_copies_that_several_people_worked_on_come_together(tmp_path: Path, handed_in: Path, grades: Path) -> None:
    copies = [shutil.copytree(grades, tmp_path / name) for name in ("one", "two")]
    _say(copies[0], "comment", step=_STEP, line=3, text="from one")
    _say(copies[0], "points", step=_STEP, points=5, text="first")
    _say(copies[1], "comment", text="from two", name="bob")
    _say(copies[1], "points", step=_STEP, points=6, text="later")
    for _ in range(2):  # again is harmless
        assert grade_class("--merge", *copies, "--out", grades) == 0
        assert _step(grades)["points"] == 6
        assert _step(grades)["review"]["comments"][0]["text"] == "from one"
        assert _results(grades, "bob")["review"]["comments"][0]["text"] == "from two"
        with closing(sqlite3.connect(grades / "class.sqlite")) as connection:
            assert connection.execute("SELECT count(*) FROM annotations").fetchone() == (4,)
            assert connection.execute("PRAGMA foreign_key_check").fetchall() == []
    refuse_unwritten(grades)


def test_what_was_read_without_code_stays_read_in_a_merge(tmp_path: Path, handed_in: Path) -> None:
    (handed_in / "cy").mkdir()
    places = [tmp_path / name for name in ("first", "second")]
    for place in places:
        assert grade_class(handed_in, "--out", place) == 0
    assert _class(places[1], "cy")["review"]["read"] is False
    _say(places[1], "read", name="cy")
    assert _class(places[1], "cy")["review"]["read"] is True
    assert grade_class("--merge", *places, "--out", tmp_path / "all") == 0
    assert (_class(places[1], "cy")["run"], _class(tmp_path / "all", "cy")["run"]) == (1, 2)
    assert _class(tmp_path / "all", "cy")["review"]["read"] is True
    assert grade_class(handed_in, "--out", tmp_path / "all") == 0
    assert _class(tmp_path / "all", "cy")["review"]["read"] is False, "another result is not read yet"


def test_merged_shards_keep_code_and_comments(tmp_path: Path, handed_in: Path) -> None:
    for number in range(6):
        write_entry(handed_in, f"s{number}", _CODE)
    shards = [tmp_path / f"shard{index}" for index in (1, 2)]
    for index, shard in enumerate(shards, start=1):
        assert grade_class(handed_in, "--out", shard, "--shard", f"{index}/2") == 0
    where = next(shard for shard in shards if (shard / "submissions" / "ann").exists())
    _say(where, "comment", step=_STEP, line=3, text="kept")
    assert grade_class("--merge", *reversed(shards), "--out", tmp_path / "all") == 0
    assert _step(tmp_path / "all")["review"]["comments"][0]["excerpt"][2] == "int second = 2;"
    with closing(ClassDatabase(tmp_path / "all")) as database:
        for name in ("ann", "s3"):
            row = database.current(name)
            assert row is not None
            assert database.sources(row["submission"], row["run"])[_STEP].data == _CODE.encode()


def test_of_a_fault_points_wait_until_there_is_a_result(tmp_path: Path, handed_in: Path, grades: Path) -> None:
    _say(grades, "points", step=_STEP, points=6, text="x")
    write_entry(handed_in, "ann", "// fault")
    assert grade_class(handed_in, "--out", grades, "--resume") == 4
    assert "no result that it could count in" in _class(grades)["review"]["look_again"][0]
    write_entry(handed_in, "ann", _CODE)
    assert grade_class(handed_in, "--out", grades, "--resume") == 0
    assert _row(grades)["points"] == "6"
