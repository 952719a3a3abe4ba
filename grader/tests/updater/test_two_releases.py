"""An update between two releases as a course makes them, by the modules that a student has."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from update_kits import files_of, zipped

from raysteps.common.files import content_hash
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.course.stubs import pristine_stub
from raysteps.release import contents
from raysteps.release.build_release import first_steps, write_release
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.updater.release_list import read_release

FIRST, SECOND, THIRD = (
    "steps/01-camera-rays/camera_rays.cpp",
    "steps/02-intersection/intersection.cpp",
    "steps/03-phong-shading/phong_shading.cpp",
)
RAY = "framework/core/ray.hpp"
CRLF = b'#include "mine.hpp"\r\n// my second step\xff\r\n'
BESIDE = {
    "notes.txt": b"what I learned\r\n",
    "steps/01-camera-rays/mine.hpp": b"#pragma once\n",
    ".git/HEAD": b"ref: refs/heads/main\n",
    "build/check/results.json": b"{}",
    ".vscode/settings.json": b'{"editor.fontSize": 20}\n',
}


@pytest.fixture(scope="module")
def old(kit: BuiltKit, steps: list[Step], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("old") / "course"
    write_release(kit, first_steps(["1-2"], steps), "Graphics 101", folder)
    return folder


@pytest.fixture(scope="module")
def new(kit: BuiltKit, steps: list[Step], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two more steps, and the stub of the second is another one."""

    def stub(project: Project, step: Step) -> str:
        return pristine_stub(project, step) + ("// another stub\n" if step.number == "02" else "")

    folder = tmp_path_factory.mktemp("new") / "course"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(contents, "pristine_stub", stub)
        write_release(kit, first_steps(["1-4"], steps), "Graphics 101", folder)
    return folder


@pytest.fixture
def mine(old: Path, tmp_path: Path) -> Path:
    """With files of the student's own, and a file of the kit that the student changed."""
    root = tmp_path / "mine"
    shutil.copytree(old, root)
    for name, data in BESIDE.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_bytes(data)
    (root / RAY).write_bytes(b"// my ray\n")
    return root


def _update(root: Path, *words: object, by: Path | None = None) -> str:
    """By the modules of that repository: its own, which are replaced meanwhile, or those of the newer kit."""
    environment = {**os.environ, "PYTHONPATH": str((by or root) / "grader" / "src"), "PYTHONDONTWRITEBYTECODE": "1"}
    line = [sys.executable, "-P", "-m", "raysteps", "update", *map(str, words)]
    done = subprocess.run(line, cwd=root, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def _both_begun(root: Path) -> dict[str, bytes]:
    work = {FIRST: (root / FIRST).read_bytes() + b"// my first step\n", SECOND: CRLF}
    for name, data in work.items():
        (root / name).write_bytes(data)
    return work


def _deleted(root: Path) -> dict[str, bytes]:
    (root / SECOND).write_bytes(CRLF)
    (root / FIRST).unlink()
    return {SECOND: CRLF}


def _renamed(root: Path) -> dict[str, bytes]:
    (root / SECOND).write_bytes(CRLF)
    (root / SECOND).rename(root / "steps/02-intersection/my_intersection.cpp")
    return {"steps/02-intersection/my_intersection.cpp": CRLF}


def _before_its_time(root: Path) -> dict[str, bytes]:
    (root / THIRD).parent.mkdir()
    (root / THIRD).write_bytes(b"// I could not wait\n")
    return {THIRD: b"// I could not wait\n"}


@pytest.mark.parametrize("begin", [_both_begun, _deleted, _renamed, _before_its_time])
def test_two_more_steps(mine: Path, new: Path, begin: Callable[[Path], dict[str, bytes]]) -> None:
    work = begin(mine)
    said = _update(mine, new)
    assert files_of(mine) == {**files_of(new), **BESIDE, **work, f"{RAY}.mine": b"// my ray\n"}
    assert "New: 03-phong-shading and 04-shadows." in said
    assert ("intersection.cpp is as you left it, but its stub is another one now" in said) == (SECOND in work)
    assert os.access(mine / "raysteps", os.X_OK)
    again = _update(mine, new)
    assert "nothing had to be changed" in again


def test_with_the_lines_of_windows_from_a_zip(mine: Path, new: Path, tmp_path: Path) -> None:
    """As git checks the files out there."""
    work = _both_begun(mine)
    files = read_release(mine)
    assert files is not None
    for name in (file.path for file in files.files):
        data = (mine / name).read_bytes()
        if b"\0" not in data and b"\r" not in data and name not in (*work, *BESIDE):
            (mine / name).write_bytes(data.replace(b"\n", b"\r\n"))
    _update(mine, zipped(new, tmp_path / "new.zip", "course/"))
    there = files_of(mine)
    assert {name: there.pop(name) for name in (*work, *BESIDE)} == {**BESIDE, **work}
    assert there.pop(f"{RAY}.mine") == b"// my ray\r\n"
    expected = files_of(new).items()
    own = (*work, *BESIDE)
    assert {name: content_hash(data) for name, data in there.items()} == {
        name: content_hash(data) for name, data in expected if name not in own
    }


def test_the_newer_kit_does_it_itself(mine: Path, new: Path) -> None:
    work = _both_begun(mine)
    _update(mine, "--into", ".", by=new)
    assert files_of(mine) == {**files_of(new), **BESIDE, **work, f"{RAY}.mine": b"// my ray\n"}


def test_back_to_fewer_steps_and_forth_again(mine: Path, old: Path, new: Path) -> None:
    _update(mine, new)
    work = {**_both_begun(mine), THIRD: b"// my third step\n"}
    (mine / THIRD).write_bytes(work[THIRD])
    said = _update(mine, old)
    assert "This kit has no 03-phong-shading and 04-shadows" in said
    assert f"The kit has no {THIRD} any more; yours is still there" in said
    assert files_of(mine) == {**files_of(old), **BESIDE, **work, f"{RAY}.mine": b"// my ray\n"}
    _update(mine, new)
    assert files_of(mine) == {**files_of(new), **BESIDE, **work, f"{RAY}.mine": b"// my ray\n"}
