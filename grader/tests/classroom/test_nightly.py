"""Feedback a few times a day: by a clock of the test's own, and with a grader that only reads."""

import argparse
import errno
import io
import json
import os
import sqlite3
import sys
from collections.abc import Callable
from contextlib import closing
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any
from zoneinfo import ZoneInfo

import pytest
from class_fakes import FIRST, close_to_looks, grade_class, write_entry
from fake_grader import FAKE
from rich.console import Console

import raysteps.classroom.database
import raysteps.classroom.nightly
from raysteps.classroom.class_files import refuse_unwritten, write_submission
from raysteps.classroom.database import ClassDatabase
from raysteps.classroom.entries import load_entry
from raysteps.classroom.nightly import STATUS, Allowance, FeedbackLog, signature
from raysteps.cli.nightly import add_arguments, run
from raysteps.common.errors import UsageError
from raysteps.common.files import write_if_changed
from raysteps.course.project import here
from raysteps.desk.annotation_files import AnnotationDraft, AnnotationWriter

pytestmark = [
    pytest.mark.usefixtures("fake_grader"),
    pytest.mark.skipif(sys.platform == "win32", reason="a class is graded on Unix"),
]

_MORNING = datetime(2026, 11, 3, 8, tzinfo=UTC)


class Killed(BaseException):
    """As SIGKILL: nobody tidies up."""


class Course:
    """A course that is looked at when the test says so."""

    def __init__(self, folder: Path) -> None:
        self.inbox, self.out = folder / "inbox", folder / "grades"
        self.inbox.mkdir()
        self.now = _MORNING
        self.words: list[str | Path] = [self.inbox, "--per-day", "2"]
        self.meanwhile: Callable[[], None] = lambda: None
        self.said = ""

    def hand_in(self, name: str, text: str) -> None:
        write_entry(self.inbox, name, text)

    def look(self, *more: str | Path) -> int:
        parser = argparse.ArgumentParser()
        add_arguments(parser)
        words = [*self.words, "--out", self.out, "--once", "--jobs", "2", *more]
        printed = io.StringIO()
        try:
            return run(
                here(),
                parser.parse_args([str(word) for word in words]),
                Console(file=printed, width=300),
                grader=FAKE,
                clock=lambda: self.now,
                wait=lambda seconds: self.meanwhile(),
            )
        finally:
            self.said = printed.getvalue()

    def report(self, name: str) -> str:
        path = self.out / "feedback" / name / "report.html"
        return path.read_text("utf-8") if path.is_file() else ""

    def status(self, name: str) -> str:
        return (self.out / "feedback" / name / STATUS).read_text("utf-8")

    def document(self) -> dict[str, Any]:
        document: dict[str, Any] = json.loads((self.out / "class.json").read_text("utf-8"))
        return document

    def one(self, name: str) -> dict[str, Any]:
        return next(one for one in self.document()["submissions"] if one["name"] == name)

    def points(self, name: str) -> float | None:
        points: float | None = self.one(name)["points"]
        return points

    def runs(self) -> int:
        with closing(sqlite3.connect(self.out / "class.sqlite")) as connection:
            (amount,) = connection.execute("SELECT count(*) FROM runs").fetchone()
            return int(amount)


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Course:
    made = Course(tmp_path)
    monkeypatch.setattr(raysteps.classroom.database, "now", lambda timespec="seconds": made.now.isoformat())
    return made


def _graded(tmp_path: Path) -> list[str]:
    path = tmp_path / "log.txt"
    lines = path.read_text().splitlines() if path.exists() else []
    return [line.removeprefix("begin ") for line in lines if line.startswith("begin ")]


