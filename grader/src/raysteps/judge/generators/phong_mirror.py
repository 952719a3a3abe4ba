"""Cases of step 03: mirrored directions."""

from raysteps.judge.answers import Answer, read_vector, words_of_vector
from raysteps.judge.comparing import vector
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.numbers import Vector, rounded, times
from raysteps.judge.values import Inputs, Vec

_DIRECTION = Answer(read_vector, words_of_vector, lambda _, e, a: vector("the direction", e, a))


def _mirror(direction: Vector, normal: Vector) -> Inputs:
    return {"direction": Vec(direction), "normal": Vec(normal)}


def _simple_mirror(draw: Draw) -> Inputs:
    return _mirror(draw.simple_point(3), draw.axis())


def _along_surface(draw: Draw) -> Inputs:
    normal = draw.axis()
    flat = [0.0 if n else draw.eighths(0.5, 3) * draw.sign() for n in normal]
    return _mirror((flat[0], flat[1], flat[2]), normal)


def _scaled(draw: Draw) -> Inputs:
    return _mirror(rounded(times(draw.real(2, 9), draw.direction())), draw.direction())


def _straight(draw: Draw) -> Inputs:
    """Down onto the surface, or up from it."""
    normal = draw.direction()
    return _mirror(times(draw.sign(), normal), normal)


def _tiny_or_huge(draw: Draw) -> Inputs:
    size = draw.real(0.01, 0.05) if draw.chance(0.5) else draw.real(1e3, 1e5)
    return _mirror(rounded(times(size, draw.direction())), draw.direction())


MIRROR = Function(
    "mirror",
    _DIRECTION,
    (
        Group("any direction", lambda d: _mirror(d.direction(), d.direction())),
        Group("simple numbers", _simple_mirror),
        Group("longer than 1", _scaled),
        Group("along the surface", _along_surface),
        Group("straight down and up", _straight),
        Group("very short and very long", _tiny_or_huge),
    ),
)
