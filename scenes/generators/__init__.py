"""Makers of procedural scenes: functions of size and rng that return a Scene, or a MeshScene for part two."""

import random
from collections.abc import Callable
from dataclasses import dataclass

from . import gears, meshes, mountain, rings, ripples, sphereflake, tetrahedra
from .meshes import MeshScene
from .nff import Scene


@dataclass(frozen=True)
class Kind:
    """A kind of scene: its maker, the size used when none is given, and the largest allowed."""

    build: Callable[[int, random.Random], Scene | MeshScene]
    size: int
    largest: int


KINDS: dict[str, Kind] = {
    "sphereflake": Kind(sphereflake.build, 4, 6),
    "tetrahedra": Kind(tetrahedra.build, 6, 10),
    "rings": Kind(rings.build, 6, 40),
    "mountain": Kind(mountain.build, 6, 10),
    "gears": Kind(gears.build, 4, 30),
    "ripples": Kind(ripples.build, 16, 100),
    "vase": Kind(meshes.vase, 6, 200),
    "knot": Kind(meshes.knot, 5, 200),
    "studio": Kind(meshes.studio, 6, 200),
}


def make(kind: str, size: int, seed: int) -> str:
    """The text of the scene. Equal arguments give equal text."""
    scene = KINDS[kind].build(size, random.Random(seed))
    return scene.text(f"{kind}, size {size}, seed {seed}: made by scenes/generate.py, do not edit")
