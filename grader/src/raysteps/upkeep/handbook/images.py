"""The pages' pictures: small files, compared with some patience."""

import io
from pathlib import Path

import numpy as np
from PIL import Image

from raysteps.common.files import write_bytes
from raysteps.programs.pictures import Pixels

_COLORS = 96
_MOST_APART = 2.0  # of 255, on average: another compiler moves a few pixels


def _png(pixels: Pixels) -> bytes:
    data = io.BytesIO()
    Image.fromarray(pixels).quantize(_COLORS, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(
        data, format="PNG", optimize=True
    )
    return data.getvalue()


def is_current(path: Path, pixels: Pixels) -> bool:
    """Whether the file shows this picture."""
    try:
        with Image.open(path) as image:
            kept = np.asarray(image.convert("RGB"), dtype=np.int16)
    except OSError:
        return False
    with Image.open(io.BytesIO(_png(pixels))) as image:
        wanted = np.asarray(image.convert("RGB"), dtype=np.int16)
    return kept.shape == wanted.shape and float(np.abs(kept - wanted).mean()) <= _MOST_APART


def write_image(path: Path, pixels: Pixels) -> None:
    """With few colours, so that the repository stays small."""
    write_bytes(path, _png(pixels))
