"""Scenes that no submission has seen: twins of the visible pictures, and made-up ones.

A twin shows the same things from a little farther round, in another size. A program that holds the visible pictures
themselves cannot draw it.
"""

import math
from dataclasses import dataclass

from raysteps.common.documents import read_text
from raysteps.common.errors import GraderFault
from raysteps.common.vectors import Vector, add, cross, dot, length, minus, times, unit
from raysteps.course.manifest import ImageCase, Step, with_option
from raysteps.course.project import Project
from raysteps.judge.plan import Plan, RandomPlan, TwinPlan
from raysteps.judge.random_source import RandomSource

# Changes a scene a little, so that it still shows what it is meant to show. Only lines of a known form are touched:
# `from`, `at` and `up` of the viewpoint, and spheres that stand on one line; of a scene in pbrt's format `LookAt`.

_TURN = (2.0, 4.0)  # degrees about the vertical, one way or the other
_TILT = 1.0  # degrees up or down, at most
_DISTANCE = 0.02  # share by which the camera comes closer or goes back, at most
_JITTER = 0.05  # of a sphere's radius, at most


def _numbers(words: list[str]) -> list[float] | None:
    try:
        return [float(word) for word in words]
    except ValueError:
        return None


def _point(lines: list[str], name: str) -> tuple[int, Vector]:
    """Line number and value of a field of the viewpoint."""
    for i, line in enumerate(lines):
        words = line.split()
        numbers = _numbers(words[1:]) if words and words[0] == name else None
        if numbers is not None and len(numbers) == 3:
            return i, (numbers[0], numbers[1], numbers[2])
    raise GraderFault(f"a scene without a line `{name} x y z` has no twin")


