"""Reads and compares pictures."""

import io
import os
import re
import stat
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from PIL import Image

from raysteps.common.files import open_regular, write_bytes

Pixels: TypeAlias = npt.NDArray[np.uint8]
Gaps: TypeAlias = npt.NDArray[np.int16]

_HEADER = re.compile(rb"P6\s+([0-9]{1,5})\s+([0-9]{1,5})\s+255\s")
_MAX_HEADER = 1000  # bytes; raytrace writes some twenty
_MAX_BYTES = 200 << 20
TOLERANCE = 2


class PictureError(Exception):
    """A file that is no picture of ours, in words for the student."""


def read_ppm(path: Path) -> Pixels:
    """Reads a P6 file with 8-bit channels; regular files only."""
    try:
        handle = open_regular(path)
    except OSError as error:
        raise PictureError("no picture was written") from error
    try:
        status = os.fstat(handle)
        if not stat.S_ISREG(status.st_mode) or status.st_size > _MAX_BYTES:
            raise PictureError("the picture is not a regular file of a sensible size")
        with os.fdopen(handle, "rb", closefd=False) as file:
            return parse_ppm(file.read(_MAX_BYTES))
    finally:
        os.close(handle)


def parse_ppm(data: bytes) -> Pixels:
    """The bytes of a P6 file; the size is checked before it is believed."""
    if not data:
        raise PictureError("no picture was written")
    header = _HEADER.match(data, 0, _MAX_HEADER)
    if header is None:
        raise PictureError("the picture is not a binary PPM with 8-bit channels")
    width, height = int(header.group(1)), int(header.group(2))
    if width == 0 or height == 0 or len(data) - header.end() != 3 * width * height:
        raise PictureError("the picture's size does not fit its header")
    return np.frombuffer(data, dtype=np.uint8, offset=header.end()).reshape(height, width, 3)


def read_png(path: Path) -> Pixels:
    """Without transparency. OSError or ValueError where it is no PNG, or only a part of one."""
    try:
        with Image.open(path, formats=["PNG"]) as picture:
            return np.asarray(picture.convert("RGB"), dtype=np.uint8)
    except (SyntaxError, Image.DecompressionBombError) as error:  # which Pillow raises, too
        raise ValueError(str(error)) from error


def write_png(pixels: Pixels, path: Path) -> None:
    """Writes to a temporary name, then renames."""
    data = io.BytesIO()
    Image.fromarray(pixels).save(data, format="PNG")
    write_bytes(path, data.getvalue())


def is_flat(pixels: Pixels) -> bool:
    """Whether all pixels have one colour."""
    return bool((pixels == pixels[0, 0]).all())


def commonest_color(pixels: Pixels) -> Pixels:
    """The red, green and blue of the most pixels; of several, the darkest in red, then green, then blue."""
    numbers = pixels.reshape(-1, 3).astype(np.uint32) @ np.array([1 << 16, 1 << 8, 1], np.uint32)
    found, amounts = np.unique(numbers, return_counts=True)  # much quicker than of rows of three
    number = int(found[amounts.argmax()])
    return np.array([number >> 16, number >> 8 & 255, number & 255], np.uint8)


def channel_differences(one: Pixels, other: Pixels) -> Gaps:
    """How far each channel of two pictures of one size is from the other's."""
    return np.abs(one.astype(np.int16) - other.astype(np.int16))


def pixel_differences(one: Pixels, other: Pixels) -> Gaps:
    """For each pixel of two pictures of one size, the difference of the channel that differs most."""
    red, green, blue = np.moveaxis(
        channel_differences(one, other), 2, 0
    )  # much quicker than the maximum of an axis of three
    largest: Gaps = np.maximum(np.maximum(red, green), blue)
    return largest


def widest(gap: Gaps) -> tuple[int, int]:
    """The column and the row of the largest."""
    y, x = (int(index) for index in np.unravel_index(int(gap.argmax()), gap.shape))
    return x, y


