"""The page of the gallery."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from raysteps.course.manifest import Step
from raysteps.gallery.shots import GalleryScene, Shot, WorkMap
from raysteps.images.compare import Pixels
from raysteps.report.page import COMPARE_SCRIPTS, COMPARE_STYLES, pixel_data, render_page

# The pictures of the gallery as they travel in its page: each once, however often it is shown.


class Album:
    """Gives each picture a number. Steps that change nothing share one."""

    def __init__(self) -> None:
        self.sources: list[str] = []
        self._known: dict[bytes, int] = {}

    def add(self, pixels: Pixels) -> int:
        key = hashlib.sha256(repr(pixels.shape).encode() + pixels.tobytes()).digest()
        if key not in self._known:
            self._known[key] = len(self.sources)
            self.sources.append(pixel_data(pixels).src)
        return self._known[key]


_SCRIPTS = ("gallery-walk", "gallery-work", "gallery-strip", "gallery")
_TITLE, _TITLE_OF_PART_ONE = "From ray directions to light from everywhere", "From ray directions to glass"


@dataclass(frozen=True)
class GalleryEntry:
    """A scene with all its pictures: after each step, and the work of those that save some."""

    scene: GalleryScene
    reference: Sequence[Shot | None]  # None where the scene does not show the step
    work_maps: Mapping[int, Sequence[WorkMap]]
    mine: Sequence[Shot | None] = field(default_factory=list)  # empty where nobody asked for them
    my_work_maps: Mapping[int, WorkMap] = field(default_factory=dict)


def _shot(shot: Shot | None, album: Album) -> dict[str, object] | None:
    if shot is None:
        return None
    return {"picture": None if shot.pixels is None else album.add(shot.pixels), "note": shot.note}


def _work_map(work_map: WorkMap, album: Album) -> dict[str, object]:
    height, width = work_map.map.shape[:2]
    return {
        "name": work_map.name,
        "map": album.add(work_map.map),
        "width": width,
        "height": height,
        "surfaces": round(work_map.work.surfaces_per_ray, 3),
        "boxes": round(work_map.work.boxes_per_ray, 3),
    }


def _scene(entries: GalleryEntry, album: Album) -> dict[str, object]:
    work_maps = {
        step: [*before_and_after, *filter(None, [entries.my_work_maps.get(step)])]
        for step, before_and_after in entries.work_maps.items()
    }
    pixels = next((shot.pixels for shot in entries.reference if shot and shot.pixels is not None), None)
    return {
        "name": entries.scene.name,
        "title": entries.scene.title,
        "words": entries.scene.words,
        "width": pixels.shape[1] if pixels is not None else 4,
        "height": pixels.shape[0] if pixels is not None else 3,
        "reference": [_shot(shot, album) for shot in entries.reference],
        "mine": [_shot(shot, album) for shot in entries.mine],
        "work": {str(step): [_work_map(one, album) for one in shown] for step, shown in work_maps.items()},
    }


def gallery_page(steps: Sequence[Step], scenes: Sequence[GalleryEntry]) -> str:
    """The document. Its pictures lie in its data and are read when their scene is chosen."""
    album = Album()
    entries = [_scene(one, album) for one in scenes]
    shown = [
        {"number": step.number, "index": step.index, "title": step.title, "bonus": step.bonus, "new": step.about}
        for step in steps
    ]
    data = {"steps": shown, "scenes": entries, "pictures": album.sources}
    first = entries[0]["reference"]
    assert isinstance(first, list)
    pictures = [shot["picture"] for shot in first if shot is not None]
    plain = [album.sources[picture] for picture in (pictures[0], pictures[-1]) if picture is not None]
    context = {"steps": shown, "scenes": entries, "mine": any(one.mine for one in scenes), "plain": plain}
    styles = (*COMPARE_STYLES, "gallery", "gallery-strip")
    title = _TITLE if any(step.is_in_part_two for step in steps) else _TITLE_OF_PART_ONE
    return render_page("gallery", title, context, (*COMPARE_SCRIPTS, *_SCRIPTS), styles, data)
