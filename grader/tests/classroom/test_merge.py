"""What merging does with shards that do not agree, and in which order runs count."""

import csv
import io
import json
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from class_fakes import grade_class, write_entry

from raysteps.classroom.database import ClassDatabase, open_readonly
from raysteps.classroom.entries import Shard
from raysteps.common.errors import UsageError
from raysteps.course.settings import COURSE_VARIABLE

pytestmark = pytest.mark.usefixtures("fake_grader")

_FIRST, _SECOND = ([f"s{number}" for number in range(8) if Shard(index, 2).holds(f"s{number}")] for index in (1, 2))


@pytest.fixture
def handed_in(tmp_path: Path) -> Path:
    for number in range(8):
        write_entry(tmp_path / "in", f"s{number}", f"// points {number}\n")
    return tmp_path / "in"


def _grade(tmp_path: Path, index: int, *words: str | Path) -> Path:
    out = tmp_path / f"shard{index}"
    assert grade_class(tmp_path / "in", "--out", out, "--shard", f"{index}/2", "--resume", *words) == 0
    return out


def _document(out: Path) -> dict[str, Any]:
    document: dict[str, Any] = json.loads((out / "class.json").read_text())
    return document


def _whose(out: Path) -> dict[str, list[str]]:
    return {one["name"]: [who["id"] for who in one["students"]] for one in _document(out)["submissions"]}


def _roster(tmp_path: Path, first: str, second: str) -> Path:
    path = tmp_path / "roster.csv"
    path.write_text(f"id,name,submission\n1,Ann,{first}\n2,Bob,{second}\n")
    return path


def test_the_last_roster_counts_and_what_was_deleted_is_gone(tmp_path: Path, handed_in: Path) -> None:
    one, two, merged = _FIRST[0], _SECOND[0], tmp_path / "merged"
    roster = _roster(tmp_path, one, two)
    shards = [_grade(tmp_path, index, "--roster", roster) for index in (1, 2)]
    assert grade_class("--merge", *shards, "--out", merged) == 0
    assert (_whose(merged)[one], _whose(merged)[two]) == (["1"], ["2"])
    _roster(tmp_path, two, one)
    deleted = _FIRST[1]
    (handed_in / deleted).rename(tmp_path / "elsewhere")
    shards = [_grade(tmp_path, index, "--roster", roster) for index in (1, 2)]
    assert grade_class("--merge", *shards, "--out", merged) == 0
    assert (_whose(merged)[one], _whose(merged)[two]) == (["2"], ["1"])
    assert _document(merged)["gone"] == [deleted]
    assert deleted not in _whose(merged)
    rows = list(csv.DictReader(io.StringIO((merged / "results.csv").read_text("utf-8-sig"), newline="")))
    assert [(row["submission"], row["name"]) for row in rows if row["name"]] == sorted([(one, "Bob"), (two, "Ann")])


