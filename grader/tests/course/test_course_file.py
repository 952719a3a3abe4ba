"""course.toml: the seed and the late policy of a term, and who uses them."""

import argparse
import zipfile
from pathlib import Path

import pytest
from rich.console import Console

from raysteps.cli import export as exports
from raysteps.cli.grade_class import add_arguments, read_options
from raysteps.common.errors import UsageError
from raysteps.course.project import Project, here
from raysteps.course.settings import PLACE, Course, read_course


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(PLACE, str(tmp_path / "course.toml"))
    return tmp_path / "course.toml"


def _order(course: Course, *words: str) -> tuple[int, Path | None, bool]:
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    options = read_options(parser.parse_args(["class", "--out", "out", *words]), "", course)
    return options.seed, options.late_policy, options.no_late_policy


def test_without_a_file_nothing_is_settled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(PLACE, raising=False)
    assert read_course(Project(tmp_path)) == Course()
    assert (Course().seed_or(None), Course().seed_or(5)) == (1, 5)


def test_it_lies_in_the_kit_or_where_the_environment_says(tmp_path: Path, place: Path) -> None:
    kit = tmp_path / "kit"
    kit.mkdir()
    (kit / "course.toml").write_text("seed = 3\n")
    place.write_text('seed = 77\nlate_policy = "rules/late.toml"\n')
    assert read_course(Project(kit)) == Course(place, 77, tmp_path / "rules" / "late.toml")
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv(PLACE)
        assert read_course(Project(kit)).seed == 3


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("sed = 5", "unknown key 'sed'; known are seed, late_policy"),
        ("seed = -1", "$.seed: expected int >= 0"),
        ('seed = "5"', "$.seed: expected int | null, got str"),
        ("seed = ", "cannot be read as TOML"),
    ],
)
def test_a_bad_file_is_refused_with_its_path(tmp_path: Path, place: Path, text: str, words: str) -> None:
    place.write_text(text)
    with pytest.raises(UsageError) as caught:
        read_course(Project(tmp_path))
    assert words in str(caught.value)
    assert str(place) in str(caught.value)


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
    place.write_text("seed = 77\n")
    parser = argparse.ArgumentParser()
    exports.add_arguments(parser)
    out = tmp_path / "autograder.zip"
    assert exports.run(here(), parser.parse_args(["gradescope", "--out", str(out)]), Console()) == 0
    with zipfile.ZipFile(out) as archive:
        assert "--seed 77" in archive.read("run_autograder").decode()
        assert not [name for name in archive.namelist() if name.endswith("course.toml")]
