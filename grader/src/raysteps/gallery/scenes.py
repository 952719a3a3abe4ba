"""Which scenes the gallery shows."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.text import printable, shorten
from raysteps.course.manifest import Step
from raysteps.course.project import Project, generated

# What a visitor of the gallery is told: what each step adds, and what to look at in a scene.

_LONGEST = 240
_NEW = {
    "01-camera-rays": (
        "One ray leaves the eye through the middle of each pixel. Nothing is in its way yet: the colour is the "
        "direction of the ray itself."
    ),
    "02-intersection": (
        "A ray meets spheres and triangles, and the nearest one wins. The colour tells which way the surface faces, "
        "so every shape can be seen before there is any light."
    ),
    "03-phong-shading": (
        "Lamps are lit. A surface that faces a lamp is bright, a polished one shows the lamp as a highlight. But "
        "nothing casts a shadow, so everything floats."
    ),
    "04-shadows": (
        "Before a lamp may light a point, a second ray asks whether anything stands between the two. Things get weight "
        "and stand on the ground."
    ),
    "05-reflection": (
        "A mirrored ray is traced like any other, and so is the one after it. Polished things show the world around "
        "them, and themselves in it."
    ),
    "06-octree": (
        "The picture does not change by a single byte, and that is the point: space is divided into boxes within "
        "boxes, and a ray asks only the surfaces in boxes that it enters."
    ),
    "07-tone-mapping": (
        "Light has no upper end, a byte has one. c / (c + 1) brings back what was cut off to plain white: shapes, hues "
        "and highlights."
    ),
    "08-refraction": (
        "Glass lets light through and bends it, so the world in a glass ball stands on its head. Where the angle is "
        "too flat, all of the light is mirrored instead."
    ),
    "09-bvh": (
        "The same picture again, and still less work: boxes that fit the things, cut where chance says that rays have "
        "the least to do."
    ),
}
_SCENES = {
    "showcase": ("Showcase", "Painted balls, pillars, a mirror, polished tiles and glass: something for every step."),
    "sphereflake": ("Sphereflake", "A ball carries nine smaller ones, and each of these nine more: 820 in all."),
    "facing-mirrors": ("Facing mirrors", "Two mirrors that look at each other: a corridor without an end."),
    "mountain": ("Mountain", "A mountain made by chance, at a lake that mirrors it, behind four balls of glass."),
    "gears": ("Gears", "Meshing gears, each face a polygon of 144 corners, some of them of glass."),
}


def what_is_new(step: Step) -> str:
    """One or two sentences."""
    return step.about or _NEW.get(step.id, step.title)


def _first_sentence(scene: Path) -> str:
    """Of the comment that the file begins with."""
    try:
        with scene.open(encoding="utf-8", errors="replace") as file:
            head = [file.readline(1000) for _ in range(12)]
    except OSError:
        return ""
    lines = []
    for line in head:
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# \t").strip())
    sentence = re.split(r"(?<=[.:])\s", " ".join(lines))[0].rstrip(":")
    return shorten(printable(sentence), _LONGEST)


def about_scene(name: str, scene: Path) -> tuple[str, str]:
    """Its title, and a sentence."""
    title = printable(name.replace("-", " ")).capitalize() or "Scene"
    return _SCENES.get(name) or (title, _first_sentence(scene))


CHOSEN = ("showcase", "sphereflake", "facing-mirrors", "mountain", "gears")
_FLAKE = 3  # generations: enough surfaces for the boxes to pay, few enough to be counted one by one


@dataclass(frozen=True)
class GalleryScene:
    """One scene of the gallery."""

    name: str
    title: str
    words: str
    path: Path


def _committed(project: Project) -> dict[str, Path]:
    folders = ("lessons", "generated")
    return {path.stem: path for folder in folders for path in sorted((project.scenes / folder).glob("*.nff"))}


def _find(project: Project, word: str) -> Path:
    known = _committed(project)
    if word == "sphereflake":
        return generated(project, word, _FLAKE)
    if word in known:
        return known[word]
    path = Path(word)
    if not path.is_file():
        raise UsageError(f"--scene {word}: is not there; expected an NFF file or one of {', '.join(sorted(known))}")
    return path


def gallery_scenes(project: Project, words: Sequence[str]) -> list[GalleryScene]:
    """Those that were asked for, each once; those that show the steps best when none was."""
    paths = {_find(project, word).resolve(): word for word in words or CHOSEN}
    shown = []
    for path, word in paths.items():
        name = word if word in CHOSEN else path.stem
        shown.append(GalleryScene(name, *about_scene(name, path), path))
    return shown
