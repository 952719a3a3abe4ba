"""Makers of procedural scenes. Each module has a function build(size, rng) that returns a Scene."""

import random
from collections.abc import Callable
from dataclasses import dataclass

from . import gears, mountain, rings, ripples, sphereflake, tetrahedra
from .nff import Scene


@dataclass(frozen=True)
class Kind:
    """A kind of scene: its maker, the size used when none is given, and the largest allowed."""

    build: Callable[[int, random.Random], Scene]
    size: int
    largest: int


KINDS: dict[str, Kind] = {
    "sphereflake": Kind(sphereflake.build, 4, 6),
    "tetrahedra": Kind(tetrahedra.build, 6, 10),
    "rings": Kind(rings.build, 6, 40),
    "mountain": Kind(mountain.build, 6, 10),
    "gears": Kind(gears.build, 4, 30),
    "ripples": Kind(ripples.build, 16, 100),
}


def make(kind: str, size: int, seed: int) -> str:
    """The text of the scene. Equal arguments give equal text."""
    scene = KINDS[kind].build(size, random.Random(seed))
    return scene.text(f"{kind}, size {size}, seed {seed}: made by scenes/generate.py, do not edit")
