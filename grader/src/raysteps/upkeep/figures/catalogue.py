"""All figures: their files, and what makes them."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from raysteps.kit.built_kit import BuiltKit
from raysteps.programs.pictures import Pixels
from raysteps.upkeep.figures import bending, boxes, camera, curves, plots, quadtree, renders, shading, surfaces
from raysteps.upkeep.figures.measuring import measured
from raysteps.upkeep.figures.window import window

FOLDER = "docs/figures"
_DIAGRAMS = {
    "01-window": camera.window,
    "01-pixels": camera.from_the_side,
    "01-ray": camera.ray_points,
    "02-sphere": surfaces.sphere,
    "02-triangle": surfaces.triangle,
    "02-normal": surfaces.normal,
    "03-directions": shading.phong,
    "03-cosine": shading.cosine,
    "04-shadow-ray": shading.shadow,
    "04-acne": shading.acne,
    "05-mirror": bending.mirrored,
    "05-tree": bending.tree,
    "06-boxes": quadtree.quadtree,
    "06-slabs": boxes.slabs,
    "06-overlap": boxes.overlap,
    "08-snell": bending.snell,
    "08-ball": bending.glass_ball,
    "09-cut": boxes.cut,
}
_CURVES = {"03-highlight": curves.highlight, "07-curve": curves.tone}
_PLOTS = {
    "04-threshold": plots.acne,
    "05-rays": plots.bounces,
    "06-growth": plots.growth,
    "06-depth": plots.depths,
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
    found.append(Figure("sphereflake", "docs/pictures/sphereflake.png", renders.sphereflake))
    found.append(Figure("work-maps", "docs/pictures/work-maps.png", renders.work_maps))
    found.append(Figure("window", "docs/pictures/window.png", window))
    found.append(Figure("steps", "docs/pictures/steps.png", renders.contact_sheet))
    return sorted(found, key=lambda figure: figure.name)
