"""What the system says of files, in words for people."""

import errno
import os
from pathlib import Path

import pytest

from raysteps.common.errors import reason, reason_and_place

pytestmark = pytest.mark.portable


def test_a_reason_has_no_number_and_no_path(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="Errno") as caught:
        (tmp_path / "none").read_text()
    assert reason(caught.value) == "it is not there"
    assert reason_and_place(caught.value) == f"{tmp_path / 'none'}: it is not there"


def test_what_has_no_words_of_ours_keeps_those_of_the_system() -> None:
    assert reason(OSError(errno.EXDEV, os.strerror(errno.EXDEV))) == os.strerror(errno.EXDEV)
    assert reason(OSError("cannot identify it")) == "cannot identify it"


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"\xff", "it is no text in UTF-8 (line 1, column 1); save it in UTF-8"),
        ("a\näö = \n".encode() + b"b = \xe4", "it is no text in UTF-8 (line 3, column 5); save it in UTF-8"),
        ("ä\nö".encode() + b"\xe4", "it is no text in UTF-8 (line 2, column 2); save it in UTF-8"),
        ("ä = 1".encode("utf-16"), "it is text in UTF-16; save it in UTF-8"),
    ],
)
def test_another_encoding_is_told_with_its_place(tmp_path: Path, data: bytes, said: str) -> None:
    (tmp_path / "course.toml").write_bytes(data)
    with pytest.raises(UnicodeDecodeError) as caught:
        (tmp_path / "course.toml").read_text("utf-8-sig")
    assert reason(caught.value) == said


def test_a_file_that_another_program_has_open_on_windows() -> None:
    error = PermissionError(errno.EACCES, "The process cannot access the file")
    assert reason(error) == "no permission"
    error.winerror = 32  # type: ignore[attr-defined,unused-ignore]
    assert reason(error) == "another program has it open"


@pytest.mark.parametrize(
    ("closed", "to", "said"),
    [
        ("out", os.X_OK, "no permission to enter the folder out"),
        ("out/in", os.X_OK, "no permission to enter the folder in"),
        ("out/in", os.W_OK, "no permission to write in the folder in"),
        ("out/in/file", os.R_OK, "no permission"),
    ],
)
def test_a_folder_that_is_closed_is_told_and_not_the_file_in_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, closed: str, to: int, said: str
) -> None:
    """As nobody may be kept out who is root, the system's answer is made up."""
    (tmp_path / "out" / "in").mkdir(parents=True)
    file = tmp_path / "out" / "in" / "file"
    if to == os.R_OK:
        file.touch()
    monkeypatch.setattr(os, "access", lambda path, mode: (Path(path), mode) != (tmp_path / closed, to))
    assert reason(PermissionError(errno.EACCES, "Permission denied", str(file))) == said


def test_a_folder_whose_list_is_closed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    error = PermissionError(errno.EACCES, "Permission denied", str(tmp_path))
    assert reason_and_place(error) == f"{tmp_path}: no permission"  # as for a name that may not be changed
    monkeypatch.setattr(os, "access", lambda path, _: Path(path) != tmp_path)
    assert reason_and_place(error) == f"{tmp_path}: no permission for what is in this folder"


def test_a_link_into_a_closed_folder_is_told_as_any_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Who asks where it leads is refused as well."""
    link = tmp_path / "link"
    link.symlink_to(tmp_path / "closed" / "file")

    def refuse(path: object, **_: object) -> os.stat_result:
        raise PermissionError(errno.EACCES, "Permission denied", str(path))

    monkeypatch.setattr(os, "stat", lambda path, **more: refuse(path) if Path(path) == link else os.lstat(path))
    assert reason(PermissionError(errno.EACCES, "Permission denied", str(link))) == "no permission"
