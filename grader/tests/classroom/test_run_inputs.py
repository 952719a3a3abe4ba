"""A roster and a late policy that were given once are used again, until others or none are given."""

import csv
import json
import os
import shlex
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from class_fakes import FIRST, grade_class, write_entry

import raysteps.cli.grade_class
from raysteps.common.errors import UsageError

pytestmark = pytest.mark.usefixtures("fake_grader")

_AGAIN = "is used again"


class Class:
    """Two submissions, one of them late, and what is said of them."""

    def __init__(self, folder: Path) -> None:
        self.handed_in = folder / "in"
        self.out = folder / "out"
        self.roster = self.handed_in / "roster.csv"
        self.policy = self.handed_in / "late.toml"
        for number in (1, 2):
            write_entry(self.handed_in, f"s{number}", f"// points {number}\n")
        self.roster.write_text(
            "id,name,submission,submitted_at\n11,Ann,s1,2000-01-01T12:00:00\n12,Bob,s2,\n13,Cleo,,\n"
        )
        self.policy.write_text("deadline = 2000-01-01T00:00:00+02:00\npercent_per_day = 10\n")

    def grade(self, *words: str | Path) -> int:
        return grade_class(self.handed_in, "--out", self.out, "--jobs", 1, *words)

    def both(self) -> tuple[str, str, str, str]:
        return ("--roster", str(self.roster), "--late-policy", str(self.policy))

    def table(self) -> list[dict[str, str]]:
        with (self.out / "results.csv").open(encoding="utf-8-sig", newline="") as file:
            return list(csv.DictReader(file))


def _known(table: list[dict[str, str]]) -> list[dict[str, str]]:
    """Without what a run tells of the one before."""
    return [{name: text for name, text in row.items() if name != "points_before"} for row in table]


@pytest.fixture
def course(tmp_path: Path) -> Class:
    return Class(tmp_path)


@pytest.mark.parametrize("how", [[], ["--resume"]])
def test_both_are_used_again(course: Class, capsys: pytest.CaptureFixture[str], how: list[str]) -> None:
    assert course.grade(*course.both()) == 0
    before = course.table()
    assert [row["id"] for row in before] == ["11", "12", "13"]
    assert before[0]["late_points"] == "0.9"
    assert _AGAIN not in capsys.readouterr().err
    for _ in range(2):  # the last run is then one that was not given them either
        assert course.grade(*how) == 0
        after = course.table()  # nor do the two files become submissions
        assert (after if how else _known(after)) == (before if how else _known(before))
        said = capsys.readouterr().err
        assert f"the roster (3 students) of the last run in {course.out} is used again; --roster FILE" in said
        assert f"the late policy of the last run in {course.out} is used again; --late-policy FILE" in said
    assert course.grade(*how, *course.both()) == 0
    with closing(sqlite3.connect(course.out / "class.sqlite")) as connection:
        kept = [json.loads(text) for (text,) in connection.execute("SELECT files FROM given")]
    assert all(sorted(files) == [str(course.policy), str(course.roster)] for files in kept), "each once"


def test_each_can_be_dropped(course: Class, capsys: pytest.CaptureFixture[str]) -> None:
    course.roster = course.roster.rename(course.handed_in.parent / "roster.csv")
    course.policy = course.policy.rename(course.handed_in.parent / "late.toml")
    assert course.grade(*course.both()) == 0
    assert course.grade("--resume", "--late-policy", "none") == 0
    assert [(row["id"], row["late_points"]) for row in course.table()] == [("11", ""), ("12", ""), ("13", "")]
    capsys.readouterr()
    assert course.grade("--resume", "--roster", "none") == 0
    assert [(row["id"], row["submission"]) for row in course.table()] == [("", "s1"), ("", "s2")]
    assert course.grade("--resume") == 0
    assert _AGAIN not in capsys.readouterr().err


def test_another_one_counts(course: Class) -> None:
    assert course.grade(*course.both()) == 0
    course.roster.write_text("id,submission\n21,s1\n")
    assert course.grade("--resume", "--roster", course.roster) == 0
    assert [row["id"] for row in course.table()] == ["21", ""]
    assert "by the time of the file" in course.table()[0]["lateness"]


def test_the_line_to_go_on_drops_them_too(
    course: Class, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def build(*arguments: object, **options: object) -> object:
        raise KeyboardInterrupt

    assert course.grade(*course.both()) == 0
    monkeypatch.setattr(raysteps.cli.grade_class, "make_grader", build)
    monkeypatch.chdir(course.handed_in.parent)
    course.policy.rename("none")
    assert course.grade("--resume", "--roster", "none", "--late-policy", "./none") == 130
    line = capsys.readouterr().out.splitlines()[-1]
    assert "--roster none --late-policy ./none" in " ".join(shlex.split(line))


def test_merged_parts_remember_them(course: Class) -> None:
    parts = [course.out.with_name(f"part{index}") for index in (1, 2)]
    for index, part in enumerate(parts, start=1):
        words = (*course.both(), "--shard", f"{index}/2")
        assert grade_class(course.handed_in, "--out", part, "--jobs", 1, *words) == 0
    assert grade_class("--merge", *parts, "--out", course.out) == 0
    before = course.table()
    assert course.grade("--resume") == 0
    assert course.table() == before


def test_a_database_that_did_not_keep_the_roster(course: Class) -> None:
    assert course.grade(*course.both()) == 0
    with closing(sqlite3.connect(course.out / "class.sqlite")) as connection:
        connection.execute("DROP TABLE given")
        connection.commit()
    with pytest.raises(UsageError, match=r"had a late policy, .* with --late-policy FILE, or drop it"):
        course.grade("--resume", "--roster", course.roster)
    with pytest.raises(UsageError, match=r"had a roster, .* with --roster FILE, or drop it with --roster none"):
        course.grade("--resume", "--late-policy", course.policy)
    assert course.grade("--resume", *course.both()) == 0
    assert course.table()[0]["late_points"] == "0.9"


def test_what_the_summary_says_of_lateness(course: Class, capsys: pytest.CaptureFixture[str]) -> None:
    (course.handed_in / "s3.txt").write_text("no archive")
    assert course.grade(*course.both()) == 0
    row = course.table()[0]
    assert row["submitted_at"] == "2000-01-01T12:00:00+02:00"
    printed = capsys.readouterr().out
    assert "Late by the time of the file, where the roster has no submitted_at\n  s2: 20" in printed
    assert "s1: 2000" not in printed
    assert "2 submissions graded: mean 0.45, median 0.45 points after lateness, of 100, with up to 20" in printed
    assert "more as a bonus; without the 1 that could not be read" in printed
    assert "final" in printed
    assert "by the time of the file" in course.table()[1]["lateness"]
    assert all(row["submitted_at"].endswith(("+00:00", "+02:00")) for row in course.table() if row["submission"])


def test_no_columns_for_lateness_where_nobody_is_late(course: Class, capsys: pytest.CaptureFixture[str]) -> None:
    course.roster.write_text("id,submission,submitted_at\n11,s1,1999-12-31T12:00:00\n12,s2,1999-12-31T12:00:00\n")
    for number in (1, 2):
        os.utime(course.handed_in / f"s{number}" / "steps" / FIRST, (1_000, 1_000))
    assert course.grade(*course.both()) == 0
    printed = capsys.readouterr().out
    assert "Nobody was late" in printed
    assert "final" not in printed
    assert "days" not in printed
