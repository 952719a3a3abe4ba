"""Reads of an NFF scene what the judge needs to send rays through it: camera, lights, spheres and polygons."""

from dataclasses import dataclass
from itertools import pairwise

from raysteps.judge.numbers import Vector, f32, rounded
from raysteps.judge.surfaces import Sphere, Surface, Triangle

_SKIPPED = {"b", "v", "hither", "resolution", "f"}


@dataclass(frozen=True)
class SceneText:
    """Polygons are cut into fans of triangles."""

    origin: Vector
    at: Vector
    up: Vector
    angle: float  # degrees, from the lower edge of the picture to the upper one
    lights: tuple[Vector, ...]
    surfaces: tuple[Surface, ...]


def _vector(words: list[str]) -> Vector:
    return rounded((float(words[0]), float(words[1]), float(words[2])))


def _fan(corners: list[Vector]) -> list[Triangle]:
    return [Triangle(corners[0], b, c) for b, c in pairwise(corners[1:])]


def _read(lines: list[list[str]]) -> SceneText | None:
    view: dict[str, Vector] = {}
    angle = 0.0
    lights: list[Vector] = []
    surfaces: list[Surface] = []
    rest = iter(lines)
    for word, *numbers in rest:
        if word in ("from", "at", "up"):
            view[word] = _vector(numbers)
        elif word == "angle":
            angle = float(numbers[0])
        elif word == "l":
            lights.append(_vector(numbers))
        elif word == "s" and float(numbers[3]) > 0:
            surfaces.append(Sphere(_vector(numbers), f32(float(numbers[3]))))
        elif word == "p":
            surfaces += _fan([_vector(next(rest)) for _ in range(int(numbers[0]))])
        elif word not in _SKIPPED:
            return None
    return SceneText(view["from"], view["at"], view["up"], angle, tuple(lights), tuple(surfaces))


def read_scene(nff: str) -> SceneText | None:
    """None where the scene holds something else, such as cones, or is written in another way than line by line."""
    lines = [line.split("#")[0].split() for line in nff.splitlines()]
    try:
        return _read([words for words in lines if words])
    except (ValueError, IndexError, KeyError, StopIteration):
        return None
