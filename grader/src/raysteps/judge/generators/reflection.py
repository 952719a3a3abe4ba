"""Cases of step 05: reflected rays; what they bring has a module of its own."""

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.axes import next_axis
from raysteps.judge.generators.reflection_traces import TRACE
from raysteps.judge.numbers import add, rounded, times
from raysteps.judge.rays import REFLECTED_RAY
from raysteps.judge.values import Hit, Inputs


def _hit(draw: Draw, low: float = 0.15, high: float = 1.0, reach: float = 3.0) -> Inputs:
    normal = draw.direction()
    return {"hit": Hit(draw.point(reach), normal, rounded(times(-1.0, draw.above(normal, low, high))))}


def _simple_hit(draw: Draw) -> Inputs:
    normal = draw.axis()
    side = next_axis(normal)
    straight = draw.chance(0.4)
    direction = times(-1.0, normal) if straight else rounded(add(times(-0.8, normal), side, 0.6))
    return {"hit": Hit(draw.simple_point(3), normal, direction)}


def _far_hit(draw: Draw) -> Inputs:
    normal = draw.direction()
    position = rounded(add((100.0, -100.0, 100.0), draw.point(3)))
    return {"hit": Hit(position, normal, rounded(times(-1.0, draw.above(normal, 0.3))))}


def _head_on(draw: Draw) -> Inputs:
    normal = draw.axis() if draw.chance(0.3) else draw.direction()
    return {"hit": Hit(draw.point(3), normal, times(-1.0, normal))}


_REFLECTED_RAY = Function(
    "reflected_ray",
    REFLECTED_RAY,
    (
        Group("any hit", _hit),
        Group("simple numbers", _simple_hit),
        Group("at a grazing angle", lambda d: _hit(d, 0.06, 0.15)),
        Group("far from the centre of the world", _far_hit),
        Group("head-on", _head_on),
        Group("almost along the surface", lambda d: _hit(d, 0.02, 0.06)),
    ),
)

FUNCTIONS = (_REFLECTED_RAY, TRACE)
