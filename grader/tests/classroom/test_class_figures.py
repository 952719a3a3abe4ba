"""Figures of a class, who needs a look, and where the page comes from."""

import io
import json
import shutil
import sqlite3
import time
from pathlib import Path
from typing import Any

import pytest
from class_documents import STEPS, document, missing, result, student, submission
from class_fakes import grade_class, write_entry
from rich.console import Console

from raysteps.classroom.class_document import class_document
from raysteps.classroom.class_files import class_source, remake_class_page
from raysteps.classroom.database import ClassDatabase, open_readonly
from raysteps.classroom.summary import ProgressMeter, print_summary
from raysteps.common.documents import convert, plain
from raysteps.common.errors import UsageError
from raysteps.report.class_overview import (
    common_mistakes,
    divided,
    groups,
    histogram,
    marks,
    marks_of,
    share_bars,
    span,
    step_figures,
    times,
    total_bars,
)
from raysteps.report.class_page import aliases, class_page, table_rows
from raysteps.results.class_model import ClassResults

_FIRST, _SECOND = STEPS[0]["id"], STEPS[1]["id"]
_LATE = {"days": 1, "percent": 10, "points": 9, "deadline": "d", "words": "w"}


def test_the_figures_of_a_step_leave_out_what_was_not_graded() -> None:
    facts = document(
        [
            submission("ann", {_FIRST: result(10, 10)}),
            submission("bob", {_FIRST: result(4, 10)}),
            submission("cid", {_FIRST: result(1, 10)}),
            missing("dot", "unreadable", points=0, final=0),
            missing("eve", "fault", fault="oops"),
        ]
    )
    first, second = step_figures(facts)[:2]
    assert (first.mean, first.median, first.passed, first.graded) == (5, 4, 1, 3)
    assert (second.mean, second.median, second.graded) == (None, None, 0)


def test_every_total_falls_into_one_column() -> None:
    bars = total_bars([0, 9.99, 10, 55, 119.5, 120], 120)
    assert {bar.words: bar.count for bar in bars if bar.count} == {
        "0 to under 10": 2,
        "10 to under 20": 1,
        "50 to under 60": 1,
        "110 to 120": 2,
    }
    assert sum(bar.count for bar in total_bars([250.0], 120)) == 1


def test_none_and_all_of_the_points_have_columns_of_their_own() -> None:
    assert [bar.count for bar in share_bars([0, 0.1, 2.5, 2.6, 9.9, 10, 10], 10)] == [1, 2, 1, 0, 1, 2]


def test_a_histogram_is_told_in_words_and_stays_within_its_drawing() -> None:
    drawing = histogram(total_bars([3, 3, 95], 100), 640, 200, "points")
    assert drawing.words == "0 to under 10: 2 submissions; 90 to 100: 1 submission"
    assert all(column.x >= 0 and column.x + column.width <= 640 for column in drawing.columns)
    assert max(column.height for column in drawing.columns) <= drawing.floor
    assert histogram(total_bars([], 100), 640, 200, "points").words == "nothing to show"


def test_every_column_of_a_histogram_says_what_it_is_of() -> None:
    bars = total_bars([3, 3, 95], 100)
    assert [(bar.label, bar.end) for bar in bars[:2]] == [("0", "10"), ("10", "20")]
    assert all(bar.label for bar in share_bars([0, 5, 10], 10))
    page = class_page(document([submission("ann", {_FIRST: result(10, 10)})]), lambda name: None)
    assert 'class="axis">points in all</text>' in page
    assert 'class="axis">how much of the points</text>' in page
    assert "How many of the 1 graded submissions have how many points" in page


def test_a_divided_bar_is_filled_to_its_end() -> None:
    parts = divided([("passed", 3), ("failed", 0), ("crashed", 1)], 240)
    assert [(part.status, part.x, part.width) for part in parts] == [("passed", 0, 180), ("crashed", 180, 60)]


def test_the_slowest_come_first() -> None:
    facts = document([submission("ann", seconds=3.0), submission("bob", seconds=9.0), missing("cid", "not-graded")])
    known = times(facts)
    assert known is not None
    assert (known.total, known.mean, list(known.slowest)) == (12, 6, [(1, 9.0), (0, 3.0)])
    assert times(document([missing("cid", "not-graded")])) is None


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.25, "0.2 s"), (99.4, "99.4 s"), (133, "2 min 13 s"), (3599.7, "1 h 0 min"), (11_100, "3 h 5 min")],
)
def test_times_are_told_as_people_say_them(seconds: float, words: str) -> None:
    assert span(seconds) == words


def test_common_mistakes_know_who_made_them() -> None:
    unit, root = "the normal is not of unit length", "the root behind the eye is taken"
    facts = document(
        [
            submission("ann", mistakes={_SECOND: [unit]}),
            submission("bob"),
            submission("cid", mistakes={_SECOND: [root, unit]}),
        ]
    )
    found = [(one.step, one.title, one.submissions, list(one.rows)) for one in common_mistakes(facts)]
    assert found == [(_SECOND, unit, 2, [0, 2]), (_SECOND, root, 1, [2])]


