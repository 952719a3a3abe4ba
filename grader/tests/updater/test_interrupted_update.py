"""An update that is interrupted anywhere loses nothing, and the next one ends it."""

import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from update_kits import NEW, OLD, OWN, STEPS, WORK, expect_done, files_of, is_all_there, release, update

from raysteps.common.errors import UsageError
from raysteps.updater.release_list import PLACE

MINE = {**WORK, "framework/core/ray.hpp.mine": b"my ray\n", "framework/core/gone.hpp.mine": b"my own gone\n"}
TOUCHED = {"framework/core/ray.hpp": b"my ray\n", "framework/core/gone.hpp": b"my own gone\n"}
THIRD = {**NEW, "framework/core/ray.hpp": b"third ray\n", OWN[2]: b"third stub of c\n"}
del THIRD["framework/core/more.hpp"]


@pytest.fixture
def mine(tmp_path: Path) -> Path:
    root = release(tmp_path / "mine", OLD, STEPS[:2])
    for name, data in {**WORK, **TOUCHED}.items():
        (root / name).write_bytes(data)
    (root / "raysteps").chmod(0o444)
    return root


@pytest.fixture
def newer(tmp_path: Path) -> Path:
    return release(tmp_path / "newer", NEW)


@contextmanager
def _ending_after(most: int, end: BaseException) -> Iterator[None]:
    """Of all that changes something on the disk only so much is done."""
    left = [most]
    with pytest.MonkeyPatch.context() as patch:
        for name in ("replace", "unlink", "chmod", "mkdir", "rmdir"):
            real: Callable[..., Any] = getattr(Path, name)

            def counted(path: Path, *words: Any, real: Callable[..., Any] = real, **more: Any) -> Any:
                left[0] -= 1
                if left[0] < 0:
                    raise end
                return real(path, *words, **more)

            patch.setattr(Path, name, counted)
        yield


def _interrupted(mine: Path, kit: Path, folder: Path, end: BaseException) -> Iterator[Path]:
    """Copies of the repository: after one change on the disk, after two, and so on to the last."""
    for most in range(200):
        root = folder / f"try{most}"
        shutil.copytree(mine, root)
        try:
            with _ending_after(most, end):
                update(root, kit)
        except (KeyboardInterrupt, UsageError):
            yield root
        else:
            assert most >= 30
            return
    pytest.fail("no update came to its end by itself")


def _is_done(root: Path, kit: Path) -> bool:
    """But for taking the tools away."""
    return (root / PLACE).read_bytes() == (kit / PLACE).read_bytes()


@pytest.mark.parametrize("end", [KeyboardInterrupt(), OSError(28, "No space left on device")])
def test_interrupted_anywhere_and_called_again(mine: Path, newer: Path, tmp_path: Path, end: BaseException) -> None:
    for root in _interrupted(mine, newer, tmp_path, end):
        assert is_all_there(root, {**WORK, **TOUCHED})
        was_over = _is_done(root, newer) and len(list(root.glob(".raysteps/unfinished/*.json"))) < 2
        changes = update(root, newer)
        expect_done(root, newer, MINE)
        assert was_over or sorted([*changes.kept, *changes.outdated]) == sorted(set(MINE) - set(WORK))


def test_interrupted_and_then_another_kit(mine: Path, newer: Path, tmp_path: Path) -> None:
    """What the kit between wrote is not taken for the student's."""
    third = release(tmp_path / "third", THIRD)
    for root in _interrupted(mine, newer, tmp_path, KeyboardInterrupt()):
        was_done = _is_done(root, newer)
        changes = update(root, third)
        expect_done(root, third, MINE)
        assert changes.stubs == ([] if was_done else [OWN[1]])
        assert changes.met == []


def test_interrupted_and_then_the_old_kit(mine: Path, newer: Path, tmp_path: Path) -> None:
    old = release(tmp_path / "old", OLD, STEPS[:2])
    for root in _interrupted(mine, newer, tmp_path, KeyboardInterrupt()):
        update(root, old)
        assert is_all_there(root, {**WORK, **TOUCHED})
        assert {name: files_of(root)[name] for name in OLD} == {**OLD, OWN[0]: WORK[OWN[0]], OWN[1]: WORK[OWN[1]]}
        assert not list(root.glob("steps/03*"))


def test_what_a_killed_update_left_is_taken_away_and_nothing_else(mine: Path, newer: Path) -> None:
    core = mine / "framework/core"
    (core / ".ray.hpp.ab12cd34.raysteps-update").write_bytes(b"new r")
    own = {"framework/core/.ray.hpp.ab12cd34": b"mine", "framework/core/.other.hpp.raysteps-update": b"mine"}
    for name, data in own.items():
        (mine / name).write_bytes(data)
    update(mine, newer)
    expect_done(mine, newer, {**MINE, **own})


def test_a_list_of_an_interrupted_update_that_nobody_can_read(mine: Path, newer: Path) -> None:
    (mine / ".raysteps/unfinished").mkdir()
    (mine / ".raysteps/unfinished/0123.json").write_text("{")
    update(mine, newer)
    expect_done(mine, newer, MINE)


def test_a_file_that_is_saved_meanwhile_is_not_written_over(
    mine: Path, newer: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The step was not begun when the update looked, and is when it writes."""
    (mine / OWN[1]).write_bytes(OLD[OWN[1]])
    real = Path.replace

    def saving(path: Path, target: Path) -> Path:
        (mine / OWN[1]).write_bytes(b"just saved")
        return real(path, target)

    monkeypatch.setattr(Path, "replace", saving)
    update(mine, newer)
    assert (mine / OWN[1]).read_bytes() == b"just saved"
