"""Whether two programs drew the same scene."""

from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

_BLOCK = 16  # pixels
_WEIGHTS = np.array([0.2126, 0.7152, 0.0722])


def linear_picture(path: Path, *, tone_mapped: bool) -> Any:
    """The light of each pixel, cut off at 1. Step 07 maps c to c / (c + 1); that is undone here."""
    with Image.open(path) as image:
        values = np.asarray(image.convert("RGB"), dtype=np.float64) / 255.0
    if tone_mapped:
        values = values / np.maximum(1.0 - values, 1e-9)
    return np.minimum(values, 1.0)


def _blocks(picture: Any) -> Any:
    brightness = picture @ _WEIGHTS
    height, width = (max(1, side // _BLOCK) * min(_BLOCK, side) for side in brightness.shape)
    rows, columns = max(1, height // _BLOCK), max(1, width // _BLOCK)
    return brightness[:height, :width].reshape(rows, height // rows, columns, width // columns).mean(axis=(1, 3))


def brightness_difference(a: Any, b: Any) -> float:
    """The mean over blocks of 16 x 16 pixels, from 0 to 1. Both pictures have the same size."""
    return float(np.abs(_blocks(a) - _blocks(b)).mean())
