"""Chain mail: rings of cylinders and spheres, each linked to its neighbours in the rows next to it."""

import math
import random

from .nff import Material, Scene
from .vectors import Vec

SEGMENTS = 16
TUBE = 0.13
# Rings have radius 1. Rows lean by turns to the front and to the back, which lets four rings pass
# through each one without touching it.
LEAN = math.radians(28.0)
COLUMN_PITCH, ROW_PITCH = 2.36, 0.95
METALS: tuple[Vec, ...] = ((1.0, 0.64, 0.14), (0.6, 0.66, 0.78), (0.9, 0.34, 0.16))


def joints(center: Vec, lean: float) -> list[Vec]:
    """The corners of one ring."""
    result: list[Vec] = []
    for i in range(SEGMENTS):
        angle = 2.0 * math.pi * (i + 0.5) / SEGMENTS
        x, depth = math.cos(angle), math.sin(angle)
        shift = (x, depth * math.sin(lean), depth * math.cos(lean))
        result.append((center[0] + shift[0], center[1] + shift[1], center[2] + shift[2]))
    return result


def build(size: int, rng: random.Random) -> Scene:
    """size rings in each of 2 size + 1 rows; each ring is 16 cylinders and 16 spheres."""
    scene = Scene()
    rows = 2 * size + 1
    reach = 0.5 * COLUMN_PITCH * size
    eye = (0.75 * reach + 0.6, 1.75 * reach + 1.5, 2.1 * reach + 1.7)
    scene.camera((0.4, 0.5, 0.7), eye, (0.05 * reach, -0.2 * reach, 0.02 * reach), 38.0)
    scene.light((-3.0 * reach, 5.0 * reach + 2.0, 2.5 * reach), (1.7, 1.6, 1.5))
    scene.light((4.0 * reach, 4.0 * reach + 2.0, 1.0 * reach), (1.0, 1.05, 1.2))
    scene.light((0.0, 4.0 * reach + 2.0, -4.0 * reach), (0.9, 0.85, 0.75))
    scene.material(Material((0.36, 0.05, 0.08), kd=0.65, ks=0.2, shine=12.0))
    scene.floor(10.0 * reach, -1.0)
    first = int(rng.random() * len(METALS))
    for row in range(rows):
        scene.material(Material(METALS[(first + row) % len(METALS)], kd=0.55, ks=0.4, shine=35.0))
        shift = 0.25 if row % 2 == 0 else -0.25
        for column in range(size):
            x = COLUMN_PITCH * (column - 0.5 * (size - 1) + shift)
            ring = joints((x, 0.0, ROW_PITCH * (row - size)), LEAN if row % 2 == 0 else -LEAN)
            for here, there in zip(ring, [*ring[1:], ring[0]], strict=True):
                scene.cylinder(here, there, TUBE)
                scene.sphere(here, TUBE)
    return scene
