"""course.toml: what a course settles for a term, and who goes by it."""

import argparse
import json
import re
import shutil
import sqlite3
import zipfile
from collections.abc import Iterator
from contextlib import closing
from datetime import date
from pathlib import Path

import pytest
from class_fakes import grade_class, write_entry
from rich.console import Console

import raysteps.cli.grade_class
from raysteps.classroom.class_files import remake_class_page
from raysteps.classroom.jobs import Job, JobResult
from raysteps.classroom.local_pool import LocalPool
from raysteps.cli import export as exports
from raysteps.cli.grade_class import add_arguments, read_options
from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.manifest import (
    chosen_steps,
    course_manifests,
    course_steps,
    dated_steps,
    read_all_steps,
    read_step,
    read_steps,
)
from raysteps.course.project import Project, here
from raysteps.course.settings import COURSE_VARIABLE, Course, read_course
from raysteps.release.build_release import due_steps
from raysteps.release.contents import kit_contents


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(COURSE_VARIABLE, str(tmp_path / "course.toml"))
    return tmp_path / "course.toml"


def _order(course: Course, *words: str) -> tuple[int, Path | None, bool]:
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    options = read_options(parser.parse_args(["class", "--out", "out", *words]), "", course)
    return options.seed, options.late_policy, options.no_late_policy


def test_without_a_file_nothing_is_settled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(COURSE_VARIABLE, raising=False)
    assert read_course(Project(tmp_path)) == Course()
    assert (Course().seed_or(None), Course().seed_or(5)) == (1, 5)


def test_it_lies_in_the_kit_or_where_the_environment_says(tmp_path: Path, place: Path) -> None:
    kit = tmp_path / "kit"
    kit.mkdir()
    (kit / "course.toml").write_text("seed = 3\n")
    place.write_text('seed = 77\nlate_policy = "rules/late.toml"\n')
    assert read_course(Project(kit)) == Course(place, 77, tmp_path / "rules" / "late.toml")  # as older kits had it
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv(COURSE_VARIABLE)
        assert read_course(Project(kit)).seed == 3


_WHOLE = """title = "Graphics 101"
term = "Autumn 2026"
seed = 48213

[steps]
"1-2" = 2026-10-12
"3-4" = 2026-11-02

[points]
02 = 25

[late_policy]
deadline = 2026-11-20T23:59:00+01:00
percent_per_day = 10
[late_policy.extensions]
4713 = 2
"""


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("sed = 5", ":1:1: unknown key 'sed'; did you mean seed?"),
        ("x = 5", ":1:1: unknown key 'x'; known are title, term, parts, steps, points, seed, late_policy"),
        ("seed = -1", ":1:1: seed: expected a whole number from 0 to .*; found -1"),
        ('term = "x"\n  seed = "5"', ":2:3: seed: expected a whole number from 0 to .*; found '5'"),
        ("\nseed = ", ":2:8: is not TOML: invalid value"),
        ('title = "Graphics', ":1:18: is not TOML: unterminated string"),
        ("title = x", ':1:9: is not TOML: invalid value; text stands in quotes: title = "x"'),
        ("steps = 1-4 # all", ':1:10: is not TOML: .*; text stands in quotes: steps = "1-4"'),
        ("title = \u201cx\u201d", ":1:9: is not TOML: .*; these quotes are curved; straight ones are meant"),
        ('title: "x"', ":1:6: is not TOML: .*; between a key and its value stands =, as in title = ..."),
        ('title = "x"\n\ntitle = "y"\nterm = "z"', ":3:1: is not TOML: title stands there twice; keep one of them"),
        ('late_policy = "C:\\user\\late.toml"', ":1:20: is not TOML: .*; in double quotes a \\ is written twice"),
        ("[points]\n02 = 2,5", ":2:7: is not TOML: .*; numbers have a point, as in 2.5"),
        ("seed = 0123", ":1:9: is not TOML: .*; a number does not begin with 0"),
        ("parts = [1, 2", ":1:14: is not TOML: .*; the ] that ends the list is missing"),
        ("seed = ", ":1:8: is not TOML: .*; nothing stands behind the ="),
        ("[late_policy]\ndeadline = 2026-11-31", ":2:12: is not TOML: .*; there is no such day or time"),
        ("[late_policy]\ndeadline = 2026-11-20T23:59:00 CET", ":2:32: is not TOML: .*; behind a time stand Z or"),
        ("[late_policy]\ndeadline = 20.11.2026", ":2:17: is not TOML: .*; a day is written as 2026-11-20"),
        ("[late_policy]\ndeadline = 2026-11-20 23:59", ":2:23: is not TOML: .*; a time is written with its seconds"),
        ("[late_policy]\npercent_per_day = 10%", ":2:21: is not TOML: .*; a number stands alone, such as 10 or 2.5"),
        (
            'steps = [\n"1",\n"2"\nseed = 5',
            ":4:1: is not TOML: .*; the ] that ends the list is missing, or a comma in it",
        ),
        ('[points]\n"01" = 1\n01 = 2', ":3:1: is not TOML: 01 stands there twice; keep one of them"),
        ("[points]\n02 = 1\n[points]\n03 = 2", ":3:1: is not TOML: the table [points] stands there twice; put all of"),
        (
            'late_policy = "late.toml"\n[late_policy]\npercent_per_day = 10',
            ":2:1: is not TOML: late_policy stands there twice, as a line and as a table; keep one of them",
        ),
        ("[points]\n02 = 25\nseed = 7", ":3:1: points: `seed = ...` belongs above the first line in brackets"),
        ('title = ""', ":1:1: title: expected the name of the course"),
        ("steps = [1, true]", ":1:1: steps: expected steps such as"),
        ('[steps]\n"1-2" = 2026-10-12\n"3" = "soon"', ":3:1: steps: expected steps such as"),
        ("[steps]\n1 = 2026-10-12T10:00:00", ":2:1: steps: expected .*; found 2026-10-12 10:00:00"),
        (
            "[points]\n02 = 25\n03 = 0",
            ":3:1: points: expected a table of steps, each with its points (more than 0, at most 10000), .*; found 0",
        ),
    ],
)
def test_a_bad_file_is_refused_with_the_place_of_what_is_wrong(
    tmp_path: Path, place: Path, text: str, words: str
) -> None:
    place.write_text(text)
    said = ".*".join(map(re.escape, words.split(".*")))
    with pytest.raises(UsageError, match=f"^{re.escape(str(place))}{said}"):
        read_course(Project(tmp_path))


