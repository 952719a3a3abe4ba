"""Meshing gears: each face is one concave polygon of 144 corners."""

import math
import random

from .nff import Material, Scene
from .vectors import Vec

TEETH = 24
ROOT, TIP = 0.86, 1.11
# Half the distance of two axes: a tip stays clear of the opposite root.
PITCH = 1.0
HALF_THICKNESS = 0.22
# One tooth as (share of the tooth's angle, radius): root, flank, tip, flank, root.
PROFILE = ((0.0, ROOT), (0.22, ROOT), (0.31, 0.95), (0.41, TIP), (0.59, TIP), (0.69, 0.95))
METALS: tuple[Vec, ...] = ((0.95, 0.6, 0.12), (0.9, 0.34, 0.16), (0.6, 0.66, 0.75), (0.3, 0.6, 0.35))


def outline(center: tuple[float, float], turn: float) -> list[tuple[float, float]]:
    """The corners in the plane, counter-clockwise; at turn 0 a tooth points along x."""
    step = 2.0 * math.pi / TEETH
    result: list[tuple[float, float]] = []
    for tooth in range(TEETH):
        for share, radius in PROFILE:
            angle = turn + step * (tooth + share - 0.5)
            result.append((center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle)))
    return result


def gear(scene: Scene, center: tuple[float, float], turn: float) -> None:
    """A gear that lies flat, its axis along y."""
    ring = outline(center, turn)

    def lift(point: tuple[float, float], height: float) -> Vec:
        return (point[0], height, -point[1])

    top, bottom = HALF_THICKNESS, -HALF_THICKNESS
    scene.polygon([lift(point, top) for point in ring])
    scene.polygon([lift(point, bottom) for point in reversed(ring)])
    for here, there in zip(ring, [*ring[1:], ring[0]], strict=True):
        scene.polygon([lift(here, bottom), lift(there, bottom), lift(there, top), lift(here, top)])


def build(size: int, rng: random.Random) -> Scene:
    """size x size gears, neighbours half a tooth apart so that they mesh. Every fourth is of glass."""
    scene = Scene()
    reach = max(1.0, size * PITCH)
    eye = (0.55 * reach, 2.1 * reach + 0.7, 2.3 * reach + 0.7)
    scene.camera((0.4, 0.5, 0.7), eye, (0.0, -0.1 * reach, 0.08 * reach), 40.0)
    scene.light((-4.0 * reach, 5.0 * reach, 2.0 * reach), (1.6, 1.55, 1.45))
    scene.light((3.0 * reach, 4.0 * reach, 4.0 * reach), (1.0, 1.05, 1.15))
    scene.light((1.0 * reach, 6.0 * reach, -4.0 * reach), (0.9, 0.85, 0.75))
    scene.material(Material((0.3, 0.42, 0.62), kd=0.6, ks=0.25, shine=15.0))
    scene.floor(12.0 * reach, -0.7)
    start = rng.random()
    step = 2.0 * math.pi / TEETH
    for row in range(size):
        for column in range(size):
            center = (PITCH * (2 * column - size + 1), PITCH * (2 * row - size + 1))
            odd = (row + column) % 2 == 1
            # Turned by the same amount, but the other way round, so that teeth meet gaps everywhere.
            turn = step * (0.5 - start) if odd else step * start
            glass = (row + 2 * column) % 4 == 3
            color = METALS[(2 * row + column) % len(METALS)]
            shiny = Material(color, kd=0.6, ks=0.35, shine=25.0)
            scene.material(Material((0.5, 0.85, 0.9), 0.15, 0.15, 60.0, 0.85, 1.1) if glass else shiny)
            gear(scene, center, turn)
            scene.material(Material((0.9, 0.9, 0.92), kd=0.3, ks=0.6, shine=80.0))
            scene.sphere((center[0], HALF_THICKNESS, -center[1]), 0.3)
    return scene
