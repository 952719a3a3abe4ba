"""What a student handed in before, and what is no doing of the student's."""

import json
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from class_fakes import FIRST, grade_class, write_entry

from raysteps.classroom.entries import Shard
from raysteps.report.attempts import history_of, history_words
from raysteps.results.model import Comment, EarlierStep, EarlierSubmission, PointsOverride, Results, Review, StepResult

pytestmark = pytest.mark.usefixtures("fake_grader")


def _hand_in(tmp_path: Path, name: str, points: int, at: str) -> None:
    write_entry(tmp_path / "in", name, f"// points {points}\n")
    (tmp_path / "roster.csv").write_text(f"id,submission,submitted_at\n1,{name},{at}\n")


def _grade(tmp_path: Path, *words: str | Path | int) -> int:
    return grade_class(tmp_path / "in", "--out", tmp_path / "out", "--roster", tmp_path / "roster.csv", *words)


def _results(out: Path, name: str) -> dict[str, Any]:
    document: dict[str, Any] = json.loads((out / "submissions" / name / "results.json").read_text())
    return document


def _class(out: Path) -> dict[str, Any]:
    document: dict[str, Any] = json.loads((out / "class.json").read_text())
    return document


def _times(out: Path, name: str) -> list[tuple[str, float]]:
    return [(one["submitted_at"], one["points"]) for one in _results(out, name)["earlier"]]


_FIRST_TIME, _SECOND, _THIRD = (f"2026-11-0{day}T10:00:00+00:00" for day in (1, 2, 3))


def test_what_was_handed_in_before_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "out"
    for points, when in ((4, _FIRST_TIME), (7, _SECOND), (5, _THIRD)):
        _hand_in(tmp_path, "ann", points, when)
        assert _grade(tmp_path, "--resume") == 0
    assert _times(out, "ann") == [(_FIRST_TIME, 4), (_SECOND, 7)]
    steps = _results(out, "ann")["earlier"][1]["steps"]
    assert steps["01-camera-rays"] == {"points": 7, "status": "partial"}
    page = (out / "submissions" / "ann" / "report.html").read_text()
    told = "You have handed in 3 times: 4 points (2026-11-01 10:00), then 7 points (2026-11-02 10:00), and 5 now."
    assert told in page
    assert "Worse than the last time: 01 Camera rays from 7 to 5." in page
    assert "grading itself" not in page
    [one] = _class(out)["submissions"]
    assert (one["before"]["resubmitted"], one["before"]["points"]) == (True, 7)
    assert [earlier["points"] for earlier in one["earlier"]] == [4, 7]
    assert "ann: 7 before, 5 now; handed in again" in capsys.readouterr().out
    assert '<td class="late">\N{MINUS SIGN}2</td>' in (out / "class.html").read_text()


