"""Which scenes the gallery shows."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError
from raysteps.common.text import printable, shorten
from raysteps.course.project import Project, generated

# What a visitor of the gallery is told; what each step adds, its step.toml says.

_LONGEST = 240
_SCENES = {
    "showcase": ("Showcase", "Painted balls, pillars, a mirror, polished tiles and glass: something for every step."),
    "sphereflake": ("Sphereflake", "A ball carries nine smaller ones, and each of these nine more: 820 in all."),
    "facing-mirrors": ("Facing mirrors", "Two mirrors that look at each other: a corridor without an end."),
    "mountain": ("Mountain", "A mountain made by chance, at a lake that mirrors it, behind four balls of glass."),
    "gears": ("Gears", "Meshing gears, each face a polygon of 144 corners, some of them of glass."),
}


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
        raise UsageError(
            f"--scene {word}: there is no such scene; expected an NFF file or one of {', '.join(sorted(known))}"
        )
    return path


def gallery_scenes(project: Project, words: Sequence[str]) -> list[GalleryScene]:
    """Those that were asked for, each once; those that show the steps best when none was."""
    paths = {_find(project, word).resolve(): word for word in words or CHOSEN}
    shown = []
    for path, word in paths.items():
        name = word if word in CHOSEN else path.stem
        shown.append(GalleryScene(name, *about_scene(name, path), path))
    return shown