def test_what_comes_in_is_graded_and_given(course: Course, tmp_path: Path) -> None:
    course.hand_in("ann", "// points 3\n")
    course.hand_in("bob", "// points 4\n")
    assert course.look() == 0
    assert "<html" in course.report("ann")
    assert "2 feedbacks given" in course.said
    assert course.status("bob").endswith("Feedback today: 1 of 2.\n")
    assert {course.points("ann"), course.points("bob")} == {3.0, 4.0}
    assert (course.out / "class.html").is_file()
    assert course.look() == 0
    assert len(_graded(tmp_path)) == 2, "nothing has changed"
    assert course.runs() == 1
    assert course.status("ann").endswith("Feedback today: 1 of 2.\n")


def test_no_more_than_so_many_a_day(course: Course, tmp_path: Path) -> None:
    for points in (1, 2, 3):
        course.hand_in("ann", f"// points {points}\n")
        course.now += timedelta(hours=1)
        assert course.look() == 0
    assert course.points("ann") == 2.0
    page = course.report("ann")
    tomorrow = (_MORNING + timedelta(days=1)).date()
    assert f"from {tomorrow} 00:00+00:00 on" in course.status("ann")
    assert f"waiting until {tomorrow} 00:00+00:00: ann" in course.said
    course.hand_in("ann", "// points 4\n")
    course.look()
    assert course.report("ann") == page
    course.now = datetime.combine(tomorrow, datetime.min.time(), UTC)
    assert course.look() == 0
    assert course.points("ann") == 4.0, "the latest state wins, and 3 is never looked at"
    assert _graded(tmp_path) == ["ann"] * 3
    assert "Feedback today: 1 of 2." in course.status("ann")


def test_a_team_shares_each_feedback_and_a_student_has_one_allowance(course: Course, tmp_path: Path) -> None:
    roster = tmp_path / "students.csv"
    roster.write_text("id,name,submission\n1,Ann Lee,team\n2,Bob Ray,team\n3,Cy Fox,\n")
    course.words = [course.inbox, "--per-day", "1", "--roster", roster]
    course.hand_in("team", "// points 1\n")
    course.hand_in("3", "// points 1\n")
    course.hand_in("stranger", "// points 1\n")
    assert course.look() == 0
    assert course.report("team")
    assert course.report("3")
    assert "of nobody on the roster: stranger" in course.said
    assert not (course.out / "feedback" / "stranger").exists()
    # Each of the two now hands in alone, and one under another name.
    roster.write_text("id,name,submission\n1,Ann Lee,alone\n2,Bob Ray,\n3,Cy Fox,again\n")
    course.hand_in("alone", "// points 2\n")
    course.hand_in("2", "// points 2\n")
    course.hand_in("again", "// points 2\n")
    assert course.look() == 0
    assert not any(course.report(name) for name in ("alone", "2", "again"))
    course.now += timedelta(days=1)
    assert course.look() == 0
    assert all(course.report(name) for name in ("alone", "2", "again"))


def test_who_has_had_enough_keeps_the_team_waiting(course: Course, tmp_path: Path) -> None:
    roster = tmp_path / "students.csv"
    roster.write_text("id,submission\n1,alone\n2,\n")
    course.words = [course.inbox, "--per-day", "1", "--roster", roster]
    course.hand_in("alone", "// points 1\n")
    course.look()
    roster.write_text("id,submission\n1,team\n2,team\n")
    course.hand_in("team", "// points 2\n")
    course.look()
    assert not course.report("team")
    assert "waiting until" in course.said


def test_two_entries_of_one_student_in_one_look(course: Course, tmp_path: Path) -> None:
    roster = tmp_path / "students.csv"
    roster.write_text("id\n7\n")
    course.words = [course.inbox, "--per-day", "1", "--roster", roster]
    course.hand_in("7", "// points 1\n")
    course.hand_in("7_again", "// points 2\n")
    assert course.look() == 0
    assert len(_graded(tmp_path)) == 1
    assert sum(bool(course.report(name)) for name in ("7", "7_again")) == 1


