"""Pictures that travel inside a page."""

import base64
import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image

_MAGIC = b"\x89PNG\r\n\x1a\n"
_HEADER = 33  # bytes: the signature and the chunk that holds the size


class NotAPicture(Exception):
    """A file that is no PNG, in words."""


@dataclass(frozen=True)
class PictureData:
    """A picture and its size in pixels."""

    src: str
    width: int
    height: int


def _uri(data: bytes) -> str:
    return "data:image/png;base64," + base64.b64encode(data).decode("ascii")


def picture_data(path: Path) -> PictureData:
    """Of a PNG file; nothing else is put into a page."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise NotAPicture(f"{path}: cannot be read: {error.strerror or error}") from error
    if not data.startswith(_MAGIC) or len(data) < _HEADER or data[12:16] != b"IHDR":
        raise NotAPicture(f"{path}: is not a PNG")
    return PictureData(_uri(data), int.from_bytes(data[16:20]), int.from_bytes(data[20:24]))


def data_uri(path: Path) -> str:
    """A PNG file as `data:image/png;base64,...`."""
    return picture_data(path).src


def pixel_data(pixels: npt.NDArray[np.uint8]) -> PictureData:
    """Colours, or gray values such as FLIP's, as PNG."""
    data = io.BytesIO()
    Image.fromarray(pixels).save(data, format="PNG", optimize=True)
    return PictureData(_uri(data.getvalue()), pixels.shape[1], pixels.shape[0])