def worst_pixel(mine: Path, reference: Path) -> tuple[int, int] | None:
    """The column and the row; none where the pictures cannot be compared or are the same."""
    try:
        one, other = read_png(mine), read_png(reference)
    except (OSError, ValueError):
        return None
    if one.shape != other.shape:
        return None
    gap = pixel_differences(one, other)
    return widest(gap) if gap.any() else None


def difference(mine: Pixels, reference: Pixels, factor: int = 8) -> Pixels:
    """The absolute difference of two pictures of one size, made brighter."""
    bright: Pixels = np.minimum(channel_differences(mine, reference) * factor, 255).astype(np.uint8)
    return bright


GROSS = 0.5  # of the pixels
_LEVELS = 32  # of a channel


def reduced_picture(mine: Pixels, reference: Pixels, wrong_share: float) -> Pixels:
    """The picture that a report shows of a student's: what is right looks as in the reference's. One that is grossly
    wrong keeps a pixel of four and 32 levels of each channel: enough to see what it is, and too little to carry data
    out of a sandbox."""
    if wrong_share <= GROSS:
        wrong = pixel_differences(mine, reference) > TOLERANCE
        return np.where(wrong[..., np.newaxis], mine, reference)
    height, width, _ = mine.shape
    step = 256 // _LEVELS
    coarse: Pixels = mine[::2, ::2] // step * step + step // 2
    return coarse.repeat(2, axis=0).repeat(2, axis=1)[:height, :width]


@dataclass(frozen=True)
class Comparison:
    """How a picture compares with the reference's."""

    passed: bool
    wrong_share: float
    message: str


MAX_PARTIAL_SHARE = 0.6  # of its points are for one that does not pass
_WHOLLY_WRONG = 64  # of 255: a pixel that is farther off is no nearer to right than any other


def mean_error(mine: Pixels, reference: Pixels) -> float:
    """How wrong the pixels are on average, from 0 to 1; two pictures of one size."""
    gap = pixel_differences(mine, reference)
    return float(np.where(gap > TOLERANCE, np.minimum(gap, _WHOLLY_WRONG), 0).mean()) / _WHOLLY_WRONG


def partial_credit(mine: Pixels, reference: Pixels, baseline: float) -> float:
    """What a picture that does not pass still earns: how much less wrong it is than one that nobody has to work for.
    `baseline`: the error of that one."""
    if mine.shape != reference.shape or is_flat(mine) or baseline <= 0:
        return 0.0
    return MAX_PARTIAL_SHARE * max(0.0, 1 - mean_error(mine, reference) / baseline)


def baseline_error(reference: Pixels) -> float:
    """Of the best picture of one colour, the most frequent one or the one in the middle, and of the outlines: black on
    the most frequent colour."""
    pixels = reference.reshape(-1, 3)
    most = np.broadcast_to(commonest_color(reference), reference.shape)
    middle = np.broadcast_to(np.median(pixels, axis=0).astype(np.uint8), reference.shape)
    outlines = np.where((reference == most).all(axis=2, keepdims=True), reference, np.uint8(0))
    return min(mean_error(picture, reference) for picture in (most, middle, outlines))


def _size(pixels: Pixels) -> str:
    return f"{pixels.shape[1]}x{pixels.shape[0]}"


def compare(mine: Pixels, reference: Pixels, max_wrong: float) -> Comparison:
    """Passes when the share of pixels whose largest channel difference exceeds 2/255 is small enough."""
    if mine.shape != reference.shape:
        return Comparison(False, 1.0, f"The picture is {_size(mine)} pixels, expected {_size(reference)}.")
    wrong = pixel_differences(mine, reference) > TOLERANCE
    share = float(wrong.mean())
    if is_flat(mine) and not is_flat(reference):
        return Comparison(False, share, "The whole picture has one colour.")
    if share <= max_wrong:
        return Comparison(True, share, "")
    y, x = (int(index) for index in np.argwhere(wrong)[0])
    colors = f"{tuple(mine[y, x].tolist())}, expected {tuple(reference[y, x].tolist())}"
    message = (
        f"{share:.2%} of the pixels are wrong (at most {max_wrong:.2%} may be); "
        f"the first is x={x}, y={y}: its colour is {colors}."
    )
    return Comparison(False, share, message)
