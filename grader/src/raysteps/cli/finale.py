"""The command `finale`: the student's own program draws a scene large and smooth; a page and a poster show it."""

import argparse
import os
import re
import tempfile
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.cli import STUDENTS_KIT, add_impl, picture_size, square_number, whole_number
from raysteps.cli.render import build_program, resolve_scene, run_raytrace
from raysteps.cli.todo_steps import built_trees, unfinished
from raysteps.common.errors import UsageError, reason
from raysteps.common.files import usable_folder, write_out
from raysteps.common.platform import kit_command, own_command
from raysteps.common.text import clean, count, join_and, print_plain
from raysteps.common.text import size as shown_size
from raysteps.course.manifest import Step, read_steps
from raysteps.course.project import Project, is_of_part_two
from raysteps.finale.finale_page import Finale, Station, finale_page, has_glyphs, in_words, poster
from raysteps.finale.own_pictures import (
    AvailableSteps,
    OwnProgram,
    RenderFailed,
    available_steps,
    refuse_without_denoiser,
)
from raysteps.images.compare import write_png
from raysteps.progress.standing import standings
from raysteps.report.terminal import short_path
from raysteps.toolchain.cmake import release_tree

_SCENE, _TITLE = "generated/ripples.nff", "Ripples"
_TEMPLATE = "template.nff"
_SIZE, _SMALL_SIZE = "1600x900", "640x360"
_SAMPLES, _FEW_SAMPLES, _NOISY_SAMPLES = 9, 4, 64
_BLACK = "The picture is black: lamps that have a size shine from step 12 on."
_SIDE = (160, 8192)  # pixels
_MAX_SAMPLES = 64
_MAX_LETTERS = 60  # of the title
_BAD_SCENE = UsageError.exit_code  # raytrace has said where


