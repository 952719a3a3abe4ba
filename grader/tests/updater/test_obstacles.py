"""What stands in the way of an update is told before the first file is written."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from update_kits import OLD, OWN, STEPS, WORK, files_of, mine, newer, release, update

from raysteps.common.errors import UsageError

__all__ = ["mine", "newer"]  # pytest finds fixtures by name


def _folder_for_a_file(root: Path) -> None:
    (root / "framework/core/more.hpp").mkdir()
    (root / "framework/core/more.hpp/mine.txt").write_text("mine")


def _file_for_a_folder(root: Path) -> None:
    (root / "steps/03-c").write_text("mine")


def _folder_for_a_dropped_file(root: Path) -> None:
    (root / "framework/core/gone.hpp").unlink()
    (root / "framework/core/gone.hpp").mkdir()


def _link_for_a_file(root: Path) -> None:
    (root / "framework/core/ray.hpp").rename(root.parent / "ray.hpp")
    (root / "framework/core/ray.hpp").symlink_to(root.parent / "ray.hpp")


def _link_for_a_folder(root: Path) -> None:
    shutil.move(root / "framework/core", root.parent / "core")
    (root / "framework/core").symlink_to(root.parent / "core")


def _link_for_the_list(root: Path) -> None:
    shutil.move(root / ".raysteps", root.parent / "list")
    (root / ".raysteps").symlink_to(root.parent / "list")


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (_folder_for_a_file, "more.hpp: is a folder"),
        (_file_for_a_folder, "03-c: is a file"),
        (_folder_for_a_dropped_file, "gone.hpp: is a folder"),
        (_link_for_a_file, "ray.hpp: is a link"),
        (_link_for_a_folder, "core: is a link"),
        (_link_for_the_list, "raysteps: is a link"),
    ],
)
def test_what_stands_in_the_way(mine: Path, newer: Path, spoil: Callable[[Path], None], said: str) -> None:
    spoil(mine)
    before = files_of(mine.parent)
    with pytest.raises(UsageError, match=rf"(?s){said}.*Nothing was changed"):
        update(mine, newer)
    assert files_of(mine.parent) == before


def test_a_link_in_a_folder_of_dropped_files(mine: Path, tmp_path: Path) -> None:
    fewer = release(tmp_path / "fewer", {name: OLD[name] for name in OLD if "core" not in name}, STEPS[:2])
    _link_for_a_folder(mine)
    before = files_of(tmp_path)
    with pytest.raises(UsageError, match="is a link"):
        update(mine, fewer)
    assert files_of(tmp_path) == before


@pytest.mark.parametrize("there", [True, False])
def test_a_step_that_is_a_link_to_ones_own_is_left_alone(mine: Path, newer: Path, there: bool) -> None:
    elsewhere = mine.parent / "a.cpp"
    (mine / OWN[0]).rename(elsewhere)
    (mine / OWN[0]).symlink_to(elsewhere)
    if not there:
        elsewhere.unlink()
    update(mine, newer)
    assert (mine / OWN[0]).is_symlink()
    assert elsewhere.exists() == there
    assert not there or elsewhere.read_bytes() == WORK[OWN[0]]
    assert (mine / "framework/core/more.hpp").is_file()


def test_a_folder_that_may_not_be_written_to(mine: Path, newer: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = os.access
    closed = mine / "framework/core"
    monkeypatch.setattr(os, "access", lambda path, mode: Path(path) != closed and real(path, mode))
    before = files_of(mine)
    with pytest.raises(UsageError, match=r"core: cannot be written to.*Nothing was changed"):
        update(mine, newer)
    assert files_of(mine) == before


def test_a_file_that_cannot_be_read(mine: Path, newer: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = Path.read_bytes

    def reading(path: Path) -> bytes:
        if path == mine / OWN[1]:
            raise PermissionError(13, "Permission denied", str(path))
        return real(path)

    before = files_of(mine)
    monkeypatch.setattr(Path, "read_bytes", reading)
    with pytest.raises(UsageError, match=r"b.cpp: no permission. Nothing was changed"):
        update(mine, newer)
    monkeypatch.undo()
    assert files_of(mine) == before
