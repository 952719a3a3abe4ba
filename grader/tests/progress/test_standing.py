"""The commands `list` and `next`."""

from pathlib import Path
from typing import Any

import pytest
from course_fakes import checked, printed, small_project, text, write_own

from raysteps.cli import app as cli
from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project, here
from raysteps.progress.hints import print_hint
from raysteps.progress.standing import list_steps, load_progress, next_of, next_step, save_progress, standings
from raysteps.submission import load

_CODE = "int answer() { return 42; }\n"


@pytest.fixture
def course(tmp_path: Path) -> Project:
    return small_project(tmp_path)


def _check(course: Project, step: Step, status: str, points: float, source: str = _CODE) -> None:
    write_own(course, step, source)
    save_progress(course, checked(step, status, points), {step.id: source.encode()})


def _words(course: Project) -> list[str]:
    return [standing.words for standing in standings(course)]


def _next(course: Project) -> str | None:
    step = next_of(standings(course))
    return None if step is None else step.number


def test_at_the_beginning(course: Project) -> None:
    console = printed()
    assert list_steps(course, console) == 0
    assert text(console).count("not started") == 9
    assert "→  01" in text(console)
    assert text(console).endswith("next: ./raysteps watch 01\n")


def test_points_are_those_that_check_shows(course: Project, steps: list[Step]) -> None:
    """A students' kit sees less than the whole kit, in which there are hidden cases."""
    for kit, points in ((course, "6.5"), (here(), "10")):
        console = printed()
        list_steps(kit, console)
        assert f"01 Camera rays {points} " in " ".join(text(console).split())
        assert ("Points of the visible part" in text(console)) != kit.has_reference
    console = printed()
    next_step(course, console)
    assert text(console).startswith("01 Camera rays (6.5 points)")


def test_comments_and_line_ends_are_no_start(course: Project, steps: list[Step]) -> None:
    stub = (course.stubs / steps[0].path).read_text()
    (course.steps / steps[0].path).write_bytes(("// by Ann\n" + stub).replace("\n", "\r\n").encode("utf-16"))
    assert _words(course)[0] == "not started"


def test_what_the_last_check_said(course: Project, steps: list[Step]) -> None:
    _check(course, steps[0], "passed", 10)
    _check(course, steps[1], "partial", 12.5)
    _check(course, steps[2], "does-not-build", 0)
    write_own(course, steps[3], _CODE)
    assert _words(course)[:5] == [
        "passed",
        "partly right, 12.5 of 20",
        "does not build, 0 of 15",
        "not checked yet",
        "not started",
    ]
    assert _next(course) == "02"


def test_next_says_that_a_step_does_not_build(course: Project, steps: list[Step]) -> None:
    _check(course, steps[0], "does-not-build", 0)
    console = printed()
    next_step(course, console)
    assert "(it does not build: ./raysteps check 01 shows where)" in text(console)
    write_own(course, steps[0], _CODE + "int more;\n")
    console = printed()
    next_step(course, console)
    assert "it does not build" not in text(console)


def test_a_changed_file_is_not_what_was_checked(course: Project, steps: list[Step]) -> None:
    _check(course, steps[0], "passed", 10)
    write_own(course, steps[0], "// a remark\n" + _CODE)
    assert _words(course)[0] == "passed"
    write_own(course, steps[0], _CODE.replace("42", "43"))
    assert _words(course)[0] == "changed since the last check (passed, 10 of 10)"
    assert _next(course) == "01"
    write_own(course, steps[0], _CODE)
    assert _words(course)[0] == "passed"


def test_a_bonus_comes_when_the_others_are_done(course: Project, steps: list[Step]) -> None:
    for step in steps:
        if not step.bonus and step.number != "05":
            _check(course, step, "passed", step.points)
    assert _next(course) == "05"
    _check(course, steps[4], "passed", 15)
    assert _next(course) == "08"
    for step in steps:
        _check(course, step, "passed", step.points)
    assert _next(course) is None
    console = printed()
    assert list_steps(course, console) == next_step(course, console) == 0
    assert text(console).count("All steps are done") == 2


def test_the_step_after_one_that_is_still_open(course: Project, steps: list[Step]) -> None:
    found = standings(course)
    following = [next_of(found, after=step) for step in steps]
    assert [step.number for step in following if step] == ["02", "03", "04", "05", "06", "07", "08", "09", "01"]