@pytest.mark.parametrize("text", ['title = """x\nseed = 5', "late policy = 5", "-- 5", "seed = -"])
def test_where_nobody_knows_what_was_meant_nothing_is_advised(tmp_path: Path, place: Path, text: str) -> None:
    place.write_text(text)
    with pytest.raises(UsageError, match=r"is not TOML: [^;]+$"):
        read_course(Project(tmp_path))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('title = "x"\nsteps = "1-19"', ":2:1: steps: there is no step '19'"),
        ('[steps]\n"1-2" = 2026-10-12\n"2-3,77" = 2026-10-13', ":3:1: steps: there is no step '77'"),
    ],
)
def test_steps_that_are_not_there_are_refused(place: Path, text: str, words: str) -> None:
    place.write_text(text)
    with pytest.raises(UsageError, match=re.escape(f"{place}{words}")):
        course_steps(here())
    if "[steps]" in text:
        with pytest.raises(UsageError, match=re.escape(f"{place}{words}")):
            dated_steps(here())


def test_points_of_a_step_that_is_not_there_are_refused(place: Path) -> None:
    place.write_text("[points]\n1 = 5\n77 = 5")
    with pytest.raises(UsageError, match=re.escape(f"{place}:3:1: points: there is no step '77'")):
        read_steps(here())


def test_a_step_has_its_points_and_its_day_once(place: Path) -> None:
    place.write_text("[points]\n02 = 25\n2 = 26")
    with pytest.raises(UsageError, match=re.escape(f"{place}:3:1: points: step 02 stands above already")):
        read_steps(here())
    place.write_text('[steps]\n"1-2" = 2026-10-12\n"2-4" = 2026-11-02')
    with pytest.raises(UsageError, match=re.escape(f"{place}:3:1: steps: step 02 stands above already")):
        dated_steps(here())


@pytest.mark.parametrize(("encoding", "said"), [("utf-16", "it is text in UTF-16"), ("latin-1", "(line 2, column 10)")])
def test_another_encoding_is_refused_with_what_to_do(place: Path, encoding: str, said: str) -> None:
    place.write_text('seed = 5\ntitle = "ä"', encoding)
    with pytest.raises(UsageError, match=f"{re.escape(said)}; save it in UTF-8"):
        read_steps(here())


def test_one_file_says_it_all(place: Path) -> None:
    place.write_text(_WHOLE)
    course = read_course(here())
    assert (course.name, course.seed) == ("Graphics 101, Autumn 2026", 48213)
    assert [(step.index, step.points) for step in course_steps(here())] == [(1, 10), (2, 25), (3, 15), (4, 10)]
    assert len(read_steps(here())) == 9  # the others can still be asked for
    assert [step.index for step in chosen_steps(here(), ["5"])] == [5]
    assert [day.isoformat() for _, day in dated_steps(here())] == ["2026-10-12"] * 2 + ["2026-11-02"] * 2


