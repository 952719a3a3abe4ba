"""Pictures that travel inside a JSON document."""

import base64
import io
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from PIL import Image

from raysteps.exports.items import Item

_SHRINKINGS = (1, 2, 4)
_MAX_PIXELS = 4096 * 4096
_AROUND = 80  # bytes of JSON around a picture and its label
_ORDER = {"difference": 0, "mine": 1, "reference": 2}
_LABELS = {"difference": "difference, 8 times brighter", "mine": "yours", "reference": "reference"}


def data_uri(path: Path, shrinking: int) -> str | None:
    """The picture as PNG, each side divided by a number; None when there is no such picture."""
    try:
        with Image.open(path, formats=["PNG"]) as picture:
            if picture.width * picture.height > _MAX_PIXELS:
                return None
            size = (max(1, picture.width // shrinking), max(1, picture.height // shrinking))
            pixels = picture.convert("RGB")
    except (OSError, ValueError, Image.DecompressionBombError):
        return None
    data = io.BytesIO()
    (pixels if shrinking == 1 else pixels.resize(size)).save(data, format="PNG", optimize=True)
    return "data:image/png;base64," + base64.b64encode(data.getvalue()).decode("ascii")


@dataclass(frozen=True)
class _Candidate:
    test: dict[str, Any]
    kind: str
    path: str
    passed: bool


@dataclass
class Album:
    """Pictures that would like to come along; those of failed checks come first."""

    _candidates: list[_Candidate] = field(default_factory=list)

    def offer(self, test: dict[str, Any], item: Item) -> None:
        """Takes note of the pictures of a check."""
        self._candidates += [_Candidate(test, kind, path, item.passed) for kind, path in item.pictures]

    def paste(self, folder: Path, room: int) -> int:
        """Puts into the tests what fits into so many bytes, all at one size; tells how many pictures did not."""
        order = sorted(self._candidates, key=lambda one: (one.passed, _ORDER.get(one.kind, 9)))
        for shrinking in _SHRINKINGS:
            uris = [self._read(folder, candidate, shrinking) for candidate in order]
            if sum(len(uri) + _AROUND for uri in uris if uri is not None) <= room:
                break
        left_out = 0
        for candidate, uri in zip(order, uris, strict=True):
            if uri is None:
                continue
            if len(uri) + _AROUND > room:
                left_out += 1
                continue
            room -= len(uri) + _AROUND
            candidate.test.setdefault("images", []).append({"label": _LABELS[candidate.kind], "url": uri})
        return left_out

    @staticmethod
    def _read(folder: Path, candidate: _Candidate, shrinking: int) -> str | None:
        path = (folder / candidate.path).resolve()
        return data_uri(path, shrinking) if path.is_relative_to(folder.resolve()) else None
