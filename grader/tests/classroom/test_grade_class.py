"""Grading a class from end to end, with a grader that does what the submissions say."""

import csv
import io
import json
import os
import re
import sqlite3
import zipfile
from collections.abc import Callable, Sequence
from contextlib import closing
from html import unescape
from pathlib import Path
from typing import Any

import pytest
from class_documents import without_times
from class_fakes import FIRST, grade_class, write_entry
from fake_grader import FakeGrader, log
from rich.console import Console

import raysteps.classroom.class_document
from raysteps.classroom.entries import folded
from raysteps.classroom.late_policy import parse_late_policy
from raysteps.common.errors import UsageError
from raysteps.course.settings import COURSE_VARIABLE
from raysteps.results.store import validate

pytestmark = pytest.mark.usefixtures("fake_grader")


@pytest.fixture
def handed_in(tmp_path: Path) -> Path:
    folder = tmp_path / "in"
    for number in range(1, 5):
        write_entry(folder, f"s{number}", f"// points {number}\n")
    return folder


def _document(out: Path) -> dict[str, Any]:
    document: dict[str, Any] = json.loads((out / "class.json").read_text())
    return document


def _points(out: Path) -> dict[str, float | None]:
    return {one["name"]: one["points"] for one in _document(out)["submissions"]}


def _table(out: Path) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO((out / "results.csv").read_text("utf-8-sig"), newline="")))


def _graded(tmp_path: Path) -> list[str]:
    """What was begun since the last call."""
    path = tmp_path / "log.txt"
    lines = path.read_text().splitlines() if path.exists() else []
    path.unlink(missing_ok=True)
    return sorted(line.removeprefix("begin ") for line in lines if line.startswith("begin "))


def _files(out: Path) -> dict[str, bytes]:
    return {path.relative_to(out).as_posix(): path.read_bytes() for path in out.rglob("*.png")}


def test_all_forms_are_graded(tmp_path: Path, handed_in: Path) -> None:
    with zipfile.ZipFile(handed_in / "zed.zip", "w") as archive:
        archive.writestr(f"steps/{FIRST}", "// points 9\n")
    out = tmp_path / "out"
    console = Console(file=io.StringIO(), width=200)
    assert grade_class(handed_in, "--out", out, "--jobs", 2, console=console) == 0
    assert _points(out) == {"s1": 1, "s2": 2, "s3": 3, "s4": 4, "zed": 9}
    for name in _points(out):
        document = json.loads((out / "submissions" / name / "results.json").read_text())
        assert (out / "submissions" / name / "report.html").is_file()
        validate(document)
        assert document["submission"] == name
    assert sorted(_files(out))[:2] == [
        "submissions/s1/pictures/01-camera-rays/a-mine.png",
        "submissions/s1/pictures/01-camera-rays/a-reference.png",
    ]  # and nothing that the results do not name
    assert len(_files(out)) == 10
    facts = _document(out)["statistics"]
    assert facts == {"graded": 5, "mean": 3.8, "median": 3}
    assert isinstance(console.file, io.StringIO)
    printed = console.file.getvalue()
    assert "mean 3.8, median 3 points" in printed
    assert "zed" in printed
    assert [row["01-camera-rays"] for row in _table(out)] == ["1", "2", "3", "4", "9"]