def test_a_fault_takes_nothing_and_is_tried_three_times_a_day(course: Course, tmp_path: Path) -> None:
    course.hand_in("ann", "// fault\n")
    course.hand_in("bob", "// points 1\n")
    for _ in range(5):
        assert course.look() == 4
    assert _graded(tmp_path).count("ann") == 3
    assert "Feedback today: 0 of 2." in course.status("ann")
    assert "The grader itself failed" in course.status("ann")
    assert course.report("bob")
    course.hand_in("ann", "// points 2\n")
    assert course.look() == 0
    assert "Feedback today: 1 of 2." in course.status("ann")
    assert "failed" not in course.status("ann")


def test_a_process_that_dies_stalls_nobody_else(course: Course) -> None:
    course.hand_in("ann", "// die\n")
    for name in ("bob", "cy", "dee"):
        course.hand_in(name, "// points 1\n")
    assert course.look() == 4
    assert all(course.report(name) for name in ("bob", "cy", "dee"))


def test_who_took_long_comes_last(course: Course, tmp_path: Path) -> None:
    course.hand_in("ann", "// points 1\n")
    course.hand_in("bob", "// points 1\n")
    course.look("--jobs", "1")
    with closing(sqlite3.connect(course.out / "class.sqlite", isolation_level=None)) as connection:
        for name, seconds in (("ann", 9.0), ("bob", 1.0)):
            query = "UPDATE results SET seconds = ? WHERE submission = (SELECT id FROM submissions WHERE name = ?)"
            connection.execute(query, (seconds, name))
    course.hand_in("ann", "// points 2\n")
    course.hand_in("bob", "// points 2\n")
    course.look("--jobs", "1")
    assert _graded(tmp_path)[2:] == ["bob", "ann"]


def test_what_is_being_uploaded_waits(course: Course, tmp_path: Path) -> None:
    course.hand_in("ann", "// points 1\n")
    course.hand_in("bob", "// points 1\n")
    course.meanwhile = lambda: course.hand_in("ann", "// points 1\n// and more\n")
    assert course.look() == 0
    assert _graded(tmp_path) == ["bob"]
    assert "being uploaded" in course.status("ann")
    assert "still being uploaded: ann" in course.said
    course.meanwhile = lambda: None
    course.look()
    assert course.report("ann")


def test_a_signature_changes_with_whatever_is_written(tmp_path: Path) -> None:
    entry = write_entry(tmp_path, "ann", "// one\n")
    seen = {signature(entry)}
    (entry / "steps" / FIRST).write_text("// two\n")  # of the same length
    seen.add(signature(entry))
    (entry / "empty").mkdir()
    seen.add(signature(entry))
    (entry / "link").symlink_to("/etc")
    seen.add(signature(entry))
    assert len(seen) == 4
    assert signature(tmp_path / "gone") == ""


