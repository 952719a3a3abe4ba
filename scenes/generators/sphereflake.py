"""Sphereflake: every sphere carries nine spheres of a third of its radius."""

import math
import random

from .nff import Material, Scene
from .vectors import Vec, add, frame, scale, unit

SHRINK = 1.0 / 3.0
# How far the children stand off the equator of their parent, in degrees: six in a ring, three above.
RINGS = ((6, 8.0), (3, 58.0))
PALETTE: tuple[Vec, ...] = (
    (1.0, 0.5, 0.06),
    (0.95, 0.22, 0.06),
    (1.0, 0.45, 0.08),
    (1.0, 0.7, 0.25),
    (1.0, 0.9, 0.6),
)


def children(center: Vec, radius: float, axis: Vec, turn: float) -> list[tuple[Vec, Vec]]:
    """Centre and axis of the nine spheres that touch this one."""
    side, front = frame(axis)
    result: list[tuple[Vec, Vec]] = []
    for count, elevation in RINGS:
        up = math.sin(math.radians(elevation))
        out = math.cos(math.radians(elevation))
        for i in range(count):
            around = turn + 2.0 * math.pi * (i + 0.5 * (count == 3)) / count
            flat = add(scale(side, math.cos(around)), scale(front, math.sin(around)))
            direction = unit(add(scale(axis, up), scale(flat, out)))
            result.append((add(center, scale(direction, radius * (1.0 + SHRINK))), direction))
    return result


def build(size: int, rng: random.Random) -> Scene:
    """`size` is the number of generations after the first sphere: 4 gives 7381 spheres and the floor."""
    scene = Scene()
    scene.camera((0.4, 0.62, 1.1), (3.9, 3.7, 6.9), (0.0, 0.05, 0.0), 38.5)
    scene.light((8.0, 9.0, 6.0), (2.6, 2.5, 2.3))
    scene.light((-7.0, 8.0, 7.0), (1.2, 1.3, 1.5))
    scene.light((2.0, 7.0, -9.0), (1.0, 0.9, 0.8))
    scene.material(Material((0.12, 0.24, 0.5), kd=0.8, ks=0.2, shine=12.0))
    scene.floor(100.0, -2.0)
    turn = rng.random() * math.pi / 3.0
    spheres: list[tuple[Vec, Vec]] = [((0.0, 0.0, 0.0), (0.0, 1.0, 0.0))]
    radius = 1.5
    for level in range(size + 1):
        scene.material(Material(PALETTE[level % len(PALETTE)], kd=0.65, ks=0.35, shine=30.0))
        for center, _ in spheres:
            scene.sphere(center, radius)
        if level < size:
            spheres = [child for center, axis in spheres for child in children(center, radius, axis, turn)]
        radius *= SHRINK
    return scene
