"""What the command `update` says, and which repository it changes."""

import errno
import os
import re
from pathlib import Path
from types import SimpleNamespace

import pytest
from rich.console import Console
from update_kits import NEW, OLD, OWN, STEPS, WORK, expect_done, files_of, mine, newer, release

from raysteps.cli import update as command
from raysteps.cli.app import main, new_parser
from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import content_hash
from raysteps.course.project import Project
from raysteps.updater.release_list import PLACE, about_changed, changed_files

__all__ = ["mine", "newer"]  # pytest finds fixtures by name


def _run(root: Path, *words: object) -> int:
    arguments = new_parser(Project(root)).parse_args(["update", *map(str, words)])
    return command.run(Project(root), arguments, Console(width=10_000))


def test_it_names_what_it_did(mine: Path, newer: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (mine / "framework/core/ray.hpp").write_bytes(b"my ray\n")
    (mine / "framework/core/gone.hpp").write_bytes(b"my gone\n")
    (mine / OWN[0]).unlink()
    (mine / OWN[2]).parent.mkdir()
    (mine / OWN[2]).write_bytes(b"my c")
    before, after = (content_hash((root / PLACE).read_bytes())[:12] for root in (mine, newer))
    assert _run(mine, newer) == 0
    assert capsys.readouterr().out.splitlines() == [
        "Files of the kit: 3 replaced, 1 added, 0 removed.",
        "New: 03-c.",
        "framework/core/ray.hpp was not as released. It is now; what it was is kept as framework/core/ray.hpp.mine",
        "The kit has no framework/core/gone.hpp any more. Yours was not as released, and is kept as "
        "framework/core/gone.hpp.mine",
        "steps/01-a/a.cpp was not there; the stub is put back",
        "steps/02-b/b.cpp is as you left it, but its stub is another one now: compare with grader/stubs/02-b/b.cpp",
        "steps/03-c/c.cpp is as you left it, but the kit has a stub for it now: compare with grader/stubs/03-c/c.cpp",
        "Your own files are as they were: steps/01-a/helpers.cpp, steps/02-b/b.cpp, steps/03-c/c.cpp and notes.txt.",
        f"Course: from release {before} with 2 steps to release {after} with 3 steps.",
    ]
    assert _run(mine, newer) == 0
    assert capsys.readouterr().out.splitlines() == [
        "The kit is up to date: nothing had to be changed.",
        "Your own files are as they were: steps/01-a/helpers.cpp, steps/02-b/b.cpp, steps/03-c/c.cpp, "
        "framework/core/gone.hpp.mine, framework/core/ray.hpp.mine and 1 more.",
        f"Course: release {after} with 3 steps.",
    ]


def test_files_of_the_kit_that_a_check_goes_by_are_named_when_they_changed(mine: Path, tmp_path: Path) -> None:
    assert about_changed(mine) == ""
    (mine / "framework/core/ray.hpp").write_bytes(b"old ray\r\n")  # as Windows writes it
    (mine / "README.md").write_bytes(b"mine\n")
    assert about_changed(mine) == ""
    (mine / "framework/core/ray.hpp").write_bytes(b"my ray\n")
    (mine / "framework/core/gone.hpp").unlink()
    assert changed_files(mine) == ["framework/core/ray.hpp", "framework/core/gone.hpp"]
    assert "not handed in: framework/core/ray.hpp, framework/core/gone.hpp. Your course" in about_changed(mine)
    assert about_changed(tmp_path) == ""
    (mine / PLACE).write_bytes(b"<<<<<<< HEAD\n" + (mine / PLACE).read_bytes())
    assert about_changed(mine) == "", "a check goes on without its list"


def test_a_fault_names_files_of_the_kit_that_changed(
    mine: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    faults: list[Exception] = [OSError(errno.ENOSPC, "no room")]
    faults += 2 * [GraderFault("a part of the kit cannot be linked: primary_ray")]

    def fail(*_: object) -> int:
        raise faults.pop()

    monkeypatch.setattr("raysteps.cli.app.here", lambda: Project(mine))
    monkeypatch.setattr("raysteps.cli.app._module", lambda *_: SimpleNamespace(run_words=fail))
    assert main(["list"]) == 4
    assert "not handed in" not in capsys.readouterr().err
    (mine / "framework/core/ray.hpp").write_bytes(b"my ray\n")
    assert main(["list"]) == 4
    assert "not handed in: framework/core/ray.hpp. " in capsys.readouterr().err
    assert main(["list"]) == 4
    assert "not handed in" not in capsys.readouterr().err, "there was no room"


def test_what_setting_up_made_is_not_the_students_own(
    tmp_path: Path, newer: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    root = release(tmp_path / "untouched", OLD, STEPS[:2])
    for name in (".venv/a", "build/b", ".git/c", "grader/__pycache__/d", "grader/raysteps.egg-info/e"):
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_bytes(b"made")
    assert _run(root, newer) == 0
    assert "Your own files are as they were: there are none yet.\n" in capsys.readouterr().out


def test_two_kits_that_differ_in_one_handout_have_two_names(
    mine: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Though they were made from the same framework and tests."""
    other = release(tmp_path / "again" / "mine", OLD | {"steps/01-a/README.md": b"better handout\n"}, STEPS[:2])
    assert _run(mine, other) == 0
    said = capsys.readouterr().out
    found = re.search(r"from release (\w{12}) with 2 steps to release (\w{12}) with 2 steps\.", said)
    assert found is not None
    assert found[1] != found[2]


def test_an_older_kit_is_called_so(mine: Path, newer: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    _run(mine, newer)
    _run(mine, release(tmp_path / "older", OLD, STEPS[:2]))
    assert "This kit has no 03-c. If it is an older one" in capsys.readouterr().out


def test_another_course_is_asked_about(mine: Path, tmp_path: Path) -> None:
    other = release(tmp_path / "other", NEW, course="Painting")
    before = files_of(mine)
    with pytest.raises(UsageError, match=r'"Painting".*"Course".*--course-changed'):
        _run(mine, other)
    assert files_of(mine) == before
    assert _run(mine, other, "--course-changed") == 0
    expect_done(mine, other, WORK)


def test_a_newer_kit_brings_itself(mine: Path, newer: Path) -> None:
    assert _run(newer, "--into", mine) == 0
    expect_done(mine, newer, WORK)


def test_into_a_repository_that_is_named_from_where_one_is(
    mine: Path, newer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(mine / "steps")
    assert _run(newer, "--into", os.pardir) == 0
    expect_done(mine, newer, WORK)


@pytest.mark.parametrize("around", [False, True])
def test_the_repository_itself_is_no_newer_kit(mine: Path, around: bool) -> None:
    with pytest.raises(UsageError, match="is this repository"):
        _run(mine, mine.parent if around else mine)


def test_without_a_kit(mine: Path) -> None:
    with pytest.raises(UsageError, match="expected a newer release"):
        _run(mine)


def test_what_came_from_no_release_is_not_updated(tmp_path: Path, newer: Path) -> None:
    with pytest.raises(
        UsageError, match=r"release\.json: is not there; expected a repository that came from a release"
    ):
        _run(tmp_path, newer)


def test_a_full_disk(mine: Path, newer: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = Path.replace

    def replacing(path: Path, target: Path) -> Path:
        if target.name == "more.hpp":
            raise OSError(28, "No space left on device", str(target))
        return real(path, target)

    monkeypatch.setattr(Path, "replace", replacing)
    with pytest.raises(UsageError, match=r"more\.hpp: the disk is full\. Your work is as it was\. Mend that"):
        _run(mine, newer)
    monkeypatch.undo()
    assert (mine / PLACE).read_bytes() != (newer / PLACE).read_bytes()
    assert _run(mine, newer) == 0
    expect_done(mine, newer, WORK)