def test_a_signature_passes_over_what_is_closed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else the entry would look as if it were uploaded for ever."""
    entry = write_entry(tmp_path, "ann", "// one\n")
    close_to_looks(entry / "steps", monkeypatch)
    before = signature(entry)
    assert before == signature(entry) != ""
    (entry / "more.cpp").touch()
    assert signature(entry) != before


def test_what_cannot_be_read_is_told_and_takes_nothing(course: Course) -> None:
    (course.inbox / "ann.zip").write_bytes(b"PK half a zip")
    course.look()
    assert "Nothing was taken" in course.report("ann")
    assert "Feedback today: 0 of 2." in course.status("ann")


def test_a_link_to_another_submission_is_not_given_its_result(course: Course) -> None:
    course.hand_in("alice", "// points 9\n")
    (course.inbox / "ann").symlink_to("alice")
    course.look()
    assert "no submission counts twice" in course.report("ann")
    assert "Feedback today: 0 of 2." in course.status("ann")


def test_another_kit_takes_no_feedback(course: Course, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    course.words = [course.inbox, "--per-day", "1"]
    course.hand_in("ann", "// points 1\n")
    course.look()
    monkeypatch.setenv("FAKE_KIT", "newer-kit")
    course.look()
    assert _graded(tmp_path) == ["ann", "ann"]
    assert "newer-kit" in course.report("ann")
    course.hand_in("ann", "// points 2\n")
    course.look()
    assert "waiting until" in course.said


def test_killed_before_it_was_given(course: Course, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    course.hand_in("ann", "// points 1\n")
    with monkeypatch.context() as patch:
        patch.setattr(raysteps.classroom.nightly.NightlyRound, "give", _kill)
        with pytest.raises(Killed):
            course.look()
    assert not course.report("ann")
    assert course.look() == 0
    assert course.report("ann")
    assert _graded(tmp_path) == ["ann"], "its result was there"
    assert "Feedback today: 1 of 2." in course.status("ann")
    assert (course.out / "class.html").is_file()
    assert json.loads((course.out / "class.json").read_text())["runs"][-1]["state"] == "complete"


def _kill(*arguments: object, **options: object) -> None:
    raise Killed


def test_killed_between_the_page_and_the_account(course: Course, monkeypatch: pytest.MonkeyPatch) -> None:
    course.hand_in("ann", "// points 1\n")
    with monkeypatch.context() as patch:
        patch.setattr(FeedbackLog, "add", _kill)
        with pytest.raises(Killed):
            course.look()
    assert course.report("ann")
    course.look()
    assert "Feedback today: 1 of 2." in course.status("ann")
    course.look()
    assert "Feedback today: 1 of 2." in course.status("ann")


def test_a_clock_that_goes_back_gives_nothing_more(course: Course) -> None:
    course.words = [course.inbox, "--per-day", "1"]
    course.now = _MORNING.replace(hour=0, minute=0, second=5)
    course.hand_in("ann", "// points 1\n")
    course.look()
    course.now -= timedelta(seconds=10)  # the day before
    course.hand_in("ann", "// points 2\n")
    course.look()
    assert course.points("ann") == 1.0
    course.now += timedelta(hours=1)
    course.look()
    assert course.points("ann") == 1.0
    course.now += timedelta(days=1)
    course.look()
    assert course.points("ann") == 2.0


def test_a_clock_that_was_years_ahead_keeps_nobody_waiting_for_years(course: Course) -> None:
    course.words = [course.inbox, "--per-day", "1"]
    course.now = _MORNING + timedelta(days=4000)
    course.hand_in("ann", "// points 1\n")
    course.look()
    course.now = _MORNING
    course.hand_in("ann", "// points 2\n")
    course.look()
    assert course.points("ann") == 1.0
    course.now += timedelta(days=1)
    course.look()
    assert course.points("ann") == 2.0


def test_the_day_is_that_of_the_deadline(course: Course, tmp_path: Path) -> None:
    late = tmp_path / "late.toml"
    late.write_text("deadline = 2030-01-01T12:00:00+05:00\npercent_per_day = 10\n")
    course.words = [course.inbox, "--per-day", "1", "--late-policy", late]
    course.now = _MORNING.replace(hour=18, minute=59)  # 23:59 there
    course.hand_in("ann", "// points 1\n")
    course.look()
    course.hand_in("ann", "// points 2\n")
    course.look()
    assert "00:00+05:00" in course.status("ann")
    assert course.points("ann") == 1.0
    course.now += timedelta(minutes=1)
    course.look()
    assert course.points("ann") == 2.0


@pytest.mark.parametrize(("day", "hours"), [("2026-03-29", 23), ("2026-10-25", 25), ("2026-07-01", 24)])
def test_a_day_on_which_the_clocks_change(day: str, hours: int) -> None:
    allowance = Allowance(1, ZoneInfo("Europe/Berlin"))
    noon = datetime.fromisoformat(f"{day}T12:00:00").replace(tzinfo=ZoneInfo("Europe/Berlin"))
    began, ended = allowance.day_began(noon), allowance.next_day(noon)
    assert ended.astimezone(UTC) - began.astimezone(UTC) == timedelta(hours=hours)
    assert allowance.day_began(ended) == ended
    assert allowance.day_began(ended.astimezone(UTC) - timedelta(seconds=1)) == began


def test_no_hidden_case_is_given_whatever_grade_class_was_told(course: Course, monkeypatch: pytest.MonkeyPatch) -> None:
    levels: list[object] = []
    known = write_submission

    def write(*arguments: object) -> None:
        levels.append(arguments[-1])
        known(*arguments)  # type: ignore[arg-type]

    monkeypatch.setattr("raysteps.classroom.nightly.write_submission", write)
    course.hand_in("ann", "// points 1\n")
    assert grade_class(course.inbox, "--out", course.out, "--feedback", "full") == 0
    course.look()
    assert levels == ["diagnosis"]
    assert course.report("ann")
    assert "Feedback today: 1 of 2." in course.status("ann")


_FIRST_TIME, _SECOND = "2026-11-03T07:00:00+00:00", "2026-11-03T09:00:00+00:00"


def _roster(course: Course, tmp_path: Path, when: str) -> None:
    (tmp_path / "roster.csv").write_text(f"id,submitted_at\nann,{when}\nbob,{_FIRST_TIME}\n")
    course.words = [course.inbox, "--per-day", "1", "--roster", tmp_path / "roster.csv"]


def _standing(course: Course) -> tuple[object, ...]:
    one = course.one("ann")
    return one["points"], one["submitted_at"], one["outdated"], course.document()["outdated"]


def test_who_waits_keeps_the_time_of_the_result_that_stands(course: Course, tmp_path: Path) -> None:
    _roster(course, tmp_path, _FIRST_TIME)
    course.hand_in("ann", "// points 1\n")
    course.look()
    _roster(course, tmp_path, _SECOND)
    course.hand_in("ann", "// points 2\n")
    course.look()
    assert _standing(course) == (1.0, _FIRST_TIME, True, ["ann"]), "also when nothing is graded"
    course.hand_in("bob", "// points 3\n")
    course.look()
    assert course.points("bob") == 3.0
    assert _standing(course) == (1.0, _FIRST_TIME, True, ["ann"])
    course.now += timedelta(days=1)
    course.look()
    assert _standing(course) == (2.0, _SECOND, False, [])


def test_who_takes_a_change_back_waits_for_nothing(course: Course, tmp_path: Path) -> None:
    course.words = [course.inbox, "--per-day", "1"]
    for points, outdated in ((1, []), (2, ["ann"]), (1, [])):
        course.hand_in("ann", f"// points {points}\n")
        course.look()
        assert course.document()["outdated"] == outdated
    assert course.runs() == 1


@pytest.mark.parametrize("when", ["before the look", "while its turn comes"])
def test_what_is_being_uploaded_keeps_the_time_of_its_result(
    course: Course, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, when: str
) -> None:
    _roster(course, tmp_path, _FIRST_TIME)
    course.words += ["--per-day", "2"]
    course.hand_in("ann", "// points 1\n")
    course.look()
    _roster(course, tmp_path, _SECOND)
    course.words += ["--per-day", "2"]
    course.hand_in("ann", "// points 2\n")
    course.hand_in("bob", "// points 3\n")

    def upload() -> None:
        course.hand_in("ann", "// points 2\n// and more\n")

    with monkeypatch.context() as patch:
        if when == "before the look":
            course.meanwhile = upload
        else:

            def load(name: str, *rest: Any) -> Any:
                if name == "ann":
                    upload()
                return load_entry(name, *rest)

            patch.setattr("raysteps.classroom.session.load_entry", load)
        course.look()
    assert course.points("bob") == 3.0
    assert _standing(course) == (1.0, _FIRST_TIME, True, ["ann"])
    course.meanwhile = lambda: None
    course.look()
    assert _standing(course) == (2.0, _SECOND, False, [])


def _say(course: Course, name: str, text: str, points: float) -> None:
    """As a desk that a look keeps from writing the files."""
    with closing(ClassDatabase(course.out)) as database:
        AnnotationWriter(database, name).write(
            AnnotationDraft("points", "Ada", text=text, step="01-camera-rays", points=points)
        )


def test_a_look_writes_what_was_said_at_the_desk(course: Course) -> None:
    course.hand_in("ann", "// points 1\n")
    course.hand_in("bob", "// points 2\n")
    course.look()
    _say(course, "ann", "a good idea", 6.5)
    with pytest.raises(UsageError, match="changed after its files were made"):
        refuse_unwritten(course.out)
    assert course.look() == 0
    refuse_unwritten(course.out)
    assert course.points("ann") == 6.5
    assert "a good idea" in (course.out / "submissions" / "ann" / "report.html").read_text("utf-8")
    assert course.runs() == 1


def test_what_was_said_at_the_desk_reaches_the_student_and_takes_nothing(course: Course) -> None:
    course.words = [course.inbox, "--per-day", "1"]
    for name in ("ann", "bob"):
        course.hand_in(name, "// points 1\n")
    course.look()
    others = course.report("bob")
    course.hand_in("ann", "// points 2\n")  # waits: the page is of the result that stands
    _say(course, "ann", "a good idea", 6.5)
    assert course.look() == 0
    assert "a good idea" in course.report("ann")
    assert "0 feedbacks given" in course.said
    assert "with new comments or points: ann" in course.said
    assert "Feedback today: 1 of 1." in course.status("ann")
    assert course.report("bob") == others
    course.look()
    assert "with new comments" not in course.said
    _say(course, "bob", "so is this", 7)
    course.look()
    assert "so is this" in course.report("bob")
    assert course.runs() == 1


def test_what_is_said_of_a_result_that_is_not_given_waits_with_it(course: Course) -> None:
    course.words = [course.inbox, "--per-day", "1"]
    course.hand_in("ann", "// points 1\n")
    course.look()
    course.hand_in("ann", "// points 2\n")
    assert grade_class(course.inbox, "--out", course.out, "--resume") == 0
    page = course.report("ann")
    _say(course, "ann", "a good idea", 6.5)
    course.look()
    assert course.report("ann") == page
    course.now += timedelta(days=1)
    course.look()
    assert "a good idea" in course.report("ann")
    course.look()
    assert "with new comments" not in course.said, "the page was given with it"


def test_grade_class_grades_what_waits(course: Course) -> None:
    course.words = [course.inbox, "--per-day", "1"]
    course.hand_in("ann", "// points 1\n")
    course.look()
    course.hand_in("ann", "// points 2\n")
    course.look()
    assert grade_class(course.inbox, "--out", course.out, "--resume") == 0
    assert course.points("ann") == 2.0
    assert course.document()["outdated"] == []
    page = course.report("ann")
    course.look()
    assert course.report("ann") == page, "it is graded, but not given before tomorrow"
    assert course.document()["outdated"] == []
    course.now += timedelta(days=1)
    course.look()
    assert course.report("ann") != page


def test_a_merge_keeps_the_account(course: Course, tmp_path: Path) -> None:
    course.words = [course.inbox, "--per-day", "1"]
    course.hand_in("ann", "// points 1\n")
    course.look()
    course.hand_in("ann", "// points 2\n")
    course.look()
    first, course.out = course.out, tmp_path / "merged"
    for _ in range(2):  # again is harmless
        assert grade_class("--merge", first, "--out", course.out) == 0
        assert course.document()["outdated"] == ["ann"]
    course.look()
    assert "waiting until" in course.said
    assert course.points("ann") == 1.0
    assert "Feedback today: 1 of 1." in course.status("ann")


def test_an_empty_inbox_is_no_mistake(course: Course) -> None:
    assert course.look() == 0
    assert "holds no submission" in course.said


def test_goes_on_until_it_is_interrupted(course: Course) -> None:
    waited: list[float] = []
    course.hand_in("ann", "// points 1\n")

    def wait(seconds: float) -> None:
        waited.append(seconds)
        if waited.count(90.0) == 1 and seconds == 90.0:
            course.hand_in("bob", "// points 1\n")
        if waited.count(90.0) == 2:
            raise KeyboardInterrupt

    parser = argparse.ArgumentParser()
    add_arguments(parser)
    words = [course.inbox, "--out", course.out, "--every", "90s", "--settle", "1s", "--jobs", "1"]
    arguments = parser.parse_args([str(word) for word in words])
    assert run(here(), arguments, Console(file=io.StringIO()), grader=FAKE, clock=lambda: course.now, wait=wait) == 0
    assert waited == [1.0, 90.0, 1.0, 90.0]
    assert course.report("bob")


def test_a_look_that_finds_the_disk_full_ends_no_others(course: Course, monkeypatch: pytest.MonkeyPatch) -> None:
    course.hand_in("ann", "// points 1\n")
    printed = io.StringIO()
    looks = 0

    def write(path: Path, data: bytes) -> bool:
        if looks == 1 and path.name == "report.html":
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))
        return write_if_changed(path, data)

    def wait(seconds: float) -> None:
        nonlocal looks
        if seconds != 90.0:
            return
        looks += 1
        if looks == 1:
            course.hand_in("bob", "// points 1\n")
        if looks == 3:
            raise KeyboardInterrupt

    monkeypatch.setattr("raysteps.classroom.nightly.write_if_changed", write)
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    words = [course.inbox, "--out", course.out, "--every", "90s", "--settle", "1s", "--jobs", "1"]
    arguments = parser.parse_args([str(word) for word in words])
    console = Console(file=printed, width=300)
    assert run(here(), arguments, console, grader=FAKE, clock=lambda: course.now, wait=wait) == 0
    place = course.out / "feedback" / "bob" / "report.html"
    assert f"this look did not come to its end: {place}: " in printed.getvalue()
    assert course.report("bob")
    assert "Feedback today: 1 of 2." in course.status("bob")
    assert course.document()["run"]["state"] == "complete"


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        ([], "expected a folder of submissions, or --git"),
        (["IN", "--git"], "leave DIR out"),
        (["IN", "--branch", "main"], "are for --git"),
        (["--git", "--branch=--upload-pack=x"], "name of a branch"),
        (["--git"], "names no repository"),
        (["IN", "--give", "IN/there"], "lies in the folder of the submissions"),
        (["nowhere"], "is not there"),
    ],
)
def test_what_makes_no_sense_is_said(course: Course, words: list[str], complaint: str) -> None:
    course.hand_in("ann", "// points 1\n")
    course.words = [word.replace("IN", str(course.inbox)) for word in words]
    with pytest.raises(UsageError, match=complaint):
        course.look()


@pytest.mark.parametrize(
    "words", [["--per-day", "0"], ["--every", "10"], ["--zone", "Mars/Base"], ["--once", "--every", "1m"]]
)
def test_odd_options_are_refused(words: list[str]) -> None:
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    with pytest.raises(SystemExit):
        parser.parse_args(["in", "--out", "out", *words])


def test_the_account_is_kept_for_each_student(tmp_path: Path) -> None:
    with closing(ClassDatabase(tmp_path)) as database:
        log = FeedbackLog(database)
        assert log.last("ann") is None
        assert log.used(["ann"], _MORNING) == {}


def test_an_account_of_before_pages_told_what_people_say(course: Course) -> None:
    course.hand_in("ann", "// points 1\n")
    course.look()
    with closing(sqlite3.connect(course.out / "class.sqlite")) as connection:
        connection.execute("ALTER TABLE feedback_given DROP COLUMN said")
    _say(course, "ann", "a good idea", 6.5)
    course.look()
    assert "a good idea" in course.report("ann")
