"""An update of a students' repository changes the kit's files and nothing of the student's."""

import argparse
import shutil
import zipfile
from collections.abc import Mapping
from pathlib import Path

import pytest
from rich.console import Console

from raysteps.commands import update as command
from raysteps.common.errors import UsageError
from raysteps.common.files import write_bytes
from raysteps.kit.project import Project
from raysteps.students import updating
from raysteps.students.listing import PLACE, Listed, Release, encoded, mark, read_release
from raysteps.students.source import open_source
from raysteps.students.updating import Changes, Update

STEPS = ("01-a", "02-b", "03-c")
OWN = tuple(f"steps/{step}/{step[3:]}.cpp" for step in STEPS)


def _release(folder: Path, files: Mapping[str, bytes], steps: tuple[str, ...] = STEPS) -> Path:
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    listed = [
        Listed(name, mark(data), "student" if name in OWN else "kit", name == "raysteps")
        for name, data in files.items()
    ]
    (folder / PLACE).parent.mkdir(parents=True, exist_ok=True)
    (folder / PLACE).write_bytes(encoded(Release("Course", "k", steps, tuple(listed))))
    return folder


OLD = {
    "raysteps": b"#!/bin/sh\nold\n",
    "framework/core/ray.hpp": b"old ray\n",
    "framework/core/gone.hpp": b"gone\n",
    "steps/01-a/a.hpp": b"contract\n",
    "steps/01-a/README.md": b"handout\n",
    **{name: f"stub of {name}\n".encode() for name in OWN[:2]},
}
NEW = {
    "raysteps": b"#!/bin/sh\nnew\n",
    "framework/core/ray.hpp": b"new ray\n",
    "framework/core/more.hpp": b"more\n",
    "steps/01-a/a.hpp": b"contract\n",
    "steps/01-a/README.md": b"better handout\n",
    OWN[0]: f"stub of {OWN[0]}\n".encode(),
    OWN[1]: b"another stub of b\n",
    OWN[2]: b"stub of c\n",
}
WORK = {OWN[0]: b"my a \xff\r\n\r\n", OWN[1]: b"my b", "notes.txt": b"mine"}


@pytest.fixture
def mine(tmp_path: Path) -> Path:
    """A repository with work in every step, and in a file of the kit."""
    root = _release(tmp_path / "mine", OLD, STEPS[:2])
    for name, data in WORK.items():
        (root / name).write_bytes(data)
    (root / "framework/core/ray.hpp").write_bytes(b"my ray\n")
    return root


@pytest.fixture
def newer(tmp_path: Path) -> Path:
    return _release(tmp_path / "newer", NEW)


def _update(root: Path, kit: Path) -> Changes:
    old = read_release(root)
    assert old is not None
    with open_source(kit) as source:
        return Update(root, old, source).run()


def _files(root: Path) -> dict[str, bytes]:
    return {path.relative_to(root).as_posix(): path.read_bytes() for path in root.rglob("*") if path.is_file()}


def _expect_done(mine: Path, newer: Path) -> None:
    expected = {**_files(newer), **WORK, "framework/core/ray.hpp.mine": b"my ray\n"}
    assert _files(mine) == expected


def test_work_in_every_step_stays_byte_for_byte(mine: Path, newer: Path) -> None:
    changes = _update(mine, newer)
    _expect_done(mine, newer)
    assert changes.kept == ["framework/core/ray.hpp.mine"]
    assert changes.removed == ["framework/core/gone.hpp"]
    assert changes.stubs == [OWN[1]]
    assert (mine / "raysteps").stat().st_mode & 0o111


def test_once_more_changes_nothing(mine: Path, newer: Path) -> None:
    _update(mine, newer)
    before = _files(mine)
    assert not _update(mine, newer).any
    assert _files(mine) == before


def test_a_stub_that_nobody_touched_is_replaced(tmp_path: Path, newer: Path) -> None:
    root = _release(tmp_path / "fresh", OLD, STEPS[:2])
    _update(root, newer)
    assert _files(root) == _files(newer)


def test_interrupted_at_any_file_and_called_again(
    mine: Path, newer: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    real = write_bytes
    ended = False
    for most in range(12):
        root = tmp_path / f"try{most}"
        shutil.copytree(mine, root)
        left = [most]

        def failing(path: Path, data: bytes, left: list[int] = left) -> None:
            if not left[0]:
                raise KeyboardInterrupt
            left[0] -= 1
            real(path, data)

        monkeypatch.setattr(updating, "write_bytes", failing)
        try:
            _update(root, newer)
            ended = True
        except KeyboardInterrupt:
            assert {name: (root / name).read_bytes() for name in WORK} == WORK
        monkeypatch.setattr(updating, "write_bytes", real)
        _update(root, newer)
        _expect_done(root, newer)
    assert ended, "no update came to its end by itself"


def test_lines_that_git_ended_otherwise_are_not_the_students(tmp_path: Path, newer: Path) -> None:
    root = _release(tmp_path / "windows", OLD, STEPS[:2])
    for name in OLD:
        (root / name).write_bytes(OLD[name].replace(b"\n", b"\r\n"))
    assert _update(root, newer).kept == []


def test_from_a_zip_with_an_outer_folder(mine: Path, newer: Path, tmp_path: Path) -> None:
    path = tmp_path / "newer.zip"
    with zipfile.ZipFile(path, "w") as archive:
        for name, data in _files(newer).items():
            archive.writestr(f"kit-2/{name}", data)
    _update(mine, path)
    _expect_done(mine, newer)


@pytest.mark.parametrize("spoil", ["cut", "missing", "outside", "not-a-release"])
def test_a_kit_that_is_not_whole_changes_nothing(mine: Path, newer: Path, spoil: str) -> None:
    before = _files(mine)
    match spoil:
        case "cut":
            (newer / OWN[2]).write_bytes(b"st")
        case "missing":
            (newer / OWN[2]).unlink()
        case "outside":
            text = (newer / PLACE).read_text()
            (newer / PLACE).write_text(text.replace("framework/core/more.hpp", "../more.hpp"))
        case _:
            (newer / PLACE).unlink()
    with pytest.raises(UsageError):
        _update(mine, newer)
    assert _files(mine) == before


def test_a_link_does_not_lead_out_of_the_repository(mine: Path, newer: Path, tmp_path: Path) -> None:
    outside = tmp_path / "outside"
    outside.mkdir()
    shutil.rmtree(mine / "framework" / "core")
    (mine / "framework" / "core").symlink_to(outside)
    with pytest.raises(UsageError, match="is a link"):
        _update(mine, newer)
    assert not any(outside.iterdir())


def test_the_command_names_what_it_kept_and_what_is_new(
    mine: Path, newer: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = argparse.Namespace(kit=newer)
    assert command.run(Project(mine), arguments, Console(width=200)) == 0
    said = capsys.readouterr().out
    for words in ("framework/core/ray.hpp.mine", "New: 03-c", "steps/02-b/b.cpp is as you left it"):
        assert words in said


def test_the_whole_kit_is_not_updated(tmp_path: Path, newer: Path) -> None:
    with pytest.raises(UsageError, match="came from a release"):
        command.run(Project(tmp_path), argparse.Namespace(kit=newer), Console())
