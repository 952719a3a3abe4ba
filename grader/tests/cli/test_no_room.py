"""Where nothing can be written any more, a command says so and ends: no traceback, and nothing half-written."""

import errno
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from raysteps.cli.app import exit_code_of
from raysteps.common.errors import UsageError, reason_or_fault
from raysteps.common.files import refuse_to_write, write_bytes, write_out

_FULL = Path("/dev/full")


@pytest.mark.skipif(not _FULL.exists(), reason="needs /dev/full")
@pytest.mark.parametrize("words", ["list", "--version", "--help", "next", "compare --help", "grade /no/such", "hm"])
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_no_command_falls_over_a_full_output(words: str, unbuffered: str) -> None:
    with _FULL.open("w") as full:
        done = subprocess.run(
            [sys.executable, "-P", "-m", "raysteps", *words.split()],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
            env={**os.environ, "PYTHONUNBUFFERED": unbuffered},
        )
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    if words in ("list", "next"):
        assert done.returncode == 4
        assert "the disk is full" in done.stderr


@pytest.mark.skipif(not _FULL.exists(), reason="needs /dev/full")
def test_nor_where_it_cannot_even_say_so() -> None:
    with _FULL.open("w") as full:
        words = [sys.executable, "-P", "-m", "raysteps", "list"]
        assert subprocess.run(words, stdout=full, stderr=full, check=False).returncode == 4


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EDQUOT])
def test_a_full_disk_is_told(number: int, capsys: pytest.CaptureFixture[str]) -> None:
    assert exit_code_of(OSError(number, os.strerror(number), "/grades/class.html")) == 4
    said = capsys.readouterr().err
    assert said.startswith("raysteps: something cannot be written: /grades/class.html: the disk is full")
    assert said.endswith("; make room and type it again\n")


@pytest.mark.parametrize(
    ("number", "said"),
    [
        (errno.EROFS, "the disk is read-only; it needs a place where it can write, such as a copy of the kit"),
        (errno.EACCES, "no permission; what it needs there must be open to you"),
        (errno.EISDIR, "it is a folder; expected a file there"),
        (errno.ENOTDIR, "a part of the path is a file, not a folder; expected a folder there"),
        (errno.EEXIST, "something is there already; expected a folder there, or nothing yet"),
    ],
)
def test_a_place_that_does_not_serve_is_told(number: int, said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert exit_code_of(OSError(number, os.strerror(number), "/kit/build")) == 2
    assert capsys.readouterr().err == f"raysteps: /kit/build: {said}\n"


def test_a_full_disk_leaves_the_old_file_and_no_half(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write_bytes(tmp_path / "results.json", b"old")
    opened: Callable[..., object] = os.fdopen

    class _Full:
        def __init__(self, handle: int) -> None:
            self._file = opened(handle, "wb")

        def __enter__(self) -> "_Full":
            return self

        def __exit__(self, *_: object) -> None:
            self._file.close()  # type: ignore[attr-defined]

        def write(self, data: bytes) -> None:
            self._file.write(data[:2])  # type: ignore[attr-defined]
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fdopen", lambda handle, mode: _Full(handle))
    with pytest.raises(OSError, match="No space"):
        write_bytes(tmp_path / "results.json", b"new and longer")
    assert [path.read_bytes() for path in tmp_path.iterdir()] == [b"old"]


@pytest.mark.parametrize("place", ["a.txt/x.zip", "a.txt/b/x.zip"])
def test_a_file_on_the_way_is_named(tmp_path: Path, place: str) -> None:
    (tmp_path / "a.txt").touch()
    with pytest.raises(UsageError, match="cannot be written: a part of the path is a file, not a folder"):
        write_out(tmp_path / place, b"")


def test_what_a_page_was_in_want_of_is_told_in_words() -> None:
    assert reason_or_fault(OSError(errno.ENOSPC, "No space left on device")) == "the disk is full"
    assert reason_or_fault(KeyError("steps")) == "KeyError('steps')"


def test_a_closed_folder_is_told_before_anything_is_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    refuse_to_write(tmp_path / "a.png")
    (tmp_path / "old.png").touch()
    monkeypatch.setattr(os, "access", lambda path, mode: not mode & os.W_OK)  # to root every folder is open
    refuse_to_write(tmp_path / "old.png")  # as /dev/stdout, which can be written where it lies or not
    with pytest.raises(UsageError, match=f"no permission to write in the folder {tmp_path.name}; write elsewhere"):
        refuse_to_write(tmp_path / "a.png")
