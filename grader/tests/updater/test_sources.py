"""A kit that is not whole, or not the one that was meant, changes nothing."""

import json
import zipfile
from pathlib import Path
from typing import Any

import pytest
from update_kits import NEW, OWN, STEPS, WORK, expect_done, files_of, mine, newer, release, update, zipped

from raysteps.common.errors import UsageError
from raysteps.updater.release_list import PLACE, ListedFile, Release, encoded

__all__ = ["mine", "newer"]  # pytest finds fixtures by name


def _refused(mine: Path, kit: Path, words: str) -> None:
    before = files_of(mine)
    with pytest.raises(UsageError, match=words):
        update(mine, kit)
    assert files_of(mine) == before


@pytest.mark.parametrize("outer", ["", "kit-2/"])
@pytest.mark.parametrize("compression", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_from_a_zip(mine: Path, newer: Path, tmp_path: Path, outer: str, compression: int) -> None:
    update(mine, zipped(newer, tmp_path / "newer.zip", outer, compression))
    expect_done(mine, newer, WORK)


def test_from_a_folder_around_it(mine: Path, tmp_path: Path) -> None:
    kit = release(tmp_path / "unpacked/newer", NEW)
    (tmp_path / "unpacked/__MACOSX").mkdir()
    update(mine, tmp_path / "unpacked")
    expect_done(mine, kit, WORK)


@pytest.mark.parametrize("spoil", ["cut", "missing", "outside", "not-a-release"])
def test_a_folder_that_is_not_whole(mine: Path, newer: Path, spoil: str) -> None:
    match spoil:
        case "cut":
            (newer / OWN[2]).write_bytes(b"st")
            _refused(mine, newer, "c.cpp: is not as it was released.*Nothing was changed")
        case "missing":
            (newer / OWN[2]).unlink()
            _refused(mine, newer, "c.cpp: is not there.*Nothing was changed")
        case "outside":
            text = (newer / PLACE).read_text()
            (newer / PLACE).write_text(text.replace("framework/core/more.hpp", "../more.hpp"))
            _refused(mine, newer, r"lists \.\./more\.hpp")
        case _:
            (newer / PLACE).unlink()
            _refused(mine, newer, "holds no release")


@pytest.mark.parametrize("name", [OWN[2], PLACE])
@pytest.mark.parametrize("compression", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_a_zip_with_a_wrong_byte(mine: Path, newer: Path, tmp_path: Path, name: str, compression: int) -> None:
    path = zipped(newer, tmp_path / "newer.zip", "", compression)
    with zipfile.ZipFile(path) as archive:
        info = archive.getinfo(name)
    data = bytearray(path.read_bytes())
    for at in range(4):
        data[info.header_offset + 30 + len(name) + at] ^= 0xFF
    path.write_bytes(data)
    _refused(mine, path, "cannot be read")


@pytest.mark.parametrize("keep", [0, 10, 0.3, 0.9])
def test_half_a_zip(mine: Path, newer: Path, tmp_path: Path, keep: float) -> None:
    path = zipped(newer, tmp_path / "newer.zip")
    data = path.read_bytes()
    path.write_bytes(data[: int(keep if keep >= 1 else keep * len(data))])
    _refused(mine, path, "cannot be read")


def test_a_zip_with_a_password(mine: Path, newer: Path, tmp_path: Path) -> None:
    path = zipped(newer, tmp_path / "newer.zip")
    data = bytearray(path.read_bytes())
    for sign, offset in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        at = data.find(sign)
        while at >= 0:
            data[at + offset] |= 1
            at = data.find(sign, at + 4)
    path.write_bytes(data)
    _refused(mine, path, "has a password")


def test_a_zip_that_not_every_python_reads(mine: Path, newer: Path, tmp_path: Path) -> None:
    _refused(mine, zipped(newer, tmp_path / "newer.zip", "", zipfile.ZIP_BZIP2), "expected a plain zip")


def test_two_kits_to_choose_from(mine: Path, newer: Path, tmp_path: Path) -> None:
    _refused(mine, tmp_path, "holds mine and newer; say which")
    path = tmp_path / "both.zip"
    with zipfile.ZipFile(path, "w") as archive:
        for outer in ("one", "two"):
            for name, data in files_of(newer).items():
                archive.writestr(f"{outer}/{name}", data)
    _refused(mine, path, "holds one and two; say which")


def test_what_is_no_kit(mine: Path, tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    _refused(mine, tmp_path / "empty", "holds no release")
    _refused(mine, tmp_path / "nowhere.zip", "is not there; expected a release")
    (tmp_path / "text.zip").write_text("no zip")
    _refused(mine, tmp_path / "text.zip", "cannot be read as a zip")


def _with(kit: Path, **keys: Any) -> None:
    document = json.loads((kit / PLACE).read_text())
    (kit / PLACE).write_text(json.dumps({**document, **keys}))


def test_a_list_of_a_later_kit(mine: Path, newer: Path) -> None:
    """More keys are read past, and kept; another form is not for this kit to read."""
    document = json.loads((newer / PLACE).read_text())
    files = [{**file, "since": "2027"} for file in document["files"]]
    _with(newer, made_by="a later kit", files=files)
    update(mine, newer)
    expect_done(mine, newer, WORK)
    _with(newer, schema="raysteps/release/v2")
    _refused(mine, newer, r"(?s)raysteps/release/v2.*python raysteps update --into")
    _with(newer, schema="something/else")
    _refused(mine, newer, "is not the list of a release's files")


@pytest.mark.parametrize(
    ("keys", "problem"),
    [
        ({"course": ""}, r"\$\.course: expected str of length >= 1"),
        ({"steps": []}, r"\$\.steps: expected array of length >= 1"),
        ({"files": [{"path": "a", "mark": "0", "owner": "kit", "executable": False}]}, r"\$\.files\[0\]\.mark"),
        ({"files": [{"path": "a", "mark": "0" * 64, "executable": False}]}, r"\$\.files\[0\]: 'owner' is missing"),
    ],
)
def test_a_list_that_breaks_its_form(mine: Path, newer: Path, keys: dict[str, object], problem: str) -> None:
    _with(newer, **keys)
    _refused(mine, newer, f"is not the list of a release's files: {problem}")


@pytest.mark.parametrize(
    "path",
    [
        "/etc/passwd", "../a", "a/../b", "a\\b", "C:/a", "a//b", "a/", "./a", "steps/./a", ".", "..", ".. ", "a/...",
        "a.", "a ", "a\0b", "CON", "steps/nul.txt", "com1", ".git/hooks/post-checkout", "framework/.GIT/config",
        ".venv/bin/python", "build/a", "Build/a", PLACE, ".raysteps/unfinished/a.json", "STEPS/01-A/a.HPP",
        "steps/01-a/a.hpp", "steps/01-a", "steps/01-a/a.hpp/b", "a/\u00e4", "\u0455teps/a", "a~1",
    ],
)  # fmt: skip
def test_a_path_that_may_not_be_in_a_list(mine: Path, newer: Path, path: str) -> None:
    document = json.loads((newer / PLACE).read_text())
    _with(newer, files=[*document["files"], {**document["files"][0], "path": path}])
    _refused(mine, newer, "lists ")
    release_of_it = Release(
        "Course", "k", STEPS, (ListedFile("steps/01-a/a.hpp", "0" * 64), ListedFile(path, "0" * 64))
    )
    with pytest.raises(UsageError, match="the release lists "):
        encoded(release_of_it)