def _words(word: str) -> str:
    text = clean(word).strip()
    if len(text) > _MAX_LETTERS or "\n" in text:
        raise argparse.ArgumentTypeError(f"expected one line of at most {_MAX_LETTERS} letters")
    return text


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What to draw, how large and how smooth, and where to."""
    parser.add_argument("scene", nargs="?", metavar="SCENE", help=f"an NFF or pbrt file (scenes/{_SCENE})")
    parser.add_argument("--new", type=Path, metavar="FILE.nff", help="write a scene to begin with, and draw nothing")
    parser.add_argument("-o", "--out", type=Path, metavar="FOLDER", help="where the page goes (build/finale)")
    parser.add_argument(
        "--name", type=_words, default="", metavar="NAME", help="whose picture it is, on page and poster"
    )
    parser.add_argument("--title", type=_words, metavar="TITLE", help="of page and poster (the scene's name)")
    kit = parser.get_default(STUDENTS_KIT)
    size, samples = _SMALL_SIZE, str(_FEW_SAMPLES)
    if kit is None or built_trees(kit):
        size, samples = f"{_SIZE}, without a tree {size}", f"{_SAMPLES}, without a tree {samples}"
    parser.add_argument(
        "--size",
        type=partial(picture_size, *_SIDE, _SIZE),
        metavar="WxH",
        help=f"of the picture, from {_SIDE[0]} to {_SIDE[1]} pixels a side ({size}; of your own scene what it says)",
    )
    parser.add_argument(
        "--samples",
        type=partial(square_number, _MAX_SAMPLES),
        metavar="N",
        help=f"rays for each pixel: 1, 4, 9, 16 ... 64 ({samples}), of part two {_NOISY_SAMPLES}",
    )
    parser.add_argument(
        "--denoise",
        action="store_true",
        help="take the noise out of a picture of part two, by Open Image Denoise, if that is installed",
    )
    threads = partial(whole_number, 1, 1024)
    parser.add_argument("--threads", type=threads, metavar="N", help="the pictures are the same for any number")
    add_impl(parser)


def _new_scene(project: Project, path: Path, console: Console) -> int:
    """Writes the template where nothing is yet."""
    if path.suffix.lower() != ".nff":
        raise UsageError(f"--new {path}: expected a name that ends in .nff")
    text = (project.scenes / _TEMPLATE).read_bytes()
    try:
        with path.open("xb") as file:
            file.write(text)
    except FileExistsError:
        raise UsageError(f"--new {path}: is there already, and stays as it is; expected a new name") from None
    except OSError as error:
        raise UsageError(f"--new {path}: cannot be written: {reason(error)}") from error
    console.print(escape(f"Written: {path}. Change it, then: {kit_command('finale', path)}"), soft_wrap=True)
    return 0


def _available_to(project: Project, impl: str, *, part_two: bool) -> AvailableSteps:
    steps = read_steps(project)
    mine = impl == "mine"
    left = {step.id for upto in steps for step, _ in unfinished(project, upto.index)} if mine else set()
    available = available_steps(steps, {step.id for step in steps} - left, part_two=part_two)
    if not any(not step.is_about_a_tree for step in available.drawn):
        first = steps[0]
        raise UsageError(
            f"step {first.number} is not written yet, and without it there is no picture: expected its functions in "
            f"steps/{first.path.as_posix()}; {own_command()} watch {first.number}"
        )
    if part_two and not any(step.is_in_part_two for step in available.drawn):
        raise UsageError("a scene that ends in .pbrt is for part two: expected step 10, and all before it")
    return available


def _notes(project: Project, available: AvailableSteps, impl: str) -> dict[str, str]:
    """By step: what keeps it from being done."""
    notes = {
        step.id: f"Still to be written. {own_command()} watch {step.number} begins it." for step in available.missing
    }
    if impl == "mine":
        for standing in standings(project):
            if not standing.is_done and standing.step.id not in notes:
                notes[standing.step.id] = f"Drawn as it is: {standing.words}."
    return notes


def _check_resolution(scene: str) -> None:
    """Of a scene that is drawn as large as it says. What is wrong with the file else raytrace tells, with the place."""
    if not Path(scene).is_file():
        return  # a pipe can be read only once
    text = re.sub("#.*", "", Path(scene).read_text(encoding="utf-8", errors="replace"))
    found = re.search(r"(?<!\S)resolution\s+([0-9]{1,6})\s+([0-9]{1,6})(?!\S)", text)
    if found is not None and not all(_SIDE[0] <= int(side) <= _SIDE[1] for side in found.groups()):
        raise UsageError(
            f"{scene}: its resolution is {found[1]}x{found[2]}: expected {_SIDE[0]} to {_SIDE[1]} pixels along each "
            "side for a page; --size draws it in another"
        )


def _say_more(said: Sequence[str], console: Console) -> None:
    for line in said:
        print_plain(console, line)


def _stations(
    own: OwnProgram,
    available: AvailableSteps,
    steps: Sequence[Step],
    shape: tuple[int, ...],
    notes: dict[str, str],
    console: Console,
) -> list[Station]:
    found = []
    for step in filter(available.shows, steps):
        pixels = None
        if step in available.drawn:
            console.print(f"step {step.number}: {step.title}", style="dim", markup=False, highlight=False)
            pixels = own.small(available, step, shape)
        note = notes.get(step.id, "")
        if available.part_two and pixels is not None and not pixels.any():
            pixels, note = None, f"{_BLACK} {note}".rstrip()
        found.append(Station(step, pixels, note))
    return found


def _say_first(available: AvailableSteps, impl: str, scene: str, samples: int, console: Console) -> None:
    missing = [f"{step.number} {step.title}{' (bonus)' if step.bonus else ''}" for step in available.missing]
    it = "it" if len(missing) == 1 else "them"
    said = [f"not written yet, so without {it}: {join_and(missing)}"] if missing else []
    if available.tree == "none":
        tree = next((step for step in available.missing if step.is_about_a_tree), None)
        without = "" if tree is None else f"without step {tree.number} "
        said.append(f"{without}every ray asks every surface, which takes long")
    whose = "your program" if impl == "mine" else "the reference's program"
    said.append(f"{whose} draws {scene}, {count(samples, 'ray')} for each pixel")
    _say_more([f"raysteps: {line}" for line in said], console)


def _make(
    project: Project,
    arguments: argparse.Namespace,
    own: OwnProgram,
    available: AvailableSteps,
    out: Path,
    console: Console,
) -> None:
    ours = arguments.scene is None
    usual = _NOISY_SAMPLES if available.part_two else _SAMPLES if available.tree != "none" else _FEW_SAMPLES
    samples = arguments.samples or usual
    size = arguments.size or ((_SIZE if available.tree != "none" else _SMALL_SIZE) if ours else None)
    _say_first(available, arguments.impl, short_path(Path(own.scene)), samples, console)
    large = own.large(available, size, samples, denoise=arguments.denoise)
    notes = _notes(project, available, arguments.impl)
    stations = _stations(own, available, read_steps(project), large.pixels.shape, notes, console)
    counted = own.counted(available, large)
    title = arguments.title or (
        _TITLE if ours else clean(Path(own.scene).stem.replace("-", " ")).capitalize() or "Scene"
    )
    steps = count(len(available.drawn), "step")
    words = (
        f"Ray traced by {'a program of my own' if arguments.impl == 'mine' else 'the reference'}, written in {steps}"
    )
    words += ", and cleaned by Open Image Denoise" if arguments.denoise else ""
    rays = f"{in_words(large.work.rays)} rays"
    finale = Finale(title, arguments.name, f"{words}.", large, stations, counted, own_command())
    page = finale_page(finale).encode("utf-8", "replace")
    write_png(large.pixels, out / "finale.png")
    if large.noisy is not None:
        write_png(large.noisy, out / "finale-noisy.png")
    write_png(poster(large.pixels, title, arguments.name, f"{words}: {rays}"), out / "poster.png")
    write_out(out / "finale.html", page)
    said = [f"drawn in {large.seconds:.0f} s: {rays}"]
    if counted:
        best = min(counted, key=lambda one: one.work.tests_per_ray)
        share = best.work.tests_per_ray / (counted[0].work.tests_per_ray or 1.0)
        said.append(f"{best.name}: {100 * (1 - share):.1f} % of the tests spared")
    if not all(has_glyphs(text) for text in (title, arguments.name)):
        said.append(
            "no font here has all letters of title and name: the poster does without; the page, printed, has them"
        )
    said.append(
        f"Finale: {short_path((out / 'finale.html').resolve())} ({shown_size(len(page))}); beside it finale.png "
        "and poster.png"
    )
    _say_more(said, console)


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """0 when the page was made; what raytrace says when it could not draw."""
    if arguments.new is not None:
        if arguments.scene is not None:
            raise UsageError(f"{arguments.scene}: --new writes a scene and draws none; expected one of the two")
        return _new_scene(project, arguments.new, console)
    scene = arguments.scene or os.fspath(project.scenes / _SCENE)
    scene = resolve_scene(project, scene)
    part_two = is_of_part_two(Path(scene))
    if arguments.denoise:
        if not part_two:
            raise UsageError("--denoise: expected a scene of part two (.pbrt): what part one draws has no noise")
        refuse_without_denoiser()
    if arguments.scene is not None and arguments.size is None and not part_two:
        _check_resolution(scene)
    out: Path = arguments.out or project.build / "finale"
    usable_folder(out)
    available = _available_to(project, arguments.impl, part_two=part_two)
    program = build_program(release_tree(project), "raytrace", arguments.impl)
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        threads = () if arguments.threads is None else ("--threads", str(arguments.threads))
        own = OwnProgram(partial(run_raytrace, program), scene, Path(folder), threads)
        try:
            _make(project, arguments, own, available, out, console)
        except RenderFailed as stopped:
            if stopped.code != _BAD_SCENE:
                _say_more([f"raysteps: no finale without {stopped}"], console)
            return stopped.code
    return 0
