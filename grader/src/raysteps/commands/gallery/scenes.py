"""Which scenes the gallery shows."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from raysteps.commands.gallery.words import about_scene
from raysteps.common.errors import UsageError
from raysteps.kit.project import Project
from raysteps.kit.scenes import generated

CHOSEN = ("showcase", "sphereflake", "facing-mirrors", "mountain", "gears")
_FLAKE = 3  # generations: enough surfaces for the boxes to pay, few enough to be counted one by one


@dataclass(frozen=True)
class Shown:
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


def shown_scenes(project: Project, words: Sequence[str]) -> list[Shown]:
    """Those that were asked for, each once; those that show the steps best when none was."""
    paths = {_find(project, word).resolve(): word for word in words or CHOSEN}
    shown = []
    for path, word in paths.items():
        name = word if word in CHOSEN else path.stem
        shown.append(Shown(name, *about_scene(name, path), path))
    return shown