def test_a_class_of_an_older_kit_tells_how_many_made_a_mistake_but_not_who() -> None:
    told: Any = plain(document([submission("ann", mistakes={_SECOND: ["too bright"]})]))
    del told["submissions"][0]["mistakes"], told["submissions"][0]["seconds"]
    told["inconsistent"], told["submissions"][0]["inconsistent"] = ["ann"], {_SECOND: ["It says that it is right."]}
    facts = convert(told, ClassResults, complete=True)
    assert [(one.submissions, list(one.rows)) for one in common_mistakes(facts)] == [(1, [])]
    assert "too bright" in class_page(facts, lambda name: None)


def test_what_could_not_be_read_is_no_step_that_nobody_began() -> None:
    steps = {_FIRST: result(0, 10, "not-started"), _SECOND: result(0, 10, "not-started")}
    facts = document(
        [
            submission("ann", steps=steps, not_taken=[f"{_FIRST}: camera_rays.cpp is a folder, not a file."]),
            missing("bob", "unreadable", points=0, final=0, steps=steps, not_taken=["It is a RAR archive."]),
        ]
    )
    ann, bob = table_rows(facts, {}, lambda name: None)
    assert [cell.words for cell in ann.cells if cell is not None] == ["not taken", "not started"]
    assert [cell.words for cell in bob.cells if cell is not None] == ["not taken", "not taken"]
    assert [cell.status for cell in ann.cells if cell is not None] == ["not-taken", "not-started"]
    counted = [dict(figures.statuses) for figures in step_figures(facts)[:2]]
    assert counted == [{"not-taken": 1}, {"not-started": 1}]
    page = class_page(facts, lambda name: None)
    for status, sign in (("not-taken", "N"), ("not-started", "\u2013")):
        assert f'<td class="{status}">' in page
        assert f'.class-table .{status}::after {{ content: " {sign}"' in page
    assert '<span class="sign not-taken"></span> not taken' in page
    console = Console(file=(text := io.StringIO()), width=200, color_system=None)
    print_summary(console, facts, Path("out"))
    assert "- not started, n not taken" in text.getvalue()


def test_what_needs_a_look_stands_apart_and_is_marked_in_the_table() -> None:
    facts = document(
        [
            submission("ann"),
            missing("bob", "unreadable", points=0, final=0, not_taken=["It is a RAR archive."]),
            missing("cid", "fault", fault="the moon\nis in the way"),
            submission("cud", not_taken=[f"{_FIRST}: camera_rays.cpp is larger than 1 MB and was not taken."]),
            submission("dot", late=_LATE, submitted_from="files", submitted_at="2026-11-21T01:00:00+00:00"),
        ],
        students_without_submission=[{**student("Eve", "5"), "note": ""}],
        gone=["fay"],
    )
    found = {group.heading: [(item.who, list(item.words)) for item in group.items] for group in groups(facts)}
    assert found == {
        "Faults of the grader": [("cid", ["the moon"])],
        "Nothing could be read of these": [("bob", ["It is a RAR archive."])],
        "Files that could not be read": [
            ("cud", [f"{_FIRST}: camera_rays.cpp is larger than 1 MB and was not taken."])
        ],
        "Late by the time of the file": [("dot", ["2026-11-21T01:00:00+00:00, 1 day begun"])],
        "On the roster, but without a submission": [("5 Eve", [])],
        "Graded earlier, but no longer in the folder": [("fay", [])],
    }
    assert marks(groups(facts)) == {
        1: ["unreadable"],
        2: ["fault"],
        3: ["file not read"],
        4: ["late by file time"],
    }


def test_the_marks_of_one_are_those_that_it_has_in_the_class() -> None:
    open_ = {"requests": 1, "open_requests": 1, "comments": 0, "read": False}
    again = {"automatic": 5, "changes": ["c"], "look_again": ["l"], **open_}
    facts = document(
        [
            submission("ann", students=[student("Ann Lee", "4711")]),
            missing("bob", "unreadable", points=0, final=0, not_taken=["It is a RAR archive."]),
            missing("cid", "fault", fault="the moon"),
            submission("cud", not_taken=[f"{_FIRST}: camera_rays.cpp is a folder, not a file."], outdated=True),
            submission("dot", submitted_from="files", late={**_LATE, "days": 1}),
            submission("eve", submitted_from="files", late={**_LATE, "days": 0}),
            submission("fay", submitted_from="roster", late={**_LATE, "days": 1}),
            submission("gus", review=again),
            missing("hal", "not-graded"),
        ],
        submissions_without_student=["bob", "cid", "cud", "dot", "eve", "fay", "gus", "hal"],
        outdated=["cud"],
    )
    in_class = marks(groups(facts))
    assert [marks_of(one, has_roster=True) for one in facts.submissions] == [in_class.get(row, []) for row in range(9)]
    assert marks_of(facts.submissions[5], has_roster=False) == []


