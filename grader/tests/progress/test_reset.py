"""The command `reset`, and the stubs that it puts back."""

from pathlib import Path

import pytest
from course_fakes import printed, small_project, text, write_own

from raysteps.cli import app as cli
from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import outdated_stubs, write_stubs
from raysteps.progress.reset import lost_lines, reset


@pytest.fixture
def course(tmp_path: Path) -> Project:
    return small_project(tmp_path)


def _stub(course: Project, step: Step) -> str:
    return (course.stubs / step.path).read_text(encoding="utf-8")


def _kept(course: Project) -> list[Path]:
    return sorted((course.build / "reset").glob("*"))


def _edit(course: Project, step: Step) -> str:
    source = _stub(course, step).replace(
        "return ray.origin;", "return ray.origin + distance;\n    // [bold]why\x1b[2J?"
    )
    write_own(course, step, source)
    return source


def test_the_old_file_is_kept_and_its_place_told(course: Project, steps: list[Step]) -> None:
    source = _edit(course, steps[0])
    console = printed()
    assert reset(course, steps[0], console, yes=False, confirm=lambda question: question == "Put the stub back?") == 0
    assert (course.steps / steps[0].path).read_text() == _stub(course, steps[0])
    (kept,) = _kept(course)
    assert kept.read_text() == source
    said = text(console)
    assert "2 lines of your own would be put away, 1 line of the stub would come back" in said
    assert "return ray.origin + distance;" in said
    assert "// [bold]why?" in said
    assert f"The old file is kept: {kept}" in said


def test_no_means_no(course: Project, steps: list[Step]) -> None:
    source = _edit(course, steps[0])
    console = printed()
    assert reset(course, steps[0], console, yes=False, confirm=lambda _: False) == 0
    assert (course.steps / steps[0].path).read_text() == source
    assert _kept(course) == []
    assert text(console).endswith("Nothing was changed.\n")


def test_a_folder_in_its_place_stays(course: Project, steps: list[Step]) -> None:
    path = course.steps / steps[0].path
    path.unlink()
    path.mkdir()
    with pytest.raises(UsageError, match=r"camera_rays\.cpp: is a folder; expected a file\. Move the folder away"):
        reset(course, steps[0], printed(), yes=True)
    assert path.is_dir()


def test_two_in_one_second_are_both_kept(course: Project, steps: list[Step]) -> None:
    for number in range(3):
        write_own(course, steps[0], f"int a = {number};\n")
        reset(course, steps[0], printed(), yes=True)
    assert sorted(path.read_text() for path in _kept(course)) == [f"int a = {number};\n" for number in range(3)]


def test_a_stub_stays_and_a_missing_file_comes_back(course: Project, steps: list[Step]) -> None:
    console = printed()
    assert reset(course, steps[0], console, yes=False) == 0
    assert "is the stub already" in text(console)
    (course.steps / steps[0].path).unlink()
    assert lost_lines(course, steps[0]) is None
    assert reset(course, steps[0], console, yes=False) == 0
    assert (course.steps / steps[0].path).read_text() == _stub(course, steps[0])
    assert _kept(course) == []


def test_without_a_terminal_it_must_be_said(
    course: Project, steps: list[Step], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    source = _edit(course, steps[0])
    monkeypatch.setattr(cli, "here", lambda: course)
    assert cli.main(["reset", "1"]) == 2
    assert "there is no terminal to ask on; say --yes" in capsys.readouterr().err
    assert (course.steps / steps[0].path).read_text() == source
    assert cli.main(["reset", "1", "--yes"]) == 0
    assert (course.steps / steps[0].path).read_text() == _stub(course, steps[0])


def test_a_kit_without_its_stubs_changes_nothing(course: Project, steps: list[Step]) -> None:
    source = _edit(course, steps[0])
    (course.stubs / steps[0].path).unlink()
    with pytest.raises(GraderFault, match="expected the stub of 01-camera-rays"):
        reset(course, steps[0], printed(), yes=True)
    assert (course.steps / steps[0].path).read_text() == source


def test_with_solutions_the_stub_comes_from_them(project: Project, steps: list[Step], tmp_path: Path) -> None:
    (tmp_path / "solutions").symlink_to(project.solutions)
    written = write_stubs(Project(tmp_path), steps)
    assert len(written) == len(steps)
    stub = written[0].read_text()
    written[0].write_text("mine")
    assert reset(Project(tmp_path), steps[0], printed(), yes=True) == 0
    assert written[0].read_text() == stub
    assert write_stubs(Project(tmp_path), steps) == outdated_stubs(Project(tmp_path), steps) == []
    written[0].write_text("mine")
    assert outdated_stubs(Project(tmp_path), steps) == [written[0]]


def test_a_question_without_an_answer_is_a_no(
    course: Project, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    source = _edit(course, steps[0])
    monkeypatch.setattr("sys.stdin.isatty", lambda: True)
    monkeypatch.setattr("builtins.input", lambda _: "")
    assert reset(course, steps[0], printed(), yes=False) == 0
    assert (course.steps / steps[0].path).read_text() == source
    monkeypatch.setattr("sys.stdin.isatty", lambda: False)
    with pytest.raises(UsageError, match="there is no terminal"):
        reset(course, steps[0], printed(), yes=False)
