"""What a run that was broken off leaves behind, and what goes on with it says."""

import json
import shlex
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from class_fakes import grade_class, write_entry

import raysteps.classroom.entries
import raysteps.classroom.session
import raysteps.cli.grade_class
import raysteps.submission.load
from raysteps.classroom.database import transaction
from raysteps.classroom.jobs import Job, JobResult
from raysteps.classroom.local_pool import LocalPool
from raysteps.cli.grade_class import add_arguments, read_options, resume_command
from raysteps.course.settings import Course

pytestmark = pytest.mark.usefixtures("fake_grader")


@pytest.fixture
def handed_in(tmp_path: Path) -> Path:
    for number in range(1, 5):
        write_entry(tmp_path / "in", f"s{number}", f"// points {number}\n")
    return tmp_path / "in"


def _document(out: Path) -> dict[str, Any]:
    document: dict[str, Any] = json.loads((out / "class.json").read_text())
    return document


class _Broken(LocalPool):
    """Is broken off after some answers."""

    amount = 1
    how: type[BaseException] = KeyboardInterrupt

    def answers(self, jobs: Iterator[Job]) -> Iterator[JobResult]:
        for at, answer in enumerate(super().answers(jobs)):
            if at == self.amount:
                raise self.how
            yield answer


class _Killed(BaseException):
    """As SIGKILL: nobody tidies up."""


def test_results_of_before_an_interruption_are_listed(
    tmp_path: Path, handed_in: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out) == 0
    for number in (2, 3, 4):
        write_entry(handed_in, f"s{number}", f"// points {number + 5}\n")
    with monkeypatch.context() as patch:
        patch.setattr(raysteps.cli.grade_class, "LocalPool", _Broken)
        assert grade_class(handed_in, "--out", out, "--resume", "--jobs", 1) == 130
    document = _document(out)
    assert document["run"]["reused"] == 1
    assert document["outdated"] == ["s3", "s4"]  # s1 was found to hold, and s2 is graded
    assert "With an earlier result, because what is there now is not graded yet\n  s3\n  s4" in capsys.readouterr().out
    assert grade_class(handed_in, "--out", out, "--resume") == 0
    assert _document(out)["outdated"] == []


def test_no_table_of_earlier_results_stays_beside_new_ones(
    tmp_path: Path, handed_in: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out) == 0
    with monkeypatch.context() as patch:
        patch.setattr(raysteps.cli.grade_class, "LocalPool", _Broken)
        patch.setattr(_Broken, "how", _Killed)
        with pytest.raises(_Killed):
            grade_class(handed_in, "--out", out, "--jobs", 1)
        assert not (out / "results.csv").exists()
        assert not (out / "class.json").exists()
        assert not (out / "class.html").exists()
    assert grade_class(handed_in, "--out", out, "--resume") == 0
    assert (out / "results.csv").exists()


def test_half_written_files_of_a_killed_run_go_away(tmp_path: Path, handed_in: Path) -> None:
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out) == 0
    one = out / "submissions" / "s1"
    picture = next((one / "pictures").rglob("*-mine.png"))
    left = [folder / f".{name}.a_b4c6d8" for folder, name in ((out, "results.csv"), (one, "results.json"))]
    left.append(picture.with_name(f".{picture.name}.zzzzzzzz"))
    for path in left:
        path.write_bytes(b"half")
    own = out / ".notes"
    own.write_text("somebody's own")
    assert grade_class(handed_in, "--out", out, "--resume") == 0
    assert not any(path.exists() for path in left)
    assert picture.is_file()
    assert own.read_text() == "somebody's own"


def test_tables_stay_when_nothing_was_graded(tmp_path: Path, handed_in: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out) == 0
    monkeypatch.setattr(raysteps.cli.grade_class, "LocalPool", _Broken)
    monkeypatch.setattr(_Broken, "how", _Killed)
    monkeypatch.setattr(_Broken, "amount", 0)
    with pytest.raises(_Killed):
        grade_class(handed_in, "--out", out, "--jobs", 1)
    assert (out / "results.csv").exists()


