"""An update of a students' repository changes the kit's files and nothing of the student's."""

from pathlib import Path

import pytest
from update_kits import NEW, OLD, OWN, STEPS, WORK, expect_done, files_of, is_all_there, release, update

MINE = {**WORK, "framework/core/ray.hpp.mine": b"my ray\n"}


@pytest.fixture
def mine(tmp_path: Path) -> Path:
    """A repository with work in every step, and in a file of the kit."""
    root = release(tmp_path / "mine", OLD, STEPS[:2])
    for name, data in WORK.items():
        (root / name).write_bytes(data)
    (root / "framework/core/ray.hpp").write_bytes(b"my ray\n")
    return root


@pytest.fixture
def newer(tmp_path: Path) -> Path:
    return release(tmp_path / "newer", NEW)


def test_work_in_every_step_stays_byte_for_byte(mine: Path, newer: Path) -> None:
    changes = update(mine, newer)
    expect_done(mine, newer, MINE)
    assert changes.kept == ["framework/core/ray.hpp.mine"]
    assert changes.removed == ["framework/core/gone.hpp"]
    assert changes.stubs == [OWN[1]]
    assert (mine / "raysteps").stat().st_mode & 0o111


def test_once_more_changes_nothing(mine: Path, newer: Path) -> None:
    update(mine, newer)
    before = files_of(mine)
    assert not update(mine, newer).any
    assert files_of(mine) == before


def test_a_stub_that_nobody_touched_is_replaced(tmp_path: Path, newer: Path) -> None:
    root = release(tmp_path / "fresh", OLD, STEPS[:2])
    update(root, newer)
    assert files_of(root) == files_of(newer)


def test_lines_that_git_ended_otherwise_are_not_the_students(tmp_path: Path, newer: Path) -> None:
    root = release(tmp_path / "windows", OLD, STEPS[:2])
    for name in OLD:
        (root / name).write_bytes(OLD[name].replace(b"\n", b"\r\n"))
    assert update(root, newer).kept == []


def test_work_among_lines_that_git_ended_otherwise_stays(tmp_path: Path, newer: Path) -> None:
    root = release(tmp_path / "windows", OLD, STEPS[:2])
    for name in OLD:
        (root / name).write_bytes(OLD[name].replace(b"\n", b"\r\n"))
    work = {OWN[1]: b"int mine();\r\n" + OLD[OWN[1]].replace(b"\n", b"\r\n")}
    (root / OWN[1]).write_bytes(work[OWN[1]])
    update(root, newer)
    assert (root / OWN[1]).read_bytes() == work[OWN[1]]


def test_a_file_that_was_deleted_is_the_stub_again_and_a_renamed_one_stays(mine: Path, newer: Path) -> None:
    (mine / OWN[0]).unlink()
    (mine / OWN[1]).rename(mine / "steps/02-b/mine.cpp")
    changes = update(mine, newer)
    assert changes.put_back == [OWN[0], OWN[1]]
    assert (mine / "steps/02-b/mine.cpp").read_bytes() == WORK[OWN[1]]
    assert (mine / OWN[1]).read_bytes() == NEW[OWN[1]]


def test_what_the_kit_dropped_does_not_stay_in_the_build(mine: Path, newer: Path) -> None:
    (mine / "framework/core/gone.hpp").write_bytes(b"my own gone\n")
    changes = update(mine, newer)
    assert changes.outdated == ["framework/core/gone.hpp.mine"]
    expect_done(mine, newer, {**MINE, "framework/core/gone.hpp.mine": b"my own gone\n"})


def test_a_step_that_goes_and_comes_again(mine: Path, newer: Path, tmp_path: Path) -> None:
    shorter = release(tmp_path / "shorter", {name: OLD[name] for name in OLD if "02-b" not in name}, STEPS[:1])
    assert update(mine, shorter).left == [OWN[1]]
    assert (mine / OWN[1]).read_bytes() == WORK[OWN[1]]
    assert update(mine, newer).met == [OWN[1]]
    expect_done(mine, newer, MINE)


