"""The command `gallery`: chosen scenes after every step, on one page."""

import argparse
import hashlib
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.cli import picture_size, square_number
from raysteps.common.errors import UsageError
from raysteps.common.files import usable_folder, write_out
from raysteps.common.text import print_plain
from raysteps.common.text import size as shown_size
from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project
from raysteps.gallery.shots import (
    CHOSEN,
    SAMPLES,
    GalleryScene,
    MySteps,
    PictureOptions,
    Shot,
    WorkMap,
    gallery_scenes,
    my_steps,
    reference_shots,
    reference_work_maps,
)
from raysteps.images.compare import Pixels
from raysteps.report.page import COMPARE_SCRIPTS, COMPARE_STYLES, pixel_data, render_page
from raysteps.report.terminal import progress, short_path
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback

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


# The page.

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


# The command line, and what is drawn.

_LEAST, _MAX = 16, 2048  # pixels along a side
_MAX_SAMPLES = 4096  # of a pixel


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What to show, and where."""
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where index.html goes")
    parser.add_argument(
        "--scene",
        action="append",
        default=[],
        metavar="S",
        help=f"an NFF or pbrt file, or the name of a scene of the kit; may be repeated ({', '.join(CHOSEN)})",
    )
    parser.add_argument("--mine", action="store_true", help="show the pictures of your own steps, too")
    sizes = "800x600; 480x360 for scenes of part two"
    size = partial(picture_size, _LEAST, _MAX, "800x600")
    parser.add_argument("--size", type=size, metavar="WxH", help=f"of the pictures ({sizes})")
    number = partial(square_number, _MAX_SAMPLES)
    samples = f"of a pixel in scenes of part two: four times as many halve the noise ({SAMPLES})"
    parser.add_argument("--samples", type=number, default=SAMPLES, metavar="N", help=samples)


def _entry(
    kit: BuiltKit, scene: GalleryScene, options: PictureOptions, own: MySteps | None, say: ProgressCallback
) -> GalleryEntry:
    shots = reference_shots(kit, scene, options, say)
    work_maps = reference_work_maps(kit, scene, say)
    if own is None:
        return GalleryEntry(scene, shots, work_maps)
    mine = []
    for step in kit.steps:
        say(f"{scene.name}: your step {step.number}")
        mine.append(own.shot(step, scene, options))
    return GalleryEntry(scene, shots, work_maps, mine, own.work_maps(scene))


def _notes(scenes: Sequence[GalleryEntry], kit: BuiltKit) -> list[str]:
    """Of steps without a picture; each note once."""
    pairs = [(step, shot) for entries in scenes for step, shot in zip(kit.steps, entries.mine, strict=False)]
    return list(
        dict.fromkeys(f"{step.id}: {shot.note}" for step, shot in pairs if shot is not None and shot.pixels is None)
    )


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """0 when the page was made, also where some of the student's pictures could not be."""
    out: Path = arguments.out
    if out.is_file():
        raise UsageError(f"--out {out}: is a file; expected a folder")
    usable_folder(out)
    scenes = gallery_scenes(project, arguments.scene, read_steps(project))
    options = PictureOptions(arguments.size or "", arguments.samples)
    with console.status("starting") as status, ExitStack() as stack:
        say = progress(console, status)
        kit = build_kit(project, say)
        own = stack.enter_context(my_steps(kit, say)) if arguments.mine else None
        entries = [_entry(kit, scene, options, own, say) for scene in scenes]
        say("writing the page")
        page = gallery_page(kit.steps, entries).encode("utf-8", "replace")
    path = out / "index.html"
    write_out(path, page)
    for note in _notes(entries, kit):
        print_plain(console, f"No picture of {note}")
    console.print(f"Gallery: {escape(short_path(path.resolve()))} ({shown_size(len(page))})", soft_wrap=True)
    return 0
