"""The pictures of a submission, as far as there is room for them in one page."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from raysteps.pages.flip import flip_map
from raysteps.pages.picture_data import NotAPicture, PictureData, picture_data, pixel_data
from raysteps.programs.pictures import read_png

_MOST_PIXELS = 1 << 22

Place = tuple[str, str]  # step and name of the picture
Document = Mapping[str, Any]


@dataclass
class Shown:
    """What there is to be compared."""

    pictures: dict[str, PictureData | None] = field(default_factory=dict)
    left_out: bool = False

    @property
    def any(self) -> bool:
        return any(self.pictures.values())


def _path(folder: Path, name: str | None) -> Path | None:
    """Nothing outside of the folder is shown, whatever a document says."""
    if not name:
        return None
    path = (folder / name).resolve()
    return path if path.is_relative_to(folder.resolve()) else None


def _read(path: Path | None) -> PictureData | None:
    try:
        return picture_data(path) if path is not None else None
    except NotAPicture:
        return None


def _flip(folder: Path, image: Document, sides: Mapping[str, PictureData | None]) -> PictureData | None:
    """Only where there is something to see: for equal pictures it would be black."""
    reference, mine = sides["reference"], sides["mine"]
    if reference is None or mine is None or reference.src == mine.src:
        return None
    if reference.width * reference.height > _MOST_PIXELS or mine.width * mine.height > _MOST_PIXELS:
        return None
    pixels = []
    for role in ("reference", "mine"):
        path = _path(folder, image[role])
        assert path is not None
        try:
            pixels.append(read_png(path))
        except (OSError, ValueError):
            return None
    gray = flip_map(pixels[0], pixels[1])
    return pixel_data(gray) if gray is not None else None


def _wrong_first(document: Document) -> Iterator[tuple[Place, Document]]:
    images = [((step["id"], image["name"]), image) for step in document["steps"] for image in step["images"]]
    return iter(sorted(images, key=lambda item: bool(item[1]["passed"])))


def make_album(document: Document, folder: Path, room: int) -> dict[Place, Shown]:
    """As many as fit into so many characters: the wrong ones first, then the right ones, and maps last."""
    album: dict[Place, Shown] = {}
    for place, image in _wrong_first(document):
        sides = {role: _read(_path(folder, image[role])) for role in ("reference", "mine")}
        size = sum(len(side.src) for side in sides.values() if side is not None)
        album[place] = Shown(sides) if size <= room else Shown(left_out=True)
        room -= size if size <= room else 0
    for place, image in _wrong_first(document):
        shown = album[place]
        flip = _flip(folder, image, shown.pictures) if shown.any else None
        if flip is not None and len(flip.src) <= room:
            shown.pictures["flip"] = flip
            room -= len(flip.src)
    return album