@pytest.mark.parametrize("text", ['steps = "1-4"', 'steps = ["1-2", "03", 4]', 'steps = "1,2 3,4"'])
def test_steps_are_said_as_on_the_command_line(place: Path, text: str) -> None:
    place.write_text(text)
    assert [step.index for step in course_steps(here())] == [1, 2, 3, 4]


def test_what_is_not_due_stays(place: Path) -> None:
    place.write_text(_WHOLE)
    assert [step.index for step in due_steps(here(), date(2026, 11, 1))] == [1, 2]
    assert [step.index for step in due_steps(here(), date(2026, 11, 2))] == [1, 2, 3, 4]
    with pytest.raises(UsageError, match=r":5:1: the first steps are given out on 2026-10-12; --steps gives out"):
        due_steps(here(), date(2026, 10, 11))
    place.write_text('steps = "2-4"')
    with pytest.raises(UsageError, match=r"course\.toml:1:1: expected the first and the last, such as 1-4"):
        due_steps(here(), date(2026, 10, 11))


def test_what_is_given_out_has_the_points_of_the_course(place: Path) -> None:
    place.touch()
    assert course_manifests(here()) == {}
    place.write_text(_WHOLE)
    before = (here().steps / "02-intersection" / "step.toml").read_text()
    made = {name: data.decode() for name, data in course_manifests(here()).items()}
    assert made == {"steps/02-intersection/step.toml": before.replace("\npoints = 20\n", "\npoints = 25\n")}
    files = kit_contents(here(), course_steps(here()), read_steps(here())[4:])
    assert files["steps/02-intersection/step.toml"].decode() == made["steps/02-intersection/step.toml"]


@pytest.mark.parametrize("points", ["1234.567", "0.1234567", "9999.99999", "0.00001", "25.0", "10_000"])
def test_points_go_out_as_they_stand_in_the_course(tmp_path: Path, place: Path, points: str) -> None:
    place.write_text(f"[points]\n02 = {points}\n")
    (made,) = course_manifests(here()).values()
    there = tmp_path / "02-intersection" / "step.toml"
    there.parent.mkdir()
    there.write_bytes(made)
    assert read_step(there).points == float(points)


def test_points_are_found_however_the_manifest_writes_them(tmp_path: Path, place: Path) -> None:
    place.write_text("[points]\n02 = 25\n")
    course = Project(tmp_path / "kit")
    shutil.copytree(here().steps, course.steps, ignore=lambda folder, names: {name for name in names if "." in name})
    course.solutions.mkdir()
    for step in read_all_steps(here()):
        shutil.copy(here().steps / step.id / "step.toml", course.steps / step.id)
    path = course.steps / "02-intersection" / "step.toml"
    text = path.read_text()
    for line in ('  "points" = 20', "points=20"):
        path.write_text(text.replace("\npoints = 20\n", f"\n{line}\n"))
        assert [*course_manifests(course).values()] == [text.replace("points = 20", "points = 25").encode()]
    path.write_text(text.replace("\npoints = 20\n", '\n"p\\u006fints" = 20\n'))
    with pytest.raises(GraderFault, match="expected a line such as points = 10"):
        course_manifests(course)


@pytest.mark.usefixtures("fake_grader")
def test_a_class_is_graded_by_the_whole_file(tmp_path: Path, place: Path) -> None:
    place.write_text(_WHOLE)
    for name in ("4713", "anna"):
        write_entry(tmp_path / "in", name, "// points 10")
    assert grade_class(tmp_path / "in", "--out", tmp_path / "out") == 0
    document = json.loads((tmp_path / "out" / "class.json").read_text())
    assert [(step["id"][:2], step["points"]) for step in document["steps"]] == [
        ("01", 10), ("02", 25), ("03", 15), ("04", 10),
    ]  # fmt: skip
    assert document["run"]["settings"]["seed"] == 48213
    assert {one["late"]["deadline"][:10] for one in document["submissions"]} == {"2026-11-20", "2026-11-22"}
    assert document["late_policy"].endswith('[extensions]\n"4713" = 2\n')


@pytest.mark.usefixtures("fake_grader")
def test_a_class_is_that_of_its_own_course(tmp_path: Path, place: Path) -> None:
    """Next term's file says nothing of it."""
    place.write_text(_WHOLE)
    write_entry(tmp_path / "in", "anna", "// points 10")
    out = tmp_path / "out"
    assert grade_class(tmp_path / "in", "--out", out, "--steps", "2") == 0
    assert grade_class("--merge", out, "--out", tmp_path / "before") == 0
    for text in ('title = "Optics"\n[points]\n02 = 99\n', 'title = "half of a', ""):
        place.write_text(text)
        remade = tmp_path / f"remade-{len(text)}"
        (out / "class.html").unlink()
        assert "Graphics 101, Autumn 2026" in remake_class_page(out / "class.sqlite").read_text()
        assert grade_class("--merge", out, "--out", remade) == 0
        for name in ("submissions/anna/results.json", "submissions/anna/report.html"):
            assert (remade / name).read_bytes() == (tmp_path / "before" / name).read_bytes()
        assert json.loads((remade / "class.json").read_text())["course"] == "Graphics 101, Autumn 2026"


