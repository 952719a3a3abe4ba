"""What people say of submissions and change in their points: it is never lost, and every file tells it."""

import csv
import io
import json
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from class_fakes import grade_class, write_entry

from raysteps.classroom.annotations import annotate, new_annotation
from raysteps.classroom.class_files import write_class
from raysteps.classroom.database import ClassDatabase

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


def _say(out: Path, kind: Any, name: str = "ann", after: str = "", **more: Any) -> str:
    """Does it, makes the files anew, and gives what it is called."""
    with closing(ClassDatabase(out)) as database:
        more = {"text": "because", **more}
        if more.get("line"):
            row = database.current(name)
            assert row is not None
            source = database.sources(row["submission"], row["run"])[more["step"]]
            more |= {"source": source.sha256, "line_text": source.lines[more["line"] - 1]}
        one = new_annotation(kind, "Ada", **more)
        annotate(database, name, one, after=after)
        write_class(database, out)
        return one.uid


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
    _say(grades, "points", step=_STEP, points=6.5, automatic=4, text="the comment explains it")
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