def test_an_alias_stays_the_same_when_the_order_of_the_class_changes() -> None:
    names = ["ann", "bob", "cid", "dot"]
    first = dict(zip(names, aliases(names), strict=True))
    assert dict(zip(reversed(names), aliases(names[::-1]), strict=True)) == first
    assert sorted(first.values()) == ["student 1", "student 2", "student 3", "student 4"]


def test_a_row_shows_the_student_and_is_found_by_everything_that_names_him() -> None:
    facts = document([submission("x17", students=[student("Ann Lee", "4711", "Ann@example.edu")]), submission("bob")])
    ann, bob = table_rows(facts, {}, lambda name: None)
    assert (ann.who, ann.more, ann.words) == ("Ann Lee", "4711 · x17", "x17 x17.zip 4711 ann lee ann@example.edu")
    assert (bob.who, bob.more) == ("bob", "")


@pytest.mark.parametrize("submissions", [[], [missing("ann", "not-graded")]])
def test_a_class_without_a_single_grade_has_a_page(submissions: list[dict[str, object]]) -> None:
    assert "Nothing graded yet" in class_page(document(submissions), lambda name: None)


def test_a_graded_class_has_a_page_that_links_to_what_is_there_and_can_be_made_anew(
    tmp_path: Path, fake_grader: None
) -> None:
    write_entry(tmp_path / "in", "ann & co", "// points 7\n")
    write_entry(tmp_path / "in", "bob", "// fault\n")
    out = tmp_path / "grades"
    assert grade_class(tmp_path / "in", "--out", out) == 4
    page = (out / "class.html").read_text("utf-8")
    name = json.loads((out / "class.json").read_text())["submissions"][0]["name"]
    assert f'href="submissions/{name}/' in page
    assert 'href="submissions/bob/fault.txt"' in page
    (out / "class.html").unlink()
    for source in (out, out / "class.json"):
        found = class_source(source)
        assert found is not None
        assert remake_class_page(found) == out / "class.html"
        assert (out / "class.html").read_text("utf-8") == page
    alone = tmp_path / "alone"
    alone.mkdir()
    shutil.copy(out / "class.json", alone)
    assert class_source(alone) == alone / "class.json"
    (alone / "class.json").write_text('{"schema": "raysteps/class/v1"}')
    with pytest.raises(UsageError, match=r"class.json: is not a class.json of this kit"):
        remake_class_page(alone / "class.json")
    assert class_source(tmp_path / "in") is None


@pytest.mark.parametrize(
    "change",
    [
        "UPDATE runs SET steps = '[1]'",
        "UPDATE runs SET steps = 'no list'",
        "UPDATE runs SET steps = '[{\"more\": 1}]'",
        "UPDATE runs SET settings = '{\"more\": 1}'",
        "UPDATE runs SET shard = 'q'",
        "UPDATE results SET status = 'great'",
    ],
)
def test_a_database_with_what_no_run_wrote_is_told(tmp_path: Path, fake_grader: None, change: str) -> None:
    out = _graded_once(tmp_path)
    with sqlite3.connect(out / "class.sqlite") as connection:
        connection.execute("PRAGMA ignore_check_constraints = ON")
        assert connection.execute(change).rowcount > 0
    with pytest.raises(UsageError, match="cannot be read as the database of a class: "):
        remake_class_page(out / "class.sqlite")


@pytest.mark.parametrize("told", ["'{}'", "x'00ff'"])
def test_results_of_another_form_are_named(tmp_path: Path, fake_grader: None, told: str) -> None:
    out = _graded_once(tmp_path)
    with sqlite3.connect(out / "class.sqlite") as connection:
        assert connection.execute(f"UPDATE results SET document = {told}").rowcount == 1
    with open_readonly(out / "class.sqlite") as connection:
        (one,) = class_document(ClassDatabase(out, connection)).submissions
    assert (one.note, one.results) == ("graded by a kit of another form; grade it again", None)


def _graded_once(folder: Path) -> Path:
    write_entry(folder / "in", "ann", "// points 7\n")
    assert grade_class(folder / "in", "--out", folder / "grades") == 0
    return folder / "grades"


def test_the_time_left_is_said_once_it_was_measured(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two at once take 10 s each, after 500 s in which the kit and its known mistakes are made."""
    monkeypatch.setattr(time, "monotonic", lambda: 0.0)
    meter = ProgressMeter(Console(), 7, 2)
    for clock, name in ((510.0, "ann"), (510.5, "bob"), (520.0, "cy"), (520.5, "dan"), (530.0, "eve"), (530.5, "flo")):
        monkeypatch.setattr(time, "monotonic", lambda clock=clock: clock)
        meter.count(name, "0 of 100 points")
    said = [line.partition("points")[2] for line in capsys.readouterr().err.splitlines()]
    assert said == ["", "", "; about 40 s left", "; about 16 s left", "; about 13 s left", "; about 5 s left"]
