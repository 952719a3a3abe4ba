"""Which object of the scene a pixel shows, and the scene with its materials changed."""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from raysteps.common.errors import GraderFault
from raysteps.kit.built_kit import BuiltKit
from raysteps.programs.pictures import Pixels
from raysteps.programs.rendering import reference_picture

_KINDS = {"s": "sphere", "c": "cone", "p": "polygon", "pp": "polygon"}
_MOST = 1 << 24  # as many as there are colours
_PLAIN = "1 0 1 0 1"  # kd, ks, shine, transmittance, index


@dataclass(frozen=True)
class Object:
    """What one line of the scene begins."""

    kind: str
    line: int


@dataclass(frozen=True)
class ObjectMap:
    """For each pixel the number of its object, 0 for the background; object n is objects[n - 1]."""

    numbers: npt.NDArray[np.int32]
    objects: Sequence[Object]


def read_scene(scene: Path) -> str:
    try:
        return scene.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise GraderFault(f"{scene}: cannot be read: {error}") from error


def size_of(args: Sequence[str]) -> tuple[str, ...]:
    """The words of a picture's arguments that say how large it is."""
    at = list(args).index("--size") if "--size" in args else len(args)
    return tuple(args[at : at + 2])


def render_text(kit: BuiltKit, nff: str, args: tuple[str, ...]) -> Pixels:
    """The reference's picture of a scene that is no file; kept by what it says."""
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        path = Path(folder) / "scene.nff"
        path.write_text(nff, encoding="utf-8")
        return reference_picture(kit, path, args)


def _colour(number: int) -> str:
    return " ".join(f"{(number >> shift & 255) / 255:.9g}" for shift in (16, 8, 0))


def numbered(nff: str) -> tuple[str, list[Object]]:
    """The scene with its objects coloured by their numbers."""
    out: list[str] = []
    objects: list[Object] = []
    for at, line in enumerate(nff.splitlines(), start=1):
        words = line.split()
        word = words[0] if words else ""
        if word in _KINDS and len(objects) < _MOST - 1:
            objects.append(Object(_KINDS[word], at))
            out.append(f"f {_colour(len(objects))} {_PLAIN}")
        out.append("b 0 0 0" if word == "b" else line)
    return "\n".join(out) + "\n", objects


def without_highlights(nff: str) -> str:
    """The scene with every ks 0."""
    lines = []
    for line in nff.splitlines():
        words = line.split()
        lines.append(" ".join([*words[:5], "0", *words[6:]]) if words[:1] == ["f"] and len(words) == 9 else line)
    return "\n".join(lines) + "\n"


def object_map(kit: BuiltKit, scene: Path, args: Sequence[str]) -> ObjectMap:
    """What the reference sees first in each pixel."""
    nff, objects = numbered(read_scene(scene))
    pixels = render_text(kit, nff, ("--step", "2", *size_of(args))).astype(np.int32)
    return ObjectMap(pixels[..., 0] << 16 | pixels[..., 1] << 8 | pixels[..., 2], objects)