@pytest.mark.usefixtures("fake_grader")
def test_a_course_file_that_is_being_edited_loses_no_result(
    tmp_path: Path, place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Edited(LocalPool):
        def answers(self, jobs: Iterator[Job]) -> Iterator[JobResult]:
            found = list(super().answers(jobs))
            place.write_text('title = "half of a')
            yield from found

    monkeypatch.setattr(raysteps.cli.grade_class, "LocalPool", Edited)
    place.write_text(_WHOLE)
    write_entry(tmp_path / "in", "anna", "// points 10")
    assert grade_class(tmp_path / "in", "--out", tmp_path / "out") == 0
    told = json.loads((tmp_path / "out" / "submissions" / "anna" / "results.json").read_text())
    assert told["course"] == "Graphics 101, Autumn 2026"


@pytest.mark.usefixtures("fake_grader")
def test_a_class_of_an_earlier_kit_still_opens(tmp_path: Path, place: Path) -> None:
    """It kept no course."""
    place.write_text(_WHOLE)
    write_entry(tmp_path / "in", "anna", "// points 10")
    out = tmp_path / "out"
    assert grade_class(tmp_path / "in", "--out", out) == 0
    with closing(sqlite3.connect(out / "class.sqlite")) as connection:
        connection.execute("ALTER TABLE runs DROP COLUMN course")
    assert "Graphics 101" not in remake_class_page(out / "class.sqlite").read_text()
    assert grade_class("--merge", out, "--out", tmp_path / "merged") == 0
    assert json.loads((tmp_path / "merged" / "class.json").read_text())["course"] == ""
    assert grade_class(tmp_path / "in", "--out", out, "--resume") == 0
    assert json.loads((out / "class.json").read_text())["course"] == "Graphics 101, Autumn 2026"


@pytest.mark.usefixtures("fake_grader")
def test_the_command_line_wins(tmp_path: Path, place: Path) -> None:
    place.write_text(_WHOLE)
    write_entry(tmp_path / "in", "anna", "// points 10")
    words = ("--out", tmp_path / "out", "--steps", "1-2,5", "--late-policy", "none", "--seed", "7")
    assert grade_class(tmp_path / "in", *words) == 0
    document = json.loads((tmp_path / "out" / "class.json").read_text())
    assert [step["id"][:2] for step in document["steps"]] == ["01", "02", "05"]
    assert (document["run"]["settings"]["seed"], document["late_policy"]) == (7, None)


@pytest.mark.usefixtures("fake_grader")
def test_a_wrong_late_policy_is_refused_where_it_stands(tmp_path: Path, place: Path) -> None:
    place.write_text(_WHOLE.replace("percent_per_day = 10", "percent_per_day = 101"))
    write_entry(tmp_path / "in", "anna", "// points 10")
    with pytest.raises(UsageError, match=re.escape(f"{place}:14:1: `percent_per_day`: expected a number from 0 to")):
        grade_class(tmp_path / "in", "--out", tmp_path / "out")


def test_a_file_that_is_named_must_be_there(tmp_path: Path, place: Path) -> None:
    with pytest.raises(UsageError, match="is not there"):
        read_course(Project(tmp_path))


def test_a_class_is_graded_as_the_course_says_unless_the_line_says_otherwise() -> None:
    course = Course(Path("course.toml"), 77, Path("late.toml"))
    assert _order(course) == (77, Path("late.toml"), False)
    assert _order(course, "--seed", "1", "--late-policy", "other.toml") == (1, Path("other.toml"), False)
    assert _order(course, "--late-policy", "none") == (77, None, True)
    assert _order(Course()) == (1, None, False)


def test_an_autograder_takes_the_seed_along(tmp_path: Path, place: Path) -> None:
    place.write_text('seed = 77\nsteps = "1-4"\n[points]\n02 = 25\n')
    parser = argparse.ArgumentParser()
    exports.add_arguments(parser)
    out = tmp_path / "autograder.zip"
    assert exports.run(here(), parser.parse_args(["gradescope", "--out", str(out)]), Console()) == 0
    with zipfile.ZipFile(out) as archive:
        assert "--seed 77 --steps 1-4" in archive.read("run_autograder").decode()
        assert b"\npoints = 25\n" in archive.read("kit/steps/02-intersection/step.toml")
        assert not [name for name in archive.namelist() if name.endswith("course.toml")]
