"""The command `gallery`: chosen scenes after every step, on one page."""

import argparse
from collections.abc import Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.cli import picture_size, square_number
from raysteps.common.errors import UsageError
from raysteps.common.files import usable_folder, write_out
from raysteps.common.text import size as shown_size
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.gallery.gallery_page import GalleryEntry, gallery_page
from raysteps.gallery.shots import (
    CHOSEN,
    SAMPLES,
    GalleryScene,
    MySteps,
    PictureOptions,
    gallery_scenes,
    my_steps,
    reference_shots,
    reference_work_maps,
)
from raysteps.report.terminal import progress, short_path
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback

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
        console.print(f"No picture of {note}", markup=False, highlight=False, soft_wrap=True)
    console.print(f"Gallery: {escape(short_path(path.resolve()))} ({shown_size(len(page))})", soft_wrap=True)
    return 0