def test_an_older_shard_that_comes_later_changes_nobody(
    tmp_path: Path, handed_in: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one, two, merged = _FIRST[0], _SECOND[0], tmp_path / "merged"
    older = _grade(tmp_path, 1, "--roster", _roster(tmp_path, one, two))
    (handed_in / _FIRST[1]).rename(tmp_path / "elsewhere")
    newer = _grade(tmp_path, 2, "--roster", _roster(tmp_path, two, one))
    assert grade_class("--merge", newer, "--out", merged) == 4
    assert grade_class("--merge", older, "--out", merged) == 0
    assert (_whose(merged)[one], _whose(merged)[two]) == (["2"], ["1"])
    assert _document(merged)["gone"] == []  # the last shard never saw it, and says nothing of it
    capsys.readouterr()
    again = tmp_path / "again"
    assert grade_class("--merge", newer, older, "--out", again) == 0
    assert _whose(again) == _whose(merged)
    said = capsys.readouterr().out
    assert f"Warning: {older}: had other rosters than {newer}, which began last" in said
    assert f"Warning: {older}: had other submissions than {newer}" in said
    assert "other kits" not in said


@pytest.mark.parametrize("swapped", [False, True])
def test_the_late_policy_is_that_of_the_run_that_began_last(
    tmp_path: Path, handed_in: Path, swapped: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    policies = []
    for percent in (10, 50):
        policy = tmp_path / f"late{percent}.toml"
        policy.write_text(f"deadline = 2000-01-01T00:00:00Z\npercent_per_day = {percent}\n")
        policies.append(policy)
    shards = [_grade(tmp_path, index, "--late-policy", policies[index - 1]) for index in (1, 2)]
    with closing(sqlite3.connect(shards[0] / "class.sqlite")) as connection:
        (began,) = connection.execute("SELECT started_at FROM runs").fetchone()
    assert "." in began, "runs of several machines begin in the same second"
    merged = tmp_path / "merged"
    order = list(reversed(shards)) if swapped else shards
    for shard in order:  # one at a time
        grade_class("--merge", shard, "--out", merged)
    document = _document(merged)
    assert document["late_policy"] == policies[1].read_text()
    assert [run["shard"] for run in document["runs"]] == ["1/2", "2/2"]
    assert [run["number"] for run in document["runs"]] == [1, 2]
    runs = {one["name"]: one["run"] for one in document["submissions"]}
    assert runs == {**dict.fromkeys(_FIRST, 1), **dict.fromkeys(_SECOND, 2)}
    with closing(sqlite3.connect(merged / "class.sqlite")) as connection:
        assert connection.execute("PRAGMA foreign_key_check").fetchall() == []
        assert connection.execute("SELECT count(DISTINCT run) FROM pictures").fetchone() == (2,)
    capsys.readouterr()
    assert grade_class("--merge", *order, "--out", tmp_path / "both") == 0
    assert f"{shards[0]}: had other late policies than {shards[1]}" in capsys.readouterr().out


def test_what_changed_is_told_of_all_shards(tmp_path: Path, handed_in: Path) -> None:
    shards = [_grade(tmp_path, index) for index in (1, 2)]
    for name in (_FIRST[0], _SECOND[0]):
        write_entry(handed_in, name, "// points 9\n")
    shards = [_grade(tmp_path, index) for index in (1, 2)]
    assert grade_class("--merge", *shards, "--out", tmp_path / "merged") == 0
    document = _document(tmp_path / "merged")
    assert [one["name"] for one in document["changed"]] == sorted([_FIRST[0], _SECOND[0]])
    assert document["outdated"] == []


@pytest.mark.parametrize(
    "words",
    [
        ["--roster", "r.csv"], ["--late-policy", "l.toml"], ["--jobs", "2"], ["--resume"], ["--only", "1"],
        ["--seed", "2"], ["--feedback", "score"], ["--limit", "seconds=2"], ["--require-sandbox"],
        ["--scheduler", "tcp://a:1"], ["--shard", "1/2"],
    ],
)  # fmt: skip
def test_no_option_is_ignored_without_a_word(tmp_path: Path, words: list[str]) -> None:
    with pytest.raises(UsageError, match=f"{words[0]} is for the shards"):
        grade_class("--out", tmp_path / "merged", *words, "--merge", tmp_path / "a")
    assert not (tmp_path / "merged").exists()


def test_shards_of_other_courses_are_told(
    tmp_path: Path, handed_in: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shards = []
    monkeypatch.setenv(COURSE_VARIABLE, str(tmp_path / "course.toml"))
    for index, title in ((1, "Optics"), (2, "Graphics")):
        (tmp_path / "course.toml").write_text(f'title = "{title}"')
        shards.append(_grade(tmp_path, index))
    assert grade_class("--merge", *shards, "--out", tmp_path / "both") == 0
    assert f"{shards[0]}: had other courses than {shards[1]}" in capsys.readouterr().out
    assert _document(tmp_path / "both")["course"] == "Graphics"


def test_shards_are_read_as_they_were_at_one_moment(tmp_path: Path, handed_in: Path) -> None:
    shard = _grade(tmp_path, 1)
    with open_readonly(shard / "class.sqlite") as connection:
        query = "SELECT count(*) FROM submissions"
        (before,) = connection.execute(query).fetchone()
        with closing(ClassDatabase(shard)) as database:
            database.connection.execute("DELETE FROM handed_in")
            database.connection.execute("INSERT INTO submissions (name, entry, scope) VALUES ('x', 'x', 'here')")
        assert connection.execute(query).fetchone()[0] == before
        with pytest.raises(sqlite3.OperationalError, match="readonly"):
            connection.execute("DELETE FROM submissions")


def test_what_cannot_be_merged_stays_untouched(tmp_path: Path, handed_in: Path) -> None:
    empty = tmp_path / "empty"
    empty.mkdir()
    (empty / "class.sqlite").touch()
    with pytest.raises(UsageError, match="nothing has been graded there"):
        grade_class("--merge", empty, "--out", tmp_path / "merged")
    assert (empty / "class.sqlite").read_bytes() == b""
    with closing(ClassDatabase(tmp_path)):
        pass
    with pytest.raises(UsageError, match="in any of these folders"):
        grade_class("--merge", tmp_path, "--out", tmp_path / "merged")
