"""The kinds of cases of every step, one module each."""

from functools import cache
from importlib import import_module

from raysteps.common.errors import GraderFault
from raysteps.judge.functions import Function

_MODULES = {
    "01": "camera_rays",
    "02": "intersection",
    "03": "phong_shading",
    "04": "shadows",
    "05": "reflection",
    "06": "octree",
    "07": "tone_mapping",
    "08": "refraction",
    "09": "bvh",
}


@cache
def functions_of(number: str) -> dict[str, Function]:
    """The functions of a step that the judge can ask, by name."""
    if number not in _MODULES:
        raise GraderFault(f"the judge has no generator for step {number}")
    module = import_module(f"raysteps.judge.generators.{_MODULES[number]}")
    functions: tuple[Function, ...] = module.FUNCTIONS
    return {function.name: function for function in functions}
