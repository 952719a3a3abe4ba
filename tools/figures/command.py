"""The command `figures`: makes the figures of the handouts anew, or tells which are out of date."""

import argparse
import fnmatch
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from rich.console import Console

from raysteps.common.errors import UsageError
from raysteps.common.files import write_bytes
from raysteps.common.text import count, print_plain
from raysteps.course.project import Project
from raysteps.images.compare import Pixels
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback
from tools.figures import boxes, meshes, rays, renders, sampling, shading
from tools.figures.measuring import measured

# All figures: their files, and what makes them.

FOLDER = "docs/figures"
_DIAGRAMS = {
    "01-window": rays.window,
    "01-pixels": rays.from_the_side,
    "01-ray": rays.ray_points,
    "02-sphere": rays.sphere,
    "02-triangle": rays.triangle,
    "02-normal": rays.normal,
    "03-directions": shading.phong,
    "03-cosine": shading.cosine,
    "04-shadow-ray": shading.shadow,
    "04-acne": shading.acne,
    "05-mirror": shading.mirrored,
    "05-tree": shading.tree,
    "06-boxes": boxes.quadtree,
    "06-slabs": boxes.slabs,
    "06-overlap": boxes.overlap,
    "08-snell": shading.snell,
    "08-ball": shading.glass_ball,
    "09-cut": boxes.cut,
    "10-points": sampling.points,
    "13-lifted": sampling.lifted,
    "13-path": sampling.path,
    "11-weights": meshes.weights,
    "11-lift": meshes.lift,
    "11-texels": meshes.texels,
    "11-levels": meshes.levels,
    "12-cone": sampling.cone,
    "12-disk": sampling.disk,
    "12-lens": sampling.lens,
    "12-penumbra": sampling.penumbra,
    "14-visible": sampling.visible,
    "15-two-ways": sampling.two_ways,
}
_CURVES = {
    "03-highlight": shading.highlight,
    "07-curve": shading.tone,
    "10-errors": sampling.errors,
    "10-filters": sampling.filters,
    "10-screen": sampling.screen,
    "15-weights": sampling.weights,
}
_PLOTS = {
    "04-threshold": shading.thresholds,
    "05-rays": shading.bounces,
    "06-growth": boxes.growth,
    "06-depth": boxes.depths,
}


@dataclass(frozen=True)
class Figure:
    """A file of the repository. Text is compared by the byte, a picture with some patience."""

    name: str
    path: str
    draw: Callable[[BuiltKit], str | Pixels]


def _diagram(name: str, _kit: BuiltKit) -> str:
    return _DIAGRAMS[name]().svg()


def _curve(name: str, _kit: BuiltKit) -> str:
    return _CURVES[name]()


def _plot(name: str, kit: BuiltKit) -> str:
    return _PLOTS[name](measured(kit))


def _shot(name: str, kit: BuiltKit) -> Pixels:
    return renders.SHOTS[name].pixels(kit)


def figures() -> list[Figure]:
    """Sorted by name."""
    makers: dict[str, Callable[[BuiltKit], str | Pixels]] = {}
    for names, make in ((_DIAGRAMS, _diagram), (_CURVES, _curve), (_PLOTS, _plot)):
        makers |= {f"{name}.svg": partial(make, name) for name in names}
    makers |= {f"{name}.png": partial(_shot, name) for name in renders.SHOTS}
    found = [Figure(file.rpartition(".")[0], f"{FOLDER}/{file}", make) for file, make in makers.items()]
    found.append(Figure("01-before", f"{FOLDER}/01-before.png", renders.untouched))
    found.append(Figure("12-before", f"{FOLDER}/12-before.png", renders.hard_shadows))
    found.append(Figure("15-paths", f"{FOLDER}/15-paths.png", renders.paths_alone))
    found.append(Figure("sphereflake", "docs/pictures/sphereflake.png", renders.sphereflake))
    found.append(Figure("still-life", "docs/pictures/still-life.png", renders.still_life))
    found.append(Figure("work-maps", "docs/pictures/work-maps.png", renders.work_maps))
    found.append(Figure("window", "docs/pictures/window.png", renders.window))
    found.append(Figure("steps", "docs/pictures/steps.png", renders.contact_sheet))
    return sorted(found, key=lambda figure: figure.name)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Which figures, and whether to write them."""
    parser.add_argument("names", nargs="*", metavar="NAME", help="such as 06-growth or '04-*'; all when none is given")
    parser.add_argument("--check", action="store_true", help="only tell which are out of date")


def _chosen(names: Sequence[str]) -> list[Figure]:
    every = figures()
    for name in names:
        if not any(fnmatch.fnmatchcase(figure.name, name) for figure in every):
            known = ", ".join(figure.name for figure in every)
            raise UsageError(f"there is no figure '{name}'; the figures are {known}")
    return [one for one in every if not names or any(fnmatch.fnmatchcase(one.name, name) for name in names)]


def _renewed(project: Project, kit: BuiltKit, figure: Figure, say: ProgressCallback) -> str | Pixels | None:
    """What should be in the figure's file; none when it is there, or cannot be drawn here."""
    path = project.root / figure.path
    try:
        drawn = figure.draw(kit)
    except renders.CannotDraw as missing:
        say(f"{figure.path} is left as it is: {str(missing).splitlines()[0]}")
        return None
    if isinstance(drawn, str):
        is_current = path.is_file() and path.read_bytes() == drawn.encode()
    else:
        is_current = renders.is_current(path, drawn)
    return None if is_current else drawn


def _nobodys(project: Project) -> list[str]:
    known = {figure.path for figure in figures()}
    folder = project.root / FOLDER
    found = (path.relative_to(project.root).as_posix() for path in folder.rglob("*") if path.is_file())
    return sorted(path for path in found if path not in known)


def out_of_date(project: Project, say: ProgressCallback, names: Sequence[str] = ()) -> list[str]:
    """Paths that are missing, old, or made by no figure."""
    kit = build_kit(project, say, of_all_parts=True)
    old = [figure.path for figure in _chosen(names) if _renewed(project, kit, figure, say) is not None]
    return old + ([] if names else _nobodys(project))


def _write(path: Path, drawn: str | Pixels) -> None:
    if isinstance(drawn, str):
        write_bytes(path, drawn.encode())
    else:
        renders.write(path, drawn)


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Writes what is out of date, or names it and returns 1."""

    def say(text: str) -> None:
        print(f"raysteps: {text}", file=sys.stderr, flush=True)

    if arguments.check:
        old = out_of_date(project, say, arguments.names)
        for path in old:
            print_plain(console, f"{path} is not what ./raysteps figures makes")
        if not old:
            console.print(f"{count(len(_chosen(arguments.names)), 'figure')} up to date", highlight=False)
        return 1 if old else 0
    chosen = _chosen(arguments.names)
    kit = build_kit(project, say, of_all_parts=True)
    for figure in chosen:
        drawn = _renewed(project, kit, figure, say)
        if drawn is not None:
            _write(project.root / figure.path, drawn)
            print_plain(console, f"{figure.path} written")
    for path in [] if arguments.names else _nobodys(project):
        (project.root / path).unlink()
        print_plain(console, f"{path} removed: no figure makes it")
    return 0