def test_a_stub_of_a_step_that_goes_is_not_the_students(tmp_path: Path) -> None:
    root = release(tmp_path / "fresh", OLD, STEPS[:2])
    shorter = release(tmp_path / "shorter", {name: OLD[name] for name in OLD if "02-b" not in name}, STEPS[:1])
    update(root, shorter)
    assert files_of(root) == files_of(shorter)
    assert not (root / "steps/02-b").exists()


def test_a_file_of_the_students_where_a_new_step_comes(mine: Path, newer: Path) -> None:
    (mine / OWN[2]).parent.mkdir()
    (mine / OWN[2]).write_bytes(b"before its time")
    assert update(mine, newer).met == [OWN[2]]
    assert (mine / OWN[2]).read_bytes() == b"before its time"


def test_what_was_the_students_stays_so_whatever_the_list_says(mine: Path, newer: Path) -> None:
    place = newer / ".raysteps/release.json"
    place.write_text(place.read_text(encoding="utf-8").replace('"owner": "student"', '"owner": "kit"'))
    update(mine, newer)
    assert {name: (mine / name).read_bytes() for name in WORK} == WORK


@pytest.mark.parametrize("name", [".vscode/settings.json", "framework/core/ray.hpp"])
def test_settings_of_ones_own_stay_while_the_kits_are_the_same(tmp_path: Path, name: str) -> None:
    root = release(tmp_path / "mine", OLD, STEPS[:2])
    (root / name).write_bytes(b"of my own\n")
    again = release(tmp_path / "again", {**OLD, "steps/01-a/README.md": b"better\n"}, STEPS[:2])
    changes = update(root, again)
    setting = name.startswith(".vscode")
    assert changes.kept == ([] if setting else [f"{name}.mine"])
    assert (root / name).read_bytes() == (b"of my own\n" if setting else OLD[name])
    if setting:
        (root / name).unlink()
        assert not update(root, again).any
        assert not (root / name).exists()
        (root / name).write_bytes(b"of my own\n")
    changed = release(tmp_path / "changed", {**OLD, name: b"of the kit\n"}, STEPS[:2])
    update(root, changed)
    assert (root / name).read_bytes() == b"of the kit\n"
    assert (root / f"{name}.mine").read_bytes() == b"of my own\n"


def test_a_second_version_of_ones_own_gets_a_name_of_its_own(mine: Path, newer: Path) -> None:
    elsewhere = mine.parent / "elsewhere"
    (mine / "framework/core/ray.hpp.mine").symlink_to(elsewhere)
    update(mine, newer)
    (mine / "framework/core/ray.hpp").write_bytes(b"my second ray\n")
    assert update(mine, newer).kept == ["framework/core/ray.hpp.mine3"]
    assert is_all_there(mine, {**WORK, "framework/core/ray.hpp": b"my ray\n"})
    assert not elsewhere.exists()


def test_a_file_that_may_only_be_read_is_replaced(mine: Path, newer: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """On Windows that takes a word more."""
    real_replace, real_unlink = Path.replace, Path.unlink

    def refuse(path: Path) -> None:
        if path.exists() and not path.stat().st_mode & 0o200:
            raise PermissionError(13, "Access is denied", str(path))

    def replace(path: Path, target: Path) -> Path:
        refuse(target)
        return real_replace(path, target)

    def unlink(path: Path, missing_ok: bool = False) -> None:
        refuse(path)
        real_unlink(path, missing_ok)

    for name in OLD:
        (mine / name).chmod(0o444)
    monkeypatch.setattr(Path, "replace", replace)
    monkeypatch.setattr(Path, "unlink", unlink)
    update(mine, newer)
    expect_done(mine, newer, MINE)
    assert (mine / "framework/core/ray.hpp").stat().st_mode & 0o200
    assert (mine / OWN[0]).stat().st_mode & 0o777 == 0o444
