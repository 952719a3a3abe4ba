"""A fractal mountain by midpoint displacement, a lake at its foot, glass spheres above."""

import math
import random
from collections.abc import Callable

from .nff import Material, Scene
from .vectors import Vec

HALF = 4.0
WATER = 0.0
Heights = list[list[float]]

# Position, radius and height above the ground of each glass sphere.
BALLS = ((-1.9, 2.1, 0.55, 0.25), (0.2, 2.6, 0.4, 0.2), (1.7, 1.2, 0.75, 0.35), (2.6, 2.9, 0.3, 0.2))

# Lowest height of each band of rock, from the foot to the top, and its colour.
BANDS: tuple[tuple[float, Vec], ...] = (
    (-9.0, (0.8, 0.66, 0.36)),
    (0.2, (0.24, 0.46, 0.1)),
    (0.8, (0.42, 0.3, 0.22)),
    (1.75, (0.95, 0.96, 1.0)),
)


def terrain(size: int, rng: random.Random) -> Heights:
    """Heights on a grid of 2 ** size + 1 points a side: diamonds and squares, from coarse to fine."""
    count = 2**size
    heights = [[0.0] * (count + 1) for _ in range(count + 1)]
    step, rough = count, 1.3

    def settle(row: int, column: int, corners: list[tuple[int, int]]) -> None:
        inside = [heights[r][c] for r, c in corners if 0 <= r <= count and 0 <= c <= count]
        heights[row][column] = sum(inside) / len(inside) + rough * (rng.random() - 0.5)

    while step > 1:
        half = step // 2
        for row in range(half, count, step):
            for column in range(half, count, step):
                settle(row, column, [(row + r, column + c) for r in (-half, half) for c in (-half, half)])
        for row in range(0, count + 1, half):
            for column in range(half if row % step == 0 else 0, count + 1, step):
                ends = [(row + sign * half, column) for sign in (-1, 1)]
                sides = [(row, column + sign * half) for sign in (-1, 1)]
                settle(row, column, ends + sides)
        step, rough = half, rough * 0.52
    return heights


def peak(x: float, z: float) -> float:
    """The shape under the noise: a main summit, a smaller one, and a shore that dips below the lake."""
    main = 2.7 * math.exp(-((x + 0.5) ** 2 + (z + 1.3) ** 2) / 2.6)
    side = 1.5 * math.exp(-((x - 2.2) ** 2 + (z + 2.2) ** 2) / 1.6)
    return main + side - 0.18 - 0.09 * max(0.0, z)


def triangles(heights: Heights) -> list[tuple[Vec, Vec, Vec]]:
    """Two triangles for each cell that is not all under water, counter-clockwise from above."""
    count = len(heights) - 1

    def point(row: int, column: int) -> Vec:
        x, z = (HALF * (2.0 * i / count - 1.0) for i in (column, row))
        return (x, peak(x, z) + heights[row][column], z)

    result: list[tuple[Vec, Vec, Vec]] = []
    for row in range(count):
        for column in range(count):
            a, b = point(row, column), point(row, column + 1)
            c, d = point(row + 1, column), point(row + 1, column + 1)
            result += [(a, c, d), (a, d, b)]
    return [face for face in result if max(corner[1] for corner in face) > WATER]


def band_of(face: tuple[Vec, Vec, Vec]) -> int:
    height = sum(corner[1] for corner in face) / 3.0
    return max(index for index, (low, _) in enumerate(BANDS) if height >= low)


def glass(scene: Scene, height_at: Callable[[float, float], float]) -> None:
    scene.material(Material((0.9, 0.95, 1.0), kd=0.05, ks=0.15, shine=90.0, transmittance=0.85, index=1.5))
    for x, z, radius, gap in BALLS:
        scene.sphere((x, max(WATER, height_at(x, z)) + gap + radius, z), radius)


def build(size: int, rng: random.Random) -> Scene:
    """Up to 2 * 4 ** size triangles, a lake and four glass spheres."""
    scene = Scene()
    scene.camera((0.5, 0.8, 1.4), (1.6, 2.6, 8.6), (0.1, 0.75, 0.0), 40.0)
    scene.light((36.0, 34.0, 24.0), (2.2, 2.1, 1.9))
    scene.light((-32.0, 40.0, 20.0), (1.1, 1.15, 1.3))
    scene.light((-8.0, 36.0, 36.0), (0.5, 0.5, 0.55))
    scene.material(Material((0.05, 0.2, 0.32), kd=0.6, ks=0.4, shine=40.0))
    scene.floor(60.0, WATER)
    heights = terrain(size, rng)
    faces = triangles(heights)
    for index, (_, color) in enumerate(BANDS):
        scene.material(Material(color, kd=0.85))
        for face in faces:
            if band_of(face) == index:
                scene.polygon(face)

    def height_at(x: float, z: float) -> float:
        count = len(heights) - 1
        row, column = (round((value / HALF + 1.0) * 0.5 * count) for value in (z, x))
        return peak(x, z) + heights[row][column]

    glass(scene, height_at)
    return scene