def test_how_often_stays_true_when_the_first_ones_are_told_no_more(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("raysteps.classroom.resubmissions._MAX", 2)
    for points in range(1, 6):
        _hand_in(tmp_path, "ann", points, f"2026-11-0{points}T10:00:00+00:00")
        _grade(tmp_path, "--resume")
    earlier = _results(tmp_path / "out", "ann")["earlier"]
    assert [(one["points"], one["number"]) for one in earlier] == [(3, 3), (4, 4)]
    page = (tmp_path / "out" / "submissions" / "ann" / "report.html").read_text()
    assert "You have handed in 5 times, most recently: 3 points (2026-11-03 10:00), then 4 points" in page


def test_another_kit_or_seed_is_no_resubmission(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    _hand_in(tmp_path, "ann", 4, _FIRST_TIME)
    _grade(tmp_path)
    _grade(tmp_path, "--seed", 9, "--resume")
    monkeypatch.setenv("FAKE_KIT", "another")
    _grade(tmp_path, "--resume", "--only", "02")
    assert _results(out, "ann")["earlier"] == []
    assert "What you handed in before" not in (out / "submissions" / "ann" / "report.html").read_text()
    assert _class(out)["submissions"][0]["before"]["resubmitted"] is False
    assert "ann: 4 before, 0 now; the same submission, with another kit, seed or option" in capsys.readouterr().out
    assert ">again" not in (out / "class.html").read_text()


def test_a_change_of_both_is_not_all_the_students_doing(tmp_path: Path) -> None:
    out = tmp_path / "out"
    _hand_in(tmp_path, "ann", 4, _FIRST_TIME)
    _grade(tmp_path)
    _hand_in(tmp_path, "ann", 7, _SECOND)
    _grade(tmp_path, "--seed", 73291)
    assert [one["same_grading"] for one in _results(out, "ann")["earlier"]] == [False]
    page = (out / "submissions" / "ann" / "report.html").read_text()
    assert "The grading itself was changed in between" in page
    assert "73291" not in (out / "submissions" / "ann" / "results.json").read_text() + page


def test_of_each_submission_its_last_grading_counts(tmp_path: Path) -> None:
    """So that it is held against the present one by the same rules, where there are such."""
    _hand_in(tmp_path, "ann", 4, _FIRST_TIME)
    _grade(tmp_path)
    _grade(tmp_path, "--seed", 9)
    _hand_in(tmp_path, "ann", 7, _SECOND)
    _grade(tmp_path, "--seed", 9, "--feedback", "score")
    [earlier] = _results(tmp_path / "out", "ann")["earlier"]
    assert earlier["same_grading"]


def test_nothing_changes_when_nothing_was_to_be_graded(tmp_path: Path) -> None:
    out = tmp_path / "out"
    for points, when in ((4, _FIRST_TIME), (7, _SECOND)):
        _hand_in(tmp_path, "ann", points, when)
        _grade(tmp_path)
    before = (out / "submissions" / "ann" / "results.json").read_bytes()
    _grade(tmp_path, "--resume")
    assert (out / "submissions" / "ann" / "results.json").read_bytes() == before
    assert len(_class(out)["submissions"][0]["earlier"]) == 1


def test_a_fault_in_between_is_nothing_that_was_handed_in(tmp_path: Path) -> None:
    _hand_in(tmp_path, "ann", 4, _FIRST_TIME)
    _grade(tmp_path)
    (tmp_path / "in" / "ann" / "steps" / FIRST).write_text("// fault\n")
    _grade(tmp_path)
    _hand_in(tmp_path, "ann", 7, _SECOND)
    _grade(tmp_path)
    assert _times(tmp_path / "out", "ann") == [(_FIRST_TIME, 4)]


@pytest.mark.parametrize(
    ("first", "second", "same"),
    [
        ("leeann_4711_815_steps", "leeann_LATE_4711_930_steps-1", True),
        ("leeann_4711_815_steps", "leeann_4712_930_steps", False),
        ("Ann Lee_88_assignsubmission_file", "Ann Lee_89_assignsubmission_file", False),
    ],
)
def test_a_platform_gives_each_upload_another_name(tmp_path: Path, first: str, second: str, same: bool) -> None:
    _hand_in(tmp_path, first, 4, _FIRST_TIME)
    _grade(tmp_path)
    shutil.rmtree(tmp_path / "in" / first)
    _hand_in(tmp_path, second, 7, _SECOND)
    _grade(tmp_path, "--resume")
    name = second.replace(" ", "_")
    assert _times(tmp_path / "out", name) == ([(_FIRST_TIME, 4)] if same else [])


def test_two_submissions_at_a_time_are_two(tmp_path: Path) -> None:
    for name in ("leeann_4711_815_steps", "leeann_4711_930_steps"):
        _hand_in(tmp_path, name, 4, _FIRST_TIME)
    _grade(tmp_path)
    _hand_in(tmp_path, "leeann_4711_930_steps", 7, _SECOND)
    _grade(tmp_path)
    assert [len(one["earlier"]) for one in _class(tmp_path / "out")["submissions"]] == [0, 1]


def test_shards_bring_it_along(tmp_path: Path) -> None:
    names = [f"s{number}" for number in range(4)]
    shards = [tmp_path / f"shard{index}" for index in (1, 2)]
    for points in (4, 7):
        for name in names:
            write_entry(tmp_path / "in", name, f"// points {points}\n")
        for index in (2, 1):
            words = ("--out", shards[index - 1], "--shard", f"{index}/2", "--resume")
            assert grade_class(tmp_path / "in", *words) == 0
    first = next(index for index in (0, 1) if any(Shard(index + 1, 2).holds(name) for name in names))
    grade_class("--merge", shards[first], "--out", tmp_path / "merged")
    grade_class("--merge", *shards, "--out", tmp_path / "merged")
    grade_class("--merge", *shards, "--out", tmp_path / "merged")
    for one in _class(tmp_path / "merged")["submissions"]:
        assert [earlier["points"] for earlier in one["earlier"]] == [4], one["name"]
        assert one["before"]["resubmitted"] is True


def test_a_database_of_an_earlier_kit_tells_nothing_of_before(tmp_path: Path) -> None:
    out = tmp_path / "out"
    _hand_in(tmp_path, "ann", 4, _FIRST_TIME)
    _grade(tmp_path)
    with closing(sqlite3.connect(out / "class.sqlite")) as database:
        database.execute("DROP TABLE arrivals")
    _hand_in(tmp_path, "ann", 7, _SECOND)
    _grade(tmp_path, "--resume")
    assert _results(out, "ann")["earlier"] == []
    assert _class(out)["submissions"][0]["before"] == {
        "run": 1, "status": "graded", "points": 4, "resubmitted": None,
    }  # fmt: skip
    _hand_in(tmp_path, "ann", 8, _THIRD)
    _grade(tmp_path, "--resume")
    assert _times(out, "ann") == [(_SECOND, 7)]


def test_a_result_that_still_holds_is_known_from_then_on(tmp_path: Path) -> None:
    out = tmp_path / "out"
    _hand_in(tmp_path, "ann", 4, _FIRST_TIME)
    _grade(tmp_path)
    with closing(sqlite3.connect(out / "class.sqlite")) as database:
        database.execute("DROP TABLE arrivals")
    _hand_in(tmp_path, "ann", 4, _SECOND)  # the roster was mended
    _grade(tmp_path, "--resume")
    _hand_in(tmp_path, "ann", 7, _THIRD)
    _grade(tmp_path, "--resume")
    assert _times(out, "ann") == [(_SECOND, 4)]


def test_what_a_merge_did_not_know_yet_comes_with_the_next_one(tmp_path: Path) -> None:
    out, merged = tmp_path / "out", tmp_path / "merged"
    _hand_in(tmp_path, "ann", 4, _FIRST_TIME)
    _grade(tmp_path)
    with closing(sqlite3.connect(out / "class.sqlite")) as database:
        database.execute("DROP TABLE arrivals")
    grade_class("--merge", out, "--out", merged)
    for points, when in ((4, _FIRST_TIME), (7, _SECOND)):
        _hand_in(tmp_path, "ann", points, when)
        _grade(tmp_path, "--resume")
    for _ in range(2):
        assert grade_class("--merge", out, "--out", merged) == 0
        assert _times(merged, "ann") == [(_FIRST_TIME, 4)]


def _document(earlier: list[EarlierSubmission]) -> Results:
    steps = [StepResult(f"0{at}-x", "partial", points, 10, False) for at, points in ((1, 8), (2, 5), (3, 5))]
    results = Results.of("ann", steps)
    results.earlier = earlier
    return results


_TITLES = {f"0{at}-x": f"0{at} X" for at in (1, 2, 3)}


def test_better_and_worse() -> None:
    steps = {"01-x": EarlierStep(5, "failed"), "02-x": EarlierStep(5.04, "partial"), "03-x": EarlierStep(9, "partial")}
    one = EarlierSubmission("", False, "2026-11-01T10:00:00+00:00", 19.04, steps, True)
    words = history_words(_document([one]), _TITLES)
    assert words == [
        "You have handed in 2 times: 19 points (2026-11-01 10:00), and 18 now.",
        "Better than the last time: 01 X from 5 to 8.",
        "Worse than the last time: 03 X from 9 to 5.",
    ]
    history = history_of(_document([one]), _TITLES)
    assert history is not None
    assert [(row.change, row.tone) for row in history.rows] == [
        ("+3", "good"), ("=", ""), ("\N{MINUS SIGN}4", "bad"), ("\N{MINUS SIGN}1", ""),
    ]  # fmt: skip


def test_points_changed_by_hand_are_told_apart() -> None:
    steps = {f"0{at}-x": EarlierStep(points, "partial") for at, points in ((1, 8), (2, 5), (3, 5))}
    now = _document([EarlierSubmission("", False, "2026-11-01T10:00:00+00:00", 18, steps, True)])
    override = PointsOverride("", 5, 7, "why not", "Ada", "2026-11-02T10:00:00+00:00")
    now.steps[1].points, now.steps[1].review = 7, Review(5, [override])
    words = history_words(now, _TITLES)
    assert words == [
        "You have handed in 2 times: 18 points (2026-11-01 10:00), and 18 now.",
        "All points here are by the grader, before your instructor changed some.",
        "No step has other points than the last time.",
    ]
    now.steps[1].review = Review(5, comments=[Comment("Ada", "2026-11-02T10:00:00+00:00", "well")])
    assert len(history_words(now, _TITLES)) == 2


def test_a_step_that_was_not_graded_then_is_neither() -> None:
    one = EarlierSubmission("<b>\x1b[1m", True, "", 8, {"01-x": EarlierStep(8, "partial")}, True)
    history = history_of(_document([one]), _TITLES)
    assert history is not None
    assert history.words[1:] == ["No step has other points than the last time."]
    assert [list(row.points) for row in history.rows] == [["8", "8"], ["", "5"], ["", "5"], ["8", "18"]]
    assert history.heads == ["<b>, by the time of the file"]


def test_nothing_before() -> None:
    assert history_of(_document([]), _TITLES) is None
    assert history_words(_document([]), _TITLES) == []
