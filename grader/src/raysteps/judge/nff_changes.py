"""Changes an NFF scene a little, so that it still shows what it is meant to show.

Only lines of a known form are touched: `from`, `at` and `up` of the viewpoint, and spheres that stand on one line.
"""

import math

from raysteps.common.errors import GraderFault
from raysteps.judge.drawing import Draw
from raysteps.judge.numbers import Vector, add, cross, dot, length, minus, times, unit

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


def _move_camera(lines: list[str], draw: Draw) -> None:
    place, origin = _point(lines, "from")
    _, at = _point(lines, "at")
    _, up = _point(lines, "up")
    view = minus(origin, at)
    turned = _turned(view, unit(up), draw.sign() * draw.real(*_TURN))
    side = cross(up, turned)
    if length(side) > 0:
        turned = _turned(turned, unit(side), draw.real(-_TILT, _TILT))
    lines[place] = "from " + _text(add(at, turned, draw.real(1 - _DISTANCE, 1 + _DISTANCE)))


def _move_spheres(lines: list[str], draw: Draw) -> None:
    for i, line in enumerate(lines):
        words = line.split()
        numbers = _numbers(words[1:]) if words and words[0] == "s" else None
        if numbers is not None and len(numbers) == 4 and numbers[3] > 0:
            center: Vector = (numbers[0], numbers[1], numbers[2])
            moved = add(center, draw.point(1.0), _JITTER * numbers[3])
            lines[i] = f"s {_text(moved)} {numbers[3]:.6g}"


def changed(nff: str, draw: Draw, *, spheres: bool) -> str:
    """The scene with its camera moved on a small arc and, if wanted, its spheres moved a little."""
    lines = [line for line in nff.splitlines() if not line.lstrip().startswith("#")]
    _move_camera(lines, draw)
    if spheres:
        _move_spheres(lines, draw)
    return "\n".join(lines) + "\n"