def test_what_goes_wrong_with_one_stops_none(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    texts = {
        "die": "// die",
        "fault": "// fault",
        "once": "// die once\n// points 3",
        "oops": "// oops",
        "well": "// points 5",
    }
    for name, text in texts.items():
        write_entry(tmp_path / "in", name, text)
    (tmp_path / "in" / "notes.txt").write_text("no archive")
    (tmp_path / "in" / "empty").mkdir()
    out = tmp_path / "out"
    assert grade_class(tmp_path / "in", "--out", out, "--jobs", 2) == 4
    assert _points(out) == {
        "die": None, "empty": 0, "fault": None, "notes.txt": 0, "once": 3, "oops": None, "well": 5,
    }  # fmt: skip
    document = _document(out)
    assert document["faults"] == ["die", "fault", "oops"]
    assert document["unreadable"] == ["empty", "notes.txt"]
    faults = {one["name"]: one["fault"] for one in document["submissions"]}
    assert "died twice: it was killed by signal 9; the last it said" in faults["die"]
    assert "it gets dark" in faults["die"]
    assert faults["fault"] == "the moon is in the way"
    assert faults["oops"] == "ZeroDivisionError: oops"
    assert _graded(tmp_path).count("die") == 2
    assert "Traceback" in (out / "submissions" / "oops" / "fault.txt").read_text()
    assert not (out / "submissions" / "oops" / "results.json").exists()
    unread = json.loads((out / "submissions" / "empty" / "results.json").read_text())
    said = f"it holds no step; expected files like steps/{FIRST}."
    assert unread["steps"][0]["messages"] == [f"Nothing was taken from this submission: {said}"]
    assert str(tmp_path) not in json.dumps(unread)
    printed = capsys.readouterr()
    assert "fault: the moon is in the way" in printed.out
    why = {one["name"]: one["not_taken"] for one in document["submissions"]}
    assert why["empty"] == [f"It holds no step; expected files like steps/{FIRST}."]
    assert why["notes.txt"] == [
        f"It is one file; expected a folder with files like steps/{FIRST}, or a zip or tar of it."
    ]
    page = (out / "class.html").read_text()
    notes = {row["submission"]: row["note"] for row in _table(out)}
    for name in ("empty", "notes.txt"):
        assert f"{name}: {why[name][0]}" in printed.out
        assert why[name][0] in page
        assert notes[name] == why[name][0]
    assert "7 of 7" in printed.err


def test_variables_without_a_value_are_a_common_mistake(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Whatever function they are in."""
    inbox, out = tmp_path / "in", tmp_path / "out"
    for name, function in {"ann": "shade", "bob": "mirror"}.items():
        write_entry(inbox, name, f"// points 3\n// unset {function}\n")
    write_entry(inbox, "cem", "// points 9\n")
    assert grade_class(inbox, "--out", out) == 0
    (found,) = _document(out)["mistakes"]
    assert (found["title"], found["submissions"]) == ("a variable is used that was given no value", 2)
    assert "a variable is used that was given no value" in capsys.readouterr().out


def test_a_link_to_another_submission_earns_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Links that lead elsewhere are for instructors."""
    inbox, out, page = tmp_path / "in", tmp_path / "out", tmp_path / "out" / "class.html"
    write_entry(inbox, "alice", "// points 9\n")
    write_entry(inbox, "mallory", "// points 2\n")
    inbox.joinpath("stored").symlink_to(write_entry(tmp_path / "store", "sue", "// points 7\n"))
    assert grade_class(inbox, "--out", out) == 0
    assert _points(out) == {"alice": 9, "mallory": 2, "stored": 7}
    (inbox / "mallory").rename(tmp_path / "aside")
    (inbox / "mallory").symlink_to("alice")
    (inbox / "inside").mkdir()
    (inbox / "inside" / "steps").symlink_to("../alice/steps")
    write_entry(inbox, "file", "")
    (inbox / "file" / "steps" / FIRST).unlink()
    (inbox / "file" / "steps" / FIRST).symlink_to(inbox / "alice" / "steps" / FIRST)
    capsys.readouterr()
    for folder, resume in ((out, ["--resume"]), (tmp_path / "fresh", [])):
        assert grade_class(inbox, "--out", folder, *resume) == 0
        assert _points(folder) == {"alice": 9, "file": 0, "inside": 0, "mallory": 0, "stored": 7}
        assert _document(folder)["unreadable"] == ["mallory"]
        told = capsys.readouterr().out
        assert (
            "mallory: It is a link to the files of another entry of the class, and no submission counts twice." in told
        )
        assert (
            "mallory leads to the same files as alice. Put what was handed in in place of the link; for a team," in told
        )
    assert "mallory leads to the same files as alice." in page.read_text()
    assert (
        "mallory leads to the same files as alice."
        in {row["submission"]: row["note"] for row in _table(out)}["mallory"]
    )
    assert "alice" not in (out / "submissions" / "mallory" / "results.json").read_text()  # her student reads that


def test_lists_are_sorted_as_people_read_them(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Grading itself goes by the names of the entries, which differ in nothing."""
    names = ["Anna", "bob", "Éva", "Fay_Wu", "s2", "s10"]
    roster, out = tmp_path / "roster.csv", tmp_path / "out"
    for name in reversed(names):
        write_entry(tmp_path / "in", name, "// fault" if name in ("s2", "s10") else "// points 1")
    roster.write_text("id,name\nb10,Zed\nB9,Yan\na1,Xi\n")
    assert grade_class(tmp_path / "in", "--out", out, "--roster", roster) == 4
    document, told = _document(out), capsys.readouterr().out
    assert [one["name"] for one in document["submissions"]] == names
    assert document["faults"] == ["s2", "s10"]
    assert [one["id"] for one in document["students_without_submission"]] == ["a1", "B9", "b10"]
    assert [row["submission"] for row in _table(out)][:6] == names
    assert sorted(names, key=told.index) == names
    page = (out / "class.html").read_text()
    assert sorted(names[:4], key=lambda name: page.index(f">{name}<")) == names[:4]


def test_twice_gives_the_same(tmp_path: Path, handed_in: Path) -> None:
    outs = [tmp_path / "one", tmp_path / "two"]
    for out, jobs in zip(outs, (1, 3), strict=True):
        assert grade_class(handed_in, "--out", out, "--jobs", jobs) == 0
    documents = [
        {path.parent.name: json.loads(path.read_text()) for path in out.glob("submissions/*/results.json")}
        for out in outs
    ]
    assert len(documents[0]) == 4
    assert documents[0] != documents[1]
    assert without_times(documents[0]) == without_times(documents[1])
    assert _files(outs[0]) == _files(outs[1])


def test_grading_again_keeps_the_earlier_results(tmp_path: Path, handed_in: Path) -> None:
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out) == 0
    write_entry(handed_in, "s2", "// points 8\n")
    (handed_in / "s4" / "steps" / FIRST).unlink()
    (handed_in / "s4").rename(tmp_path / "elsewhere")
    write_entry(handed_in, "s1", "// fault\n")
    _graded(tmp_path)
    assert grade_class(handed_in, "--out", out) == 4
    assert _graded(tmp_path) == ["s1", "s2", "s3"]
    document = _document(out)
    assert document["changed"] == [
        {"name": "s1", "before": 1, "after": None, "resubmitted": True},
        {"name": "s2", "before": 2, "after": 8, "resubmitted": True},
    ]
    assert document["gone"] == ["s4"]
    assert [run["results"]["graded"] for run in document["runs"]] == [4, 2]
    for result in ("results.json", "report.html"):
        assert not (out / "submissions" / "s1" / result).exists()
    with closing(sqlite3.connect(out / "class.sqlite")) as connection:
        rows = connection.execute("SELECT run, points FROM results WHERE submission = 2 ORDER BY run").fetchall()
    assert rows == [(1, 2), (2, 8)]
    row = next(row for row in _table(out) if row["submission"] == "s2")
    assert (row["points"], row["points_before"]) == ("8", "2")


def test_resume_grades_what_changed(tmp_path: Path, handed_in: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = tmp_path / "out"
    write_entry(handed_in, "s1", "// fault\n")
    assert grade_class(handed_in, "--out", out) == 4
    assert len(_graded(tmp_path)) == 4
    assert grade_class(handed_in, "--out", out, "--resume") == 4
    assert _graded(tmp_path) == ["s1"]
    write_entry(handed_in, "s1", "// points 1\n")
    write_entry(handed_in, "s2", "// points 7\n")
    write_entry(handed_in, "s9", "// points 9\n")
    (handed_in / "s3" / "readme.md").write_text("not a source")
    assert grade_class(handed_in, "--out", out, "--resume") == 0
    assert _graded(tmp_path) == ["s1", "s2", "s9"]
    assert _points(out) == {"s1": 1, "s2": 7, "s3": 3, "s4": 4, "s9": 9}
    assert _document(out)["run"]["reused"] == 2
    assert grade_class(handed_in, "--out", out, "--resume") == 0
    assert _graded(tmp_path) == []
    for words in (
        ["--seed", "2"],
        ["--seed", "2", "--only", "1", "02"],
        ["--limit", "seconds=5"],
        [],
    ):
        assert grade_class(handed_in, "--out", out, "--resume", *words) == 0
        assert len(_graded(tmp_path)) == 5, words
    assert grade_class(handed_in, "--out", out, "--resume", "--feedback", "score") == 0
    assert _graded(tmp_path) == []  # only what is told of it changes
    monkeypatch.setenv("FAKE_KIT", "another")
    assert grade_class(handed_in, "--out", out, "--resume") == 0
    assert len(_graded(tmp_path)) == 5
    assert grade_class(handed_in, "--out", out, "--resume", "--require-sandbox") == 0
    assert len(_graded(tmp_path)) == 5  # none was graded in a strong sandbox
    assert grade_class(handed_in, "--out", out) == 0
    assert len(_graded(tmp_path)) == 5


def test_only_some_steps(tmp_path: Path, handed_in: Path) -> None:
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out, "--only", "1", "03") == 0
    assert [step["id"] for step in _document(out)["steps"]] == ["01-camera-rays", "03-phong-shading"]
    document = json.loads((out / "submissions" / "s1" / "results.json").read_text())
    assert [step["id"] for step in document["steps"]] == ["01-camera-rays", "03-phong-shading"]


def test_old_pictures_go(tmp_path: Path, handed_in: Path) -> None:
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out) == 0
    stale = out / "submissions" / "s1" / "pictures" / "01-camera-rays" / "old-mine.png"
    stale.touch()
    note = stale.with_name("notes.txt")
    note.touch()
    assert grade_class(handed_in, "--out", out, "--resume") == 0
    assert not stale.exists()
    assert note.exists()


def test_roster(tmp_path: Path, handed_in: Path) -> None:
    (handed_in / "s2-second").mkdir()
    write_entry(handed_in, "s2-second", "// points 6\n")
    roster = tmp_path / "roster.csv"
    roster.write_text("id,name,email\ns1,Ann,ann@x.edu\ns2,=Bob(),b@x.edu\ns7,Gil,\n")
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out, "--roster", roster) == 0
    document = _document(out)
    assert document["submissions_without_student"] == ["s3", "s4"]
    assert [student["id"] for student in document["students_without_submission"]] == ["s7"]
    assert [student["id"] for student in document["students_with_several"]] == ["s2"]
    rows = [(row["submission"], row["id"], row["name"], row["status"]) for row in _table(out)]
    assert rows == [
        ("s1", "s1", "Ann", "graded"),
        ("s2", "s2", "'=Bob()", "graded"),
        ("s2-second", "s2", "'=Bob()", "graded"),
        ("s3", "", "", "graded"),
        ("s4", "", "", "graded"),
        ("", "s7", "Gil", "no submission"),
    ]


def test_late_policy(tmp_path: Path, handed_in: Path) -> None:
    for number, when in enumerate((1_000, 101_000, 201_000, 301_000), start=1):
        os.utime(handed_in / f"s{number}" / "steps" / FIRST, (when, when))
    policy = tmp_path / "late.toml"
    policy.write_text("deadline = 2000-01-01T00:00:00Z\npercent_per_day = 10\n[extensions]\ns3 = 2\ns99 = 1\n")
    roster = tmp_path / "roster.csv"
    roster.write_text(
        "id,submitted_at\ns1,\ns2,2000-01-01T12:00:00\ns3,2000-01-02T12:00:00Z\ns4,2000-01-02T12:00:00Z\n"
    )
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out, "--roster", roster, "--late-policy", policy) == 0
    document = _document(out)
    found = {one["name"]: (one["points"], one["final"], one["submitted_from"]) for one in document["submissions"]}
    assert found == {
        "s1": (1, 1, "files"),
        "s2": (2, 1.8, "roster"),
        "s3": (3, 3, "roster"),
        "s4": (4, 3.2, "roster"),
    }
    assert document["unknown_extensions"] == ["s99"]
    assert document["statistics"]["mean"] == 2.25
    assert [row["late_points"] for row in _table(out)] == ["1", "1.8", "3", "3.2"]
    assert "2 days begun, 10 % each, takes 20 % off 4 points: 4 - 0.8 = 3.2" in _table(out)[3]["lateness"]
    # The policy may change without anything being graded again.
    policy.write_text("deadline = 2000-01-01T00:00:00Z\npercent_per_day = 50\n")
    _graded(tmp_path)
    words = ("--roster", roster, "--late-policy", policy, "--resume")
    assert grade_class(handed_in, "--out", out, *words) == 0
    assert _graded(tmp_path) == []
    assert {one["name"]: one["final"] for one in _document(out)["submissions"]} == {"s1": 1, "s2": 1, "s3": 0, "s4": 0}


def test_extensions_by_the_name_of_a_submission(tmp_path: Path, handed_in: Path) -> None:
    for number in range(1, 5):
        os.utime(handed_in / f"s{number}" / "steps" / FIRST, (946_774_800, 946_774_800))
    policy = tmp_path / "late.toml"
    policy.write_text(
        "deadline = 2000-01-01T00:00:00Z\npercent_per_day = 50\n[extensions]\ns1 = 9\ns2 = 9\ns4 = 9\nteam = 9\n"
    )
    (handed_in / "s3").rename(handed_in / "team")
    roster = tmp_path / "roster.csv"
    roster.write_text("id,name,submission\n1,Ann,s1\n2,Bob,s2\n3,Cleo,team\ns2,Dan,s4\n")
    out = tmp_path / "out"
    words = ("--late-policy", policy)
    assert grade_class(handed_in, "--out", out, *words) == 0
    assert {one["name"]: one["final"] for one in _document(out)["submissions"]} == {
        "s1": 1,
        "s2": 2,
        "s4": 4,
        "team": 3,
    }
    assert grade_class(handed_in, "--out", out, "--roster", roster, *words, "--resume") == 0
    found = {one["name"]: one["final"] for one in _document(out)["submissions"]}
    # On the roster, s2 is Dan: Bob does not get Dan's extension by handing in something of that name.
    assert found == {"s1": 1, "s2": 0, "s4": 4, "team": 3}
    assert _document(out)["unknown_extensions"] == []


def test_of_a_team_the_latest_time_counts(tmp_path: Path, handed_in: Path) -> None:
    roster = tmp_path / "roster.csv"
    roster.write_text(
        "id,submission,submitted_at\na,s1,2026-11-20T10:00:00+01:00\nb,s1,2026-11-20T09:30:00Z\n"
        "c,s2,2026-11-20T10:00:00\nd,s2,2026-11-20T10:00:00\ne,s2,\n"
    )
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out, "--roster", roster) == 0
    one, two = _document(out)["submissions"][:2]
    assert one["submitted_at"] == "2026-11-20T09:30:00+00:00"
    assert "different times in the roster (2026-11-20T10:00:00+01:00, 2026-11-20T09:30:00+00:00)" in one["note"]
    assert (two["submitted_at"], two["note"]) == ("2026-11-20T10:00:00+00:00", "")


def test_usage(tmp_path: Path, handed_in: Path) -> None:
    out, graded = tmp_path / "out", tmp_path / "grades"
    (graded / "submissions").mkdir(parents=True)
    for path in (graded / "class.sqlite", tmp_path / "list.csv", tmp_path / "late.toml"):
        path.touch()
    for words, message in (
        ((tmp_path / "missing", "--out", out), "expected a folder"),
        ((handed_in, "--out", handed_in / "out"), "lies in the folder of the submissions"),
        ((handed_in, "--out", handed_in), "lies in the folder of the submissions"),
        ((handed_in, "--out", out, "--jobs", "0"), "--jobs 0"),
        ((handed_in, "--out", out, "--only", "77"), "no step '77'"),
        ((handed_in, "--out", out, "--limit", "patience=1"), "--limit patience=1: expected one of"),
        ((handed_in, "--out", out, "--shard", "3/2"), "such as 2/8"),
        ((handed_in, "--out", out, "--roster", tmp_path / "lst.csv"), "there; expected a CSV .*mean list.csv"),
        ((handed_in, "--out", out, "--late-policy", tmp_path / "lat.toml"), "there; expected a TOML .*mean late.toml"),
        ((graded, "--out", out), "grades: holds the results of a class, since class.sqlite lies there; expected the f"),
        ((graded / "submissions", "--out", out), "submissions: holds the results of a class"),
        ((handed_in, "--out", out, "--scheduler", "head"), "tcp://head:8786"),
        ((handed_in, "--out", out, "--scheduler", "tcp://head:1", "--jobs", "2"), "--jobs is for this machine"),
        (("--out", out), "expected a folder"),
        ((handed_in, "--merge", out, "--out", out), "leave DIR out"),
        ((handed_in, "--out", tmp_path, "--resume"), "to go on from"),
    ):
        with pytest.raises(UsageError, match=message):
            grade_class(*words)
    assert not (out / "class.sqlite").exists()
    inside = tmp_path / "x" / "submissions"
    write_entry(inside, "s1", "")
    with pytest.raises(UsageError, match="would go into the folder of the submissions"):
        grade_class(inside, "--out", tmp_path / "x")


def test_what_this_machine_cannot_read_is_a_fault(tmp_path: Path, handed_in: Path) -> None:
    (handed_in / "s5").symlink_to(tmp_path / "nowhere")
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out) == 4
    assert _document(out)["faults"] == ["s5"]


def test_a_grader_that_hangs_is_given_up_and_not_waited_for_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The class goes on; whoever wants to try again says so by another limit."""
    monkeypatch.setenv("FAKE_LOG", str(tmp_path / "log.txt"))
    write_entry(tmp_path / "in", "ann", "// points 4\n")
    write_entry(tmp_path / "in", "bob", "// hang\n")
    write_entry(tmp_path / "in", "joe", "// points 2\n")
    words = (tmp_path / "in", "--out", tmp_path / "out", "--jobs", 1, "--limit", "submission_seconds=4")
    for options, begun in (((), ["ann", "bob", "joe"]), (("--resume",), [])):
        (tmp_path / "log.txt").write_text("")
        assert grade_class(*words, *options) == 4
        lines = (tmp_path / "log.txt").read_text().splitlines()
        assert [line[6:] for line in lines if line.startswith("begin ")] == begun
        document = json.loads((tmp_path / "out" / "class.json").read_text())
        assert document["faults"] == ["bob"]
        assert "the grader gave up after 8 s; look at the submission by hand" in capsys.readouterr().out
    write_entry(tmp_path / "in", "bob", "// points 1\n")
    assert grade_class(*words, "--resume") == 0


_LATE = "deadline = 2026-11-20T12:00:00+01:00\npercent_per_day = {percent}\n"


def _report(out: Path, name: str) -> tuple[dict[str, Any], str]:
    folder = out / "submissions" / name
    page = (folder / "report.html").read_text(encoding="utf-8")
    return json.loads((folder / "results.json").read_text()), unescape(re.sub(r"<style>.*?</style>|<[^>]*>", "", page))


def test_a_report_says_whose_it_is_how_late_and_what_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    course = tmp_path / "course.toml"
    course.write_text('title = "Graphics 101"\nterm = "Autumn 2026"\nseed = 48213\n')
    monkeypatch.setenv(COURSE_VARIABLE, str(course))
    for name in ("7", "8"):
        write_entry(tmp_path / "in", name, "// points 9")
    roster, policy, out = tmp_path / "roster.csv", tmp_path / "late.toml", tmp_path / "out"
    roster.write_text(
        "id,name,submitted_at\n7,Ann Lee,2026-11-21T13:00:00+01:00\n8,Bob Ray,2026-11-20T11:00:00+01:00\n"
    )
    policy.write_text(_LATE.format(percent=10))
    words = (tmp_path / "in", "--out", out, "--roster", roster)
    assert grade_class(*words, "--late-policy", policy) == 0
    document, page = _report(out, "7")
    assert (document["course"], document["handed_in"]["students"]) == ("Graphics 101, Autumn 2026", ["Ann Lee"])
    for text in ("Graphics 101, Autumn 2026", "Ann Lee", "Submission 7, handed in 2026-11-21 13:00:00+01:00"):
        assert text in page
    assert "Late: 7.2 of 9 points count. Handed in 1 day 1 hour after the deadline" in page
    assert "20 % off 9 points: 9 - 1.8 = 7.2 points." in page
    assert "7.2 after lateness" in page
    document, page = _report(out, "8")
    assert "Handed in on time: 9 points." in page
    assert "Late:" not in page

    log = (tmp_path / "log.txt").read_text()
    policy.write_text(_LATE.format(percent=50))
    assert grade_class(*words, "--late-policy", policy, "--resume") == 0
    assert (tmp_path / "log.txt").read_text() == log  # nothing was graded again
    document, page = _report(out, "7")
    assert document["handed_in"]["late"]["points"] == 0
    assert "Late: 0 of 9 points count." in page
    assert grade_class(*words, "--late-policy", "none", "--resume") == 0
    document, page = _report(out, "7")
    assert document["handed_in"]["late"] is None
    assert "Late:" not in page
    assert "handed in 2026-11-21 13:00:00+01:00" in page


def test_known_mistakes_are_learned_before_anybody_waits_for_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def learn(_grader: FakeGrader, steps: Sequence[str], say: Callable[[str], None]) -> None:
        log(f"learn {' '.join(steps)}")
        say("learning")

    monkeypatch.setattr(FakeGrader, "learn", learn)
    write_entry(tmp_path / "in", "ann", "// points 9")
    assert grade_class(tmp_path / "in", "--out", tmp_path / "out", "--only", "1-2") == 0
    lines = (tmp_path / "log.txt").read_text().splitlines()
    assert lines[:2] == ["learn 01-camera-rays 02-intersection", "begin ann"]


def test_nothing_is_learned_where_nothing_is_to_be_graded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    learned: list[Sequence[str]] = []
    monkeypatch.setattr(FakeGrader, "learn", lambda _grader, steps, _say: learned.append(steps))
    words = (tmp_path / "in", "--out", tmp_path / "out", "--only", "1", "--resume")
    for name in ("ann", "bob", "cy"):
        write_entry(tmp_path / "in", name, "// points 9")
    assert grade_class(*words) == 0
    assert learned == [["01-camera-rays"]]  # once for all of them
    assert grade_class(*words) == 0
    assert len(learned) == 1
    write_entry(tmp_path / "in", "dot", "// points 9")
    assert grade_class(*words) == 0
    assert len(learned) == 2


def _work_for(folder: Path, amount: int, monkeypatch: pytest.MonkeyPatch) -> tuple[int, int]:
    """How often a late policy was read, and how many names of the roster were folded, to write a class."""
    policies, names = [0], [0]

    def parse(*words: Any) -> Any:
        policies[0] += 1
        return parse_late_policy(*words)

    def fold(word: str) -> str:
        names[0] += 1
        return folded(word)

    with monkeypatch.context() as patch:
        patch.setattr(raysteps.classroom.class_document, "parse_late_policy", parse)
        patch.setattr(raysteps.classroom.class_document, "folded", fold)
        for number in range(amount):
            write_entry(folder / "in", f"s{number}", "// points 9")
        lines = [f"s{number},s{number}@example.edu" for number in range(amount)]
        (folder / "roster.csv").write_text("\n".join(["id,email", *lines, ""]))
        (folder / "late.toml").write_text("deadline = 2026-11-20T23:59:00Z\npercent_per_day = 10\n")
        words = ("--roster", folder / "roster.csv", "--late-policy", folder / "late.toml", "--jobs", 1)
        assert grade_class(folder / "in", "--out", folder / "out", *words) == 0
    return policies[0], names[0]


def test_what_a_submission_costs_does_not_grow_with_the_class(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = [_work_for(tmp_path / str(amount), amount, monkeypatch) for amount in (2, 4, 8)]
    assert len({policies for policies, _ in found}) == 1
    few, some, many = (names for _, names in found)
    assert many - some == 2 * (some - few) > 0


def test_no_page_and_nothing_that_is_given_back_tells_the_seed(tmp_path: Path) -> None:
    out, seed = tmp_path / "out", "48213977"
    write_entry(tmp_path / "in", "ann", "// points 9")
    assert grade_class(tmp_path / "in", "--out", out, "--seed", seed) == 0
    for path in [out / "class.html", *(path for path in (out / "submissions").rglob("*") if path.is_file())]:
        assert seed.encode() not in path.read_bytes(), path
    assert json.loads((out / "class.json").read_text())["run"]["settings"]["seed"] == int(seed)
