"""A tetrahedron of tetrahedra (the Sierpinski pyramid)."""

import math
import random

from .nff import Material, Scene
from .vectors import Vec, middle

Corners = tuple[Vec, Vec, Vec, Vec]
# One colour for each of the four largest parts.
PALETTE: tuple[Vec, ...] = ((1.0, 0.7, 0.1), (0.9, 0.18, 0.14), (0.1, 0.5, 0.95), (0.2, 0.7, 0.28))


def first(turn: float) -> Corners:
    """A regular tetrahedron around the origin that stands on a face, radius 3."""
    low = -1.0
    ring = 3.0 * math.sqrt(8.0) / 3.0
    feet = [turn + 2.0 * math.pi * i / 3.0 for i in range(3)]
    a, b, c = ((ring * math.cos(angle), low, -ring * math.sin(angle)) for angle in feet)
    return ((0.0, 3.0, 0.0), a, b, c)


def parts(corners: Corners) -> list[Corners]:
    """The four half-size tetrahedra at the corners."""
    result: list[Corners] = []
    for keep in corners:
        a, b, c, d = (middle(keep, other) for other in corners)
        result.append((a, b, c, d))
    return result


def write(scene: Scene, corners: Corners) -> None:
    """The four faces, counter-clockwise from outside."""
    top, a, b, c = corners
    for face in ((top, a, b), (top, b, c), (top, c, a), (a, c, b)):
        scene.polygon(face)


def build(size: int, rng: random.Random) -> Scene:
    """4 ** size triangles: size 1 is one tetrahedron, size 6 gives 4096 triangles."""
    scene = Scene()
    scene.camera((0.4, 0.6, 1.0), (2.2, 2.9, 9.0), (0.1, 0.75, 0.0), 36.0)
    scene.light((6.0, 8.0, 9.0), (1.6, 1.5, 1.4))
    scene.light((-9.0, 5.0, 5.0), (1.3, 1.35, 1.5))
    scene.light((1.0, -6.0, 8.0), (0.6, 0.6, 0.7))
    whole = first(0.2 * rng.random())
    groups = [[part] for part in parts(whole)] if size > 1 else [[whole]]
    for color, group in zip(PALETTE, groups, strict=False):
        scene.material(Material(color, kd=0.8, ks=0.2, shine=20.0))
        for _ in range(size - 2):
            group = [part for corners in group for part in parts(corners)]
        for corners in group:
            write(scene, corners)
    return scene
