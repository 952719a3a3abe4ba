"""The kinds of cases of every step, one module each; a step of one's own has solutions/NN-name/judge.py."""

from functools import cache
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

from raysteps.common.errors import GraderFault
from raysteps.course.project import here
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


def _own_module(path: Path) -> ModuleType:
    spec = spec_from_file_location(f"raysteps_judge_{path.parent.name[:2]}", path)
    if spec is None or spec.loader is None:
        raise GraderFault(f"{path}: cannot be read as Python")
    module = module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        raise GraderFault(f"{path}: does not run: {type(error).__name__}: {error}") from error
    if not isinstance(getattr(module, "FUNCTIONS", None), tuple):
        raise GraderFault(f"{path}: expected FUNCTIONS, a tuple of what the judge can ask")
    return module


@cache
def functions_of(number: str) -> dict[str, Function]:
    """The functions of a step that the judge can ask, by name; none for a step of one's own without a judge.py."""
    if number in _MODULES:
        module = import_module(f"raysteps.judge.cases.{_MODULES[number]}")
    else:
        path = next(iter(sorted(here().solutions.glob(f"{number}-*/judge.py"))), None)
        if path is None:
            return {}
        module = _own_module(path)
    functions: tuple[Function, ...] = module.FUNCTIONS
    return {function.name: function for function in functions}
