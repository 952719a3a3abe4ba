"""Reading and comparing pictures."""

import os
from pathlib import Path

import numpy as np
import pytest

from raysteps.images.compare import (
    MAX_PARTIAL_SHARE,
    TOLERANCE,
    PictureError,
    Pixels,
    baseline_error,
    channel_differences,
    commonest_color,
    compare,
    difference,
    is_flat,
    mean_error,
    partial_credit,
    pixel_differences,
    read_ppm,
    reduced_picture,
    write_png,
)


def _ramp() -> Pixels:
    return np.arange(300, dtype=np.uint16).astype(np.uint8).reshape(10, 10, 3)


def test_reads_what_raytrace_writes(tmp_path: Path) -> None:
    path = tmp_path / "a.ppm"
    path.write_bytes(b"P6\n2 1\n255\n\x01\x02\x03\x04\x05\x06")
    assert read_ppm(path).tolist() == [[[1, 2, 3], [4, 5, 6]]]


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"P3\n1 1\n255\n1 2 3",
        b"P6\n2 2\n255\n\0\0\0",
        b"P6\n0 0\n255\n",
        b"P6\n1 1\n65535\n\0\0\0\0\0\0",
        b"P6\n99999 99999\n255\n\0",
        b"P6\n1 1\n255\n\0\0\0\0",
    ],
)
def test_refuses_bad_pictures(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "a.ppm"
    path.write_bytes(data)
    with pytest.raises(PictureError):
        read_ppm(path)


def test_refuses_what_is_no_regular_file(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to(tmp_path / "pipe")
    for name in ("pipe", "link", "missing", "."):
        with pytest.raises(PictureError):
            read_ppm(tmp_path / name)


def test_small_differences_pass() -> None:
    reference = _ramp() // 2
    assert compare(reference + 2, reference, 0.0).passed


def test_the_share_of_wrong_pixels_decides() -> None:
    reference = _ramp() // 2
    mine = reference.copy()
    mine[4, 7, 1] += 3
    assert compare(mine, reference, 0.01).passed
    verdict = compare(mine, reference, 0.009)
    assert not verdict.passed
    assert verdict.wrong_share == 0.01
    assert "x=7, y=4" in verdict.message


def test_a_flat_picture_fails_where_the_reference_is_not() -> None:
    reference = np.zeros((10, 10, 3), dtype=np.uint8)
    mine = reference.copy()
    assert compare(mine, reference, 0.0).passed
    reference[0, 0] = 255
    assert not compare(mine, reference, 0.5).passed
    assert is_flat(mine)


def test_size_must_agree() -> None:
    assert "10x10 pixels, expected 5x10" in compare(_ramp(), _ramp()[:, :5], 1.0).message


def test_difference_is_brightened_and_written(tmp_path: Path) -> None:
    reference = _ramp() // 2
    shown = difference(reference + 1, reference)
    assert (shown == 8).all()
    write_png(shown, tmp_path / "new" / "d.png")
    assert [path.name for path in (tmp_path / "new").iterdir()] == ["d.png"]


def test_a_grossly_wrong_picture_is_shown_coarsely() -> None:
    """What it carries: a pixel of four, five bits of each channel."""
    data = np.random.default_rng(5).integers(0, 256, (61, 80, 3), dtype=np.uint8)
    coarse = reduced_picture(data, 255 - data, 0.51)
    assert coarse.shape == data.shape
    assert (coarse[0::2][:30] == coarse[1::2]).all()
    assert (coarse[:, 0::2] == coarse[:, 1::2]).all()
    assert len(np.unique(coarse)) == 32
    corners = channel_differences(coarse[::2, ::2], data[::2, ::2])
    assert corners.max() <= 4  # it still looks like the picture


def test_other_pictures_are_shown_as_they_are() -> None:
    """But for what counts as right: there the last bits could carry something out, and nobody sees them."""
    dice = np.random.default_rng(5)
    reference = dice.integers(10, 240, (60, 80, 3), dtype=np.uint8)
    mine = reference + dice.integers(0, 3, reference.shape, dtype=np.uint8)
    mine[:20] = 255 - reference[:20]
    for wrong_share in (0.0, 0.02, 0.5):
        picture = reduced_picture(mine, reference, wrong_share)
        assert (picture[20:] == reference[20:]).all()
        wrong = pixel_differences(mine, reference) > TOLERANCE
        assert wrong[:20].mean() > 0.9
        assert (picture[wrong] == mine[wrong]).all()


def test_the_commonest_color_is_that_of_the_most_pixels() -> None:
    pixels = np.zeros((2, 5, 3), dtype=np.uint8)
    pixels[0] = 255, 1, 2
    assert commonest_color(pixels).tolist() == [0, 0, 0], "of two that are equal, the darker"
    pixels[1, 4] = 255, 1, 2
    assert commonest_color(pixels).tolist() == [255, 1, 2]


def test_a_picture_that_does_not_pass_earns_by_how_much_less_wrong_it_is() -> None:
    reference = np.zeros((20, 20, 3), dtype=np.uint8)
    reference[5:15, 5:15] = 200
    baseline = baseline_error(reference)
    half = reference.copy()
    half[5:15, 5:10] = 0
    assert 0 < baseline <= mean_error(np.zeros_like(reference), reference)
    assert partial_credit(half, reference, baseline) == pytest.approx(MAX_PARTIAL_SHARE / 2)
    assert partial_credit(reference, reference, baseline) == MAX_PARTIAL_SHARE
    assert partial_credit(np.full_like(reference, 90), reference, baseline) == 0, "one colour is no work"
    assert partial_credit(255 - reference, reference, baseline) == 0
    assert partial_credit(half[:10], reference, baseline) == 0, "another size"
    assert partial_credit(half, reference, 0.0) == 0, "whatever is drawn, nobody had to work for it"