def test_what_to_do_next(course: Project, steps: list[Step], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(course.root)
    console = printed()
    assert next_step(course, console) == 0
    assert text(console).splitlines() == [
        "01 Camera rays (6.5 points): not started",
        "  read   steps/01-camera-rays/README.md",
        "  write  steps/01-camera-rays/camera_rays.cpp (point_at, view_frame and primary_ray are still to be written)",
        "  type   ./raysteps watch 01",
        "  stuck  ./raysteps hint 01",
    ]


@pytest.mark.parametrize("command", ["list", "next", "hint"])
def test_below_the_kits_folder_the_way_up_to_the_command_is_told(
    course: Project, steps: list[Step], command: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(course.steps / steps[0].id)
    commands = {"list": list_steps, "next": next_step, "hint": lambda *words: print_hint(words[0], steps[0], words[1])}
    console = printed()
    assert commands[command](course, console) == 0
    assert " ../../raysteps " in text(console)
    assert " ./raysteps" not in text(console)


@pytest.mark.parametrize(
    ("data", "words"), [(None, "the file is not there"), (b"\x7fELF\0\0", "cannot be read as text")]
)
def test_a_file_that_is_gone_or_no_text(course: Project, steps: list[Step], data: bytes | None, words: str) -> None:
    path = course.steps / steps[0].path
    path.unlink() if data is None else path.write_bytes(data)
    assert words in _words(course)[0]
    for command in (next_step, list_steps):
        console = printed()
        command(course, console)
        assert "./raysteps reset 01" in text(console)


def test_a_file_with_a_txt_behind_its_name_is_not_to_be_reset(course: Project, steps: list[Step]) -> None:
    """As editors of Windows save it. `check` says how it has to be called."""
    path = course.steps / steps[0].path
    path.rename(path.with_name(f"{path.name}.txt"))
    console = printed()
    next_step(course, console)
    assert "the file is not there" in text(console)
    assert "type   ./raysteps check 01" in text(console)


def test_a_file_that_check_finds_elsewhere_is_not_to_be_reset(course: Project, steps: list[Step]) -> None:
    path = course.steps / steps[0].path
    path.write_text("int my_work = 1;\n", encoding="utf-8")
    path.rename(course.steps / path.name)
    console = printed()
    next_step(course, console)
    assert "type   ./raysteps check 01" in text(console)


def test_files_that_are_missing_are_looked_for_once(
    course: Project, steps: list[Step], monkeypatch: pytest.MonkeyPatch
) -> None:
    walks: list[Path] = []
    really = load._reader

    def counted(folder: Path) -> Any:
        walks.append(folder)
        return really(folder)

    monkeypatch.setattr(load, "_reader", counted)
    for step in steps[:3]:
        path = course.steps / step.path
        path.rename(path.with_name(f"{path.name}.txt"))
    assert all("txt" in standing.closed for standing in standings(course)[:3])
    assert walks == [course.steps]


def test_what_is_only_closed_is_not_to_be_reset(course: Project, steps: list[Step]) -> None:
    """A folder in the place of the file: as with a file that is not to be read, the work may be there."""
    path = course.steps / steps[0].path
    path.unlink()
    path.mkdir()
    assert _words(course)[0].startswith("the file cannot be read: ")
    for command in (next_step, list_steps):
        console = printed()
        command(course, console)
        assert "./raysteps check 01" in text(console)
        assert "reset" not in text(console)


@pytest.mark.parametrize("damage", ["", "[]", '{"schema": "other", "steps": {}}', '{"schema": "raysteps/progress/v1"}'])
def test_a_damaged_memory_is_none(course: Project, steps: list[Step], damage: str) -> None:
    _check(course, steps[0], "passed", 10)
    (course.build / "progress.json").write_text(damage)
    assert load_progress(course) == {}
    assert _words(course)[0] == "not checked yet"
    _check(course, steps[0], "passed", 10)
    assert _words(course)[0] == "passed"


def test_a_step_that_was_not_handed_in_is_not_remembered(course: Project, steps: list[Step]) -> None:
    save_progress(course, checked(steps[0], "not-started", 0), {})
    assert load_progress(course) == {}


def test_from_the_command_line(
    course: Project, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(cli, "here", lambda: course)
    assert [cli.main([word]) for word in ("list", "next", "hint")] == [0, 0, 0]
    assert "Camera rays, hint 1 of 3" in capsys.readouterr().out
    assert cli.main(["hint", "10"]) == 2
    assert "there is no step '10'" in capsys.readouterr().err
    assert len(read_steps(course)) == 9