def test_interrupted_while_the_kit_is_built(
    tmp_path: Path, handed_in: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def build(*arguments: Any, **options: Any) -> Any:
        raise KeyboardInterrupt

    out = tmp_path / "out"
    with monkeypatch.context() as patch:
        patch.setattr(raysteps.cli.grade_class, "make_grader", build)
        assert grade_class(handed_in, "--out", out, "--jobs", 2) == 130
    line = f"./raysteps grade-class {handed_in} --out {out} --jobs 2 --resume"
    assert line in capsys.readouterr().out
    assert [path.name for path in out.iterdir()] == ["class.lock"]
    assert grade_class(*shlex.split(line)[2:]) == 0
    assert _document(out)["statistics"]["graded"] == 4


def test_whatever_one_submission_brings_about_the_class_goes_on(
    tmp_path: Path, handed_in: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    known = raysteps.submission.load.load_submission

    def take_in(path: Path, steps: Any) -> Any:
        if path.name == "s2":
            raise KeyError("odd")
        return known(path, steps)

    monkeypatch.setattr(raysteps.classroom.entries, "load_submission", take_in)
    out = tmp_path / "out"
    assert grade_class(handed_in, "--out", out) == 4
    document = _document(out)
    assert document["faults"] == ["s2"]
    assert document["statistics"]["graded"] == 3
    assert "KeyError: 'odd'" in (out / "submissions" / "s2" / "fault.txt").read_text()


def test_each_submission_is_written_once(tmp_path: Path, handed_in: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written: list[str] = []
    known = raysteps.classroom.class_files.write_submission

    def write(database: Any, out: Path, one: Any, *rest: Any) -> None:
        written.append(one.name)
        known(database, out, one, *rest)

    for place in (raysteps.classroom.session, raysteps.classroom.class_files):
        monkeypatch.setattr(place, "write_submission", write)
    assert grade_class(handed_in, "--out", tmp_path / "out") == 0
    assert sorted(written) == ["s1", "s2", "s3", "s4"]


def test_the_line_to_go_on_has_the_same_limits(tmp_path: Path) -> None:
    import argparse

    parser = argparse.ArgumentParser()
    add_arguments(parser)
    words = ["in", "--out", "out", "--limit", "seconds=0.00001234567", "--limit", "memory_mb=512"]
    options = read_options(parser.parse_args(words), "")
    line = resume_command(options)
    assert "--limit seconds=0.00001234567 --limit memory_mb=512" in line
    assert read_options(parser.parse_args(shlex.split(line)[2:]), "").limits == options.limits


@pytest.mark.parametrize(("typed", "words"), [(1, "--seed 1"), (7, "--seed 7"), (77, None), (None, None)])
def test_the_line_to_go_on_has_the_seed_that_would_not_be_taken_anyway(typed: int | None, words: str | None) -> None:
    import argparse

    parser, course = argparse.ArgumentParser(), Course(Path("course.toml"), 77)
    add_arguments(parser)
    seed = [] if typed is None else ["--seed", str(typed)]
    options = read_options(parser.parse_args(["in", "--out", "out", *seed]), "", course)
    line = resume_command(options)
    assert (words in line) if words else ("--seed" not in line)
    assert read_options(parser.parse_args(shlex.split(line)[2:]), "", course).seed == options.seed


def test_a_commit_that_fails_leaves_no_transaction_open() -> None:
    with closing(sqlite3.connect(":memory:", isolation_level=None)) as connection:
        connection.execute("PRAGMA foreign_keys = ON")
        connection.execute("CREATE TABLE a (id INTEGER PRIMARY KEY)")
        connection.execute("CREATE TABLE b (a INTEGER REFERENCES a (id) DEFERRABLE INITIALLY DEFERRED)")
        with pytest.raises(sqlite3.IntegrityError), transaction(connection):
            connection.execute("INSERT INTO b VALUES (7)")
        assert not connection.in_transaction

        def roll_back() -> None:
            with transaction(connection):
                connection.execute("ROLLBACK")  # as SQLite does by itself when the disk is full
                raise KeyError

        with pytest.raises(KeyError):
            roll_back()
