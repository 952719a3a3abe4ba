"""Ripples: balls in the order of a sunflower's seeds, on the rings that a mirror ball has made in them."""

import math
import random

from .nff import Material, Scene
from .vectors import Vec, scale, unit

GOLDEN_ANGLE = math.pi * (3.0 - math.sqrt(5.0))
SKY = 24.0  # its radius
SPACING = 0.235  # the k-th seed is SPACING * sqrt(k) from the middle
HEART = 52  # seeds that the mirror ball stands in the place of
WAVE, CREST = 2.35, 0.42  # from crest to crest, and how high the first one is
# From the middle to the rim: gold, coral, magenta, violet, blue, teal.
PALETTE: tuple[Vec, ...] = (
    (1.0, 0.72, 0.16),
    (1.0, 0.36, 0.12),
    (0.86, 0.1, 0.26),
    (0.46, 0.1, 0.6),
    (0.1, 0.2, 0.72),
    (0.03, 0.42, 0.5),
)


def blend(colors: tuple[Vec, ...], share: float) -> Vec:
    """0 is the first colour, 1 the last."""
    place = min(max(share, 0.0), 0.9999) * (len(colors) - 1)
    left, right = colors[int(place)], colors[int(place) + 1]
    t = place - int(place)
    return (
        left[0] + t * (right[0] - left[0]),
        left[1] + t * (right[1] - left[1]),
        left[2] + t * (right[2] - left[2]),
    )


def height(radius: float, rim: float) -> float:
    """Of the water, as it were: rings that grow lower towards the rim."""
    calm = 1.0 - radius / rim
    return CREST * (0.25 + 0.75 * calm) * (1.0 - math.cos(2.0 * math.pi * (radius - 1.25) / WAVE))


def seeds(scene: Scene, count: int, rng: random.Random) -> None:
    rim = SPACING * math.sqrt(count)
    for k in range(HEART, count):
        out, angle = SPACING * math.sqrt(k), k * GOLDEN_ANGLE
        share = (k - HEART) / max(count - HEART, 1)
        radius = 0.185 * (0.86 + 0.2 * rng.random())
        if k % 21 == 0:  # one arm in 21 is of pearl
            scene.material(Material((0.9, 0.88, 0.84), kd=0.35, ks=0.5, shine=120.0))
        else:
            scene.material(Material(blend(PALETTE, math.sqrt(share)), kd=0.8, ks=0.16, shine=45.0))
        scene.sphere((out * math.cos(angle), radius + height(out, rim), out * math.sin(angle)), radius)


def crown(scene: Scene, count: int, rng: random.Random) -> None:
    """Drops of glass around the ball, as a splash throws them up."""
    scene.material(Material((0.95, 1.0, 1.0), kd=0.02, ks=0.1, shine=250.0, transmittance=0.9, index=1.5))
    for k in range(count):
        angle = 2.0 * math.pi * (k + 0.3 * rng.random()) / count
        out, up = 2.15 + 0.5 * rng.random(), 1.5 + 1.1 * rng.random()
        scene.sphere((out * math.cos(angle), up, out * math.sin(angle)), 0.12 + 0.22 * rng.random())


def sky(scene: Scene, stars: int, rng: random.Random) -> None:
    """A ball around everything: a bounced ray that misses all would be black. Moon and stars are sunk into it, or they
    would throw shadows on it."""
    scene.material(Material((0.3, 0.42, 0.75), kd=0.05))
    scene.sphere((0.0, 0.0, 0.0), SKY)
    scene.material(Material((1.0, 0.8, 0.56), kd=0.85))
    scene.sphere(scale(unit((-0.47, 0.115, -0.87)), SKY + 2.3), 3.7)
    scene.material(Material((1.0, 0.97, 0.9), kd=1.0))
    for _ in range(stars):
        angle, up = 2.0 * math.pi * rng.random(), 0.03 + 0.9 * rng.random()
        flat = math.sqrt(1.0 - up * up)
        place = (flat * math.cos(angle), up, flat * math.sin(angle))
        scene.sphere(scale(place, SKY), 0.02 + 0.05 * rng.random() ** 3)


def build(size: int, rng: random.Random) -> Scene:
    """`size` * 100 is the number of seeds."""
    scene = Scene()
    scene.camera((0.02, 0.03, 0.07), (2.4, 3.0, 9.9), (-0.95, 1.12, 0.0), 33.0)
    scene.light((-13.0, 11.0, 9.0), (6.4, 5.6, 4.5))
    scene.light((13.0, 7.0, 6.0), (0.35, 0.6, 1.3))
    scene.light((15.0, 5.0, -12.0), (2.4, 1.2, 0.6))
    scene.light((2.0, 6.0, 12.0), (0.3, 0.3, 0.35))
    sky(scene, 420, rng)
    scene.material(Material((0.025, 0.035, 0.07), kd=0.6, ks=0.34, shine=60.0))
    scene.floor(30.0, 0.0)
    seeds(scene, size * 100, rng)
    scene.material(Material((0.95, 0.95, 1.0), kd=0.04, ks=0.86, shine=400.0))
    scene.sphere((0.0, 1.5, 0.0), 1.5)
    crown(scene, 13, rng)
    return scene