def _turned(v: Vector, axis: Vector, degrees: float) -> Vector:
    """Rodrigues: v turned about the unit axis."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turned = add(times(c, v), cross(axis, v), s)
    return add(turned, axis, dot(axis, v) * (1 - c))


def _text(v: Vector) -> str:
    return " ".join(f"{x:.6g}" for x in v)


def _moved(origin: Vector, at: Vector, up: Vector, draw: RandomSource) -> Vector:
    view = minus(origin, at)
    turned = _turned(view, unit(up), draw.sign() * draw.real(*_TURN))
    side = cross(up, turned)
    if length(side) > 0:
        turned = _turned(turned, unit(side), draw.real(-_TILT, _TILT))
    return add(at, turned, draw.real(1 - _DISTANCE, 1 + _DISTANCE))


def _move_camera(lines: list[str], draw: RandomSource) -> None:
    for i, line in enumerate(lines):
        numbers = _numbers(line.split()[1:]) if line.startswith("LookAt ") else None
        if numbers is not None and len(numbers) == 9:
            x, y, z, *rest = numbers
            moved = _moved((x, y, z), (rest[0], rest[1], rest[2]), (rest[3], rest[4], rest[5]), draw)
            lines[i] = f"LookAt {_text(moved)} " + " ".join(f"{number:.6g}" for number in rest)
            return
    place, origin = _point(lines, "from")
    _, at = _point(lines, "at")
    _, up = _point(lines, "up")
    lines[place] = "from " + _text(_moved(origin, at, up, draw))


def _move_spheres(lines: list[str], draw: RandomSource) -> None:
    for i, line in enumerate(lines):
        words = line.split()
        numbers = _numbers(words[1:]) if words and words[0] == "s" else None
        if numbers is not None and len(numbers) == 4 and numbers[3] > 0:
            center: Vector = (numbers[0], numbers[1], numbers[2])
            moved = add(center, draw.point(1.0), _JITTER * numbers[3])
            lines[i] = f"s {_text(moved)} {numbers[3]:.6g}"


def perturbed_scene(nff: str, draw: RandomSource, *, spheres: bool) -> str:
    """The scene with its camera moved on a small arc and, if wanted, its spheres moved a little."""
    lines = [line for line in nff.splitlines() if not line.lstrip().startswith("#")]
    _move_camera(lines, draw)
    if spheres:
        _move_spheres(lines, draw)
    return "\n".join(lines) + "\n"


# Makes up scenes: spheres and triangles above a ground, two lights.

_HEAD = """b 0.35 0.5 0.8
v
from {from_} 4.5 13
at 0 1.5 0
up 0 1 0
angle 40
hither 0.01
resolution 120 90
l 7 11 8 1.1 1.05 1
l -8 9 5 0.5 0.55 0.6
f 0.6 0.6 0.55 0.8 0 1 0 1
p 4
-40 -0.5 40
40 -0.5 40
40 -0.5 -40
-40 -0.5 -40
"""
_WIDE = 4.5  # half the width of the part of the world that is filled


def _fill(draw: RandomSource) -> str:
    r, g, b = draw.color(0.2, 1.0)
    ks = draw.real(0.1, 0.5) if draw.chance(0.5) else 0.0
    return f"f {r:.4g} {g:.4g} {b:.4g} 0.7 {ks:.4g} {draw.whole(3, 30)} 0 1"


def _place(draw: RandomSource) -> Vector:
    return draw.real(-_WIDE, _WIDE), draw.real(0.2, _WIDE), draw.real(-_WIDE, _WIDE)


def _triangle(draw: RandomSource, place: Vector, size: float) -> list[str]:
    shape = draw.triangle(1.0)
    corners = [add(place, corner, size) for corner in (shape.a, shape.b, shape.c)]
    return ["p 3", *(" ".join(f"{x:.6g}" for x in corner) for corner in corners)]


def random_scene(draw: RandomSource, spheres: int, triangles: int) -> str:
    """The more there is, the smaller it is: about the same part of the picture is filled."""
    size = 2.2 / (spheres + triangles + 1) ** (1 / 3)
    lines = [_HEAD.format(from_=f"{draw.real(-3, 3):.4g}").rstrip("\n")]
    for _ in range(spheres):
        x, y, z = _place(draw)
        lines += [_fill(draw), f"s {x:.6g} {y:.6g} {z:.6g} {size * draw.real(0.4, 1):.6g}"]
    for _ in range(triangles):
        lines += [_fill(draw), *_triangle(draw, _place(draw), 1.6 * size)]
    return "\n".join(lines) + "\n"


_SHARE_SLACK = 1.1  # from another place a ray meets other boxes


@dataclass(frozen=True)
class HiddenScene:
    """A picture to render with the student's code and the reference's: NFF and arguments of raytrace."""

    name: str
    twin_of: str | None
    nff: str
    args: tuple[str, ...]
    max_wrong: float
    max_share: float | None
    weight: float
    max_noise: float | None = None


def _twin(project: Project, step: Step, twin: TwinPlan, image: ImageCase, seed: int) -> HiddenScene:
    draw = RandomSource(f"{seed}/{step.id}/{twin.twin_of}")
    text = read_text(project.root / image.scene)
    nff = perturbed_scene(text, draw, spheres=twin.moves == "camera and spheres")
    args = with_option(image.args, "--size", twin.size)
    share = None if image.max_share is None else min(1.0, _SHARE_SLACK * image.max_share)
    return HiddenScene(f"{image.name}-twin", image.name, nff, args, twin.max_wrong, share, twin.weight, image.max_noise)


def _random(step: Step, scene: RandomPlan, seed: int) -> HiddenScene:
    nff = random_scene(RandomSource(f"{seed}/{step.id}/{scene.name}"), scene.spheres, scene.triangles)
    return HiddenScene(scene.name, None, nff, scene.args, scene.max_wrong, scene.max_share, scene.weight)


def hidden_scenes(project: Project, step: Step, plan: Plan, seed: int) -> list[HiddenScene]:
    """The twins in the order of the visible pictures, then the made-up scenes."""
    images = {image.name: image for image in step.images}
    scenes = [_twin(project, step, twin, images[twin.twin_of], seed) for twin in plan.twins]
    return scenes + [_random(step, scene, seed) for scene in plan.random_scenes]
