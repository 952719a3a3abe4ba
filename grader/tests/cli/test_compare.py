"""The command `compare`."""

import struct
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from raysteps.cli.app import main
from raysteps.images.compare import write_png


def _picture(path: Path, *, red: int = 10, size: tuple[int, int] = (4, 6)) -> str:
    pixels = np.full((*size, 3), 100, dtype=np.uint8)
    pixels[2, 5, 0] = red
    write_png(pixels, path)
    return str(path)


def test_where_two_pictures_differ_most(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mine, other, out = _picture(tmp_path / "a.png"), _picture(tmp_path / "b.png", red=30), tmp_path / "d.png"
    assert main(["compare", mine, other, "-o", str(out)]) == 1
    said = capsys.readouterr().out
    assert "1 of 24 pixels (4.17%) differ by more than 2 of 255" in said
    assert "x=5, y=2: (10, 100, 100) and (30, 100, 100)" in said
    shown = np.asarray(Image.open(out))
    assert shown[2, 5].tolist() == [160, 0, 0]
    assert int(shown.sum()) == 160


def test_rounding_is_no_difference(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", _picture(tmp_path / "a.png"), _picture(tmp_path / "b.png", red=12)]) == 0
    assert "0 of 24 pixels" in capsys.readouterr().out


def test_what_cannot_be_compared_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mine = _picture(tmp_path / "a.png")
    assert main(["compare", mine, _picture(tmp_path / "b.png", size=(6, 6))]) == 2
    assert "is 6x4 pixels, and the other 6x6" in capsys.readouterr().err
    assert main(["compare", mine, mine, "-o", str(tmp_path / "d.jpg")]) == 2


def _with_nonsense(png: bytes) -> bytes:
    """A chunk that is none, where the pixels should go on."""
    pixels = b"IDAT" + png[41:43]
    return png[:33] + b"\0\0\0\2" + pixels + struct.pack(">I", zlib.crc32(pixels)) + b"\0\0\0\4\1\2\3\4"


def _huge(png: bytes) -> bytes:
    """A header of more pixels than Pillow opens."""
    header = b"IHDR" + struct.pack(">II", 60_000, 60_000) + png[24:29]
    return png[:12] + header + struct.pack(">I", zlib.crc32(header)) + png[33:]


def test_a_picture_is_read_by_what_it_holds(tmp_path: Path) -> None:
    for name, content in (("a.png", b"P6\n1 1\n255\nabc"), ("b", Path(_picture(tmp_path / "c.png")).read_bytes())):
        (tmp_path / name).write_bytes(content)
        assert main(["compare", str(tmp_path / name), str(tmp_path / name)]) == 0


_EXPECTED = "; expected a picture as `./raysteps render` writes it, .png or .ppm"


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("none.png", None, "is not there"),
        ("none.ppm", None, "is not there"),
        (".", None, "is a folder"),
        ("text.png", b"no picture", "is neither a PNG nor a PPM"),
        ("text.ppm", b"P3 1 1 255 0 0 0", "the picture is not a binary PPM with 8-bit channels"),
        ("part.png", lambda png: png[:60], "is only a part of a PNG, or a damaged one"),
        ("chunk.png", _with_nonsense, "is only a part of a PNG, or a damaged one"),
        ("huge.png", _huge, "is only a part of a PNG, or a damaged one"),
    ],
)
def test_what_is_no_picture_is_told_in_plain_words(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    name: str,
    content: bytes | Callable[[bytes], bytes] | None,
    said: str,
) -> None:
    mine = _picture(tmp_path / "a.png")
    if content is not None:
        (tmp_path / name).write_bytes(content(Path(mine).read_bytes()) if callable(content) else content)
    assert main(["compare", mine, str(tmp_path / name)]) == 2
    assert capsys.readouterr().err == f"raysteps: {tmp_path / name}{_EXPECTED}\n".replace(";", f": {said};", 1)
