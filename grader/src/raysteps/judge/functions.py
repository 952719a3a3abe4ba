"""What the judge knows of a function: its kinds of cases, and how its answers are compared."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.course.project import here
from raysteps.judge.answers import Answer, MeasuredReference, Verdict
from raysteps.judge.protocol import Inputs, text
from raysteps.judge.random_source import RandomSource

InputGenerator = Callable[[RandomSource], Inputs]


AGAIN = "asked again"  # a kind of cases that every function has, besides its own


@dataclass(frozen=True)
class Group:
    """One kind of cases. `saves`: they ask how much work is spared, which a scene of fewer surfaces would not. `exact`:
    the numbers are, and a little beside them the right answer may be another."""

    name: str
    make: InputGenerator
    saves: bool = False
    exact: bool = False


@dataclass(frozen=True)
class Function:
    """The first group is of ordinary cases, mixed so that neither a stub nor a constant gets through.
    `yes_or_no`: a function that knows nothing is still right in some of them."""

    name: str
    answer: Answer[Any]
    groups: tuple[Group, ...]
    yes_or_no: bool = False

    @cached_property
    def by_name(self) -> Mapping[str, Group]:
        return {group.name: group for group in self.groups}


@dataclass(frozen=True)
class Case:
    """One question to a function."""

    function: str
    group: str
    inputs: Inputs

    @cached_property
    def _words(self) -> str:
        numbers = [text(n) for value in self.inputs.values() for n in value.numbers()]
        return " ".join([self.function, *numbers])

    @cached_property
    def _known(self) -> dict[str, MeasuredReference[Any]]:
        return {}

    def verdict(self, answer: Answer[Any], expected: str, actual: str) -> Verdict:
        """Of a line, beside the reference's, which is measured once: a class is asked the same questions."""
        if expected not in self._known:
            self._known[expected] = answer.measured(self.function, self.inputs, expected)
        return answer.verdict(self.inputs, self._known[expected], actual)

    def line(self, number: int) -> str:
        """As the worker reads it."""
        return f"{number} {self._words}"

    def given(self) -> str:
        return "; ".join(f"{name}: {value.words()}" for name, value in self.inputs.items())


# Functions that were renamed: under the same seed they are asked the same cases as ever, and old files of cases replay.
FORMER_NAMES = {
    "closest_hit_in_octree": "closest_hit_in",
    "occluded_in_octree": "any_hit_in",
    "occluded_in_bvh": "any_hit_in_bvh",
}


def seed_of(step: str, function: str, kind: str, seed: int | str) -> str:
    """Every kind of every function draws from a source of its own."""
    return f"{seed}/{step}/{FORMER_NAMES.get(function, function)}/{kind}"


# The functions of every step, one module for each in cases/; a step of one's own has solutions/NN-name/judge.py.

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
    "10": "sampling",
    "11": "meshes",
    "12": "soft_light",
    "13": "path_tracing",
    "14": "materials",
    "15": "mis",
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
