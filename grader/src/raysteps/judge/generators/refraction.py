"""Cases of step 08: transmitted rays; refracted directions and what comes through glass have modules of their own."""

from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.refraction_directions import REFRACT
from raysteps.judge.generators.refraction_glass import any_hit, hit_on_glass, index_of_glass, simple_hit
from raysteps.judge.generators.refraction_light import TRANSMITTED_LIGHT
from raysteps.judge.rays import TRANSMITTED_RAY
from raysteps.judge.values import Inputs


def _unbent(draw: Draw, index: float) -> Inputs:
    return {"hit": hit_on_glass(draw, index, outside=draw.chance(0.5))}


_TRANSMITTED_RAY = Function(
    "transmitted_ray",
    TRANSMITTED_RAY,
    (
        Group("any hit on glass", lambda d: {"hit": any_hit(d)}),
        Group("simple numbers", lambda d: {"hit": simple_hit(d)}),
        Group("into glass", lambda d: {"hit": hit_on_glass(d, index_of_glass(d), outside=True)}),
        Group("out of glass", lambda d: {"hit": hit_on_glass(d, index_of_glass(d), outside=False)}),
        Group(
            "total internal reflection",
            lambda d: {"hit": hit_on_glass(d, index_of_glass(d), outside=False, total=True)},
        ),
        Group("index 1", lambda d: _unbent(d, 1.0), telling=False),
        Group("index 0 counts as 1", lambda d: _unbent(d, 0.0), telling=False),
    ),
)

FUNCTIONS = (REFRACT, _TRANSMITTED_RAY, TRANSMITTED_LIGHT)
