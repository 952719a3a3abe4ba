"""A release in which somebody set up and tried the kit: what that made is not searched, and this is told."""

import argparse
import subprocess
from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from raysteps.cli import release
from raysteps.common.errors import UsageError
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.release.leaks import find_leaks, not_searched, to_search
from raysteps.release.secrets import NgramIndex, Secrets

_PROGRAM = b"\x7fELF\2\1\1\0"  # a leak wherever it is searched
_MADE = (".venv/bin/python", "build/release/bin/raytrace", "grader/src/raysteps.egg-info/SOURCES.txt",
         "grader/src/raysteps/__pycache__/cli.pyc", "scenes/__pycache__/generate.pyc")  # fmt: skip
_OTHER = ("docs/build/a.o", "steps/.venv/b", "notes/.git/c", "x.egg-info", "raysteps")


def _write(folder: Path, *names: str) -> Path:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(_PROGRAM)
    return folder


def _places(folder: Path, *, tried: bool) -> set[str]:
    return {leak.place for leak in find_leaks(Secrets(NgramIndex(), {}, None), folder, tried=tried)}


def _checked(project: Project, folder: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[int, str]:
    monkeypatch.setattr(release, "gather", lambda _: Secrets(NgramIndex(), {}, None))
    console = Console(width=200, record=True, file=StringIO())
    code = release.run(project, argparse.Namespace(check=folder), console)
    return code, console.export_text()


def test_only_what_setting_up_makes_is_left_out(tmp_path: Path) -> None:
    _write(tmp_path, *_MADE, *_OTHER)
    found = to_search(tmp_path, tried=True)
    assert {path.relative_to(tmp_path).as_posix() for path in found if path.is_file()} == set(_OTHER)
    assert not_searched(tmp_path) == ".venv, build, grader/src/raysteps.egg-info and 2 folders __pycache__"
    assert _places(tmp_path, tried=True) == set(_OTHER)


def test_in_a_new_release_nothing_is_left_out(tmp_path: Path) -> None:
    _write(tmp_path, *_MADE, *_OTHER)
    assert _places(tmp_path, tried=False) == {*_MADE, *_OTHER}


def test_a_link_or_a_file_of_such_a_name_is_searched(tmp_path: Path) -> None:
    _write(tmp_path / "elsewhere", "a")
    _write(tmp_path / "kit", "build")
    (tmp_path / "kit" / ".venv").symlink_to(tmp_path / "elsewhere")
    assert not_searched(tmp_path / "kit") == ""
    assert _places(tmp_path / "kit", tried=True) == {".venv", "build"}


def test_a_release_has_no_links(tmp_path: Path) -> None:
    """Whoever packs it may follow them, to wherever they lead."""
    (tmp_path / "kit").mkdir()
    (tmp_path / "kit" / "docs").symlink_to(tmp_path / "solved")
    assert _places(tmp_path / "kit", tried=True) == {"docs"}


def test_a_check_that_left_something_out_is_none(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "README.md").write_text("nothing\n", encoding="utf-8")
    subprocess.run(["git", "init", "--quiet", tmp_path], check=True)
    assert _checked(project, tmp_path, monkeypatch) == (0, "No solution was found in it.\n")

    _write(tmp_path, ".venv/bin/python", "build/x")
    code, said = _checked(project, tmp_path, monkeypatch)
    assert code == 1
    assert "No solution was found in what was searched.\nNot searched: .venv and build. " in said
    assert "Take them away and check again" in said

    _write(tmp_path, "raytrace")
    code, said = _checked(project, tmp_path, monkeypatch)
    assert code == 1
    assert "No solution" not in said
    assert "leak  raytrace: something compiled" in said
    assert "Not searched: .venv and build" in said


def test_a_folder_that_cannot_be_looked_through_is_told(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="gone: cannot be looked through: it is not there"):
        to_search(tmp_path / "gone", tried=True)


def test_one_number_is_said_to_begin_with_the_first_step(
    project: Project, steps: list[Step], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def built(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(release, "written_files", built)
    for names, words in ((["3"], "steps 1-3: a kit begins with step 01\n"), (["1-3"], ""), (["1"], ""), ([], "")):
        console = Console(width=200, record=True, file=StringIO())
        arguments = argparse.Namespace(check=None, out=tmp_path / "new", steps=names, course="Course", play=None)
        with pytest.raises(KeyboardInterrupt):
            release.run(project, arguments, console)
        assert console.export_text() == words
