"""Small releases, and repositories that came from them, for the tests of `update`."""

import zipfile
from collections.abc import Mapping
from pathlib import Path

import pytest

from raysteps.common.files import content_hash
from raysteps.updater.release_list import PLACE, ListedFile, Release, encoded, read_release
from raysteps.updater.source import open_source
from raysteps.updater.update import Changes, Update

STEPS = ("01-a", "02-b", "03-c")
OWN = tuple(f"steps/{step}/{step[3:]}.cpp" for step in STEPS)

OLD = {
    "raysteps": b"#!/bin/sh\nold\n",
    ".vscode/settings.json": b"{}\n",
    "framework/core/ray.hpp": b"old ray\n",
    "framework/core/gone.hpp": b"gone\n",
    "steps/01-a/a.hpp": b"contract\n",
    "steps/01-a/README.md": b"handout\n",
    **{name: f"stub of {name}\n".encode() for name in OWN[:2]},
}
NEW = {
    "raysteps": b"#!/bin/sh\nnew\n",
    ".vscode/settings.json": b"{}\n",
    "framework/core/ray.hpp": b"new ray\n",
    "framework/core/more.hpp": b"more\n",
    "steps/01-a/a.hpp": b"contract\n",
    "steps/01-a/README.md": b"better handout\n",
    OWN[0]: f"stub of {OWN[0]}\n".encode(),
    OWN[1]: b"another stub of b\n",
    OWN[2]: b"stub of c\n",
}
WORK = {OWN[0]: b"my a \xff\r\n\r\n", OWN[1]: b"my b", "notes.txt": b"mine", "steps/01-a/helpers.cpp": b"my\n"}


def release(folder: Path, files: Mapping[str, bytes], steps: tuple[str, ...] = STEPS, course: str = "Course") -> Path:
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    files_listed = [
        ListedFile(name, content_hash(data), "student" if name in OWN else "kit", name == "raysteps")
        for name, data in files.items()
    ]
    (folder / PLACE).parent.mkdir(parents=True, exist_ok=True)
    (folder / PLACE).write_bytes(encoded(Release(course, folder.name, steps, tuple(files_listed))))
    return folder


@pytest.fixture
def mine(tmp_path: Path) -> Path:
    """A repository with work in it."""
    root = release(tmp_path / "mine", OLD, STEPS[:2])
    for name, data in WORK.items():
        (root / name).write_bytes(data)
    return root


@pytest.fixture
def newer(tmp_path: Path) -> Path:
    return release(tmp_path / "newer", NEW)


def update(root: Path, kit: Path) -> Changes:
    old = read_release(root)
    assert old is not None
    with open_source(kit) as source:
        return Update(root, old, source).run()


def files_of(root: Path) -> dict[str, bytes]:
    return {path.relative_to(root).as_posix(): path.read_bytes() for path in root.rglob("*") if path.is_file()}


def zipped(folder: Path, path: Path, outer: str = "", compression: int = zipfile.ZIP_DEFLATED) -> Path:
    with zipfile.ZipFile(path, "w", compression) as archive:
        for name, data in files_of(folder).items():
            archive.writestr(f"{outer}{name}", data)
    return path


def is_all_there(root: Path, work: Mapping[str, bytes]) -> bool:
    """Every byte of the student's, at its place or set aside beside it."""
    there = files_of(root)
    return all(
        data in [content for place, content in there.items() if place == name or place.startswith(f"{name}.mine")]
        for name, data in work.items()
    )


def expect_done(root: Path, newer: Path, work: Mapping[str, bytes]) -> None:
    """The newer kit and the student's work, and nothing else."""
    assert files_of(root) == {**files_of(newer), **work}
