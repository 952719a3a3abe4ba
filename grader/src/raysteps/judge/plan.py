"""What the judge asks of a step: solutions/NN-name/cases.toml."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal

from raysteps.common.errors import GraderFault
from raysteps.common.schemas import parse_table, read_text
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.judge.functions import functions_of

Moves = Literal["camera", "camera and spheres"]


@dataclass(frozen=True)
class FunctionPlan:
    """How many cases of each kind a function gets; of each, that share may miss by rounding."""

    name: str
    weight: float
    may_miss: float
    cases: Mapping[str, int]


@dataclass(frozen=True)
class TwinPlan:
    """A visible picture once more, a little changed."""

    twin_of: str
    moves: Moves
    size: str
    max_wrong: float
    weight: float


@dataclass(frozen=True)
class RandomPlan:
    """A scene that is made up: spheres and triangles above a ground."""

    name: str
    spheres: int
    triangles: int
    args: tuple[str, ...]
    max_wrong: float
    max_share: float | None
    weight: float


@dataclass(frozen=True)
class Plan:
    """The hidden part of one step."""

    functions: tuple[FunctionPlan, ...]
    twins: tuple[TwinPlan, ...]
    random_scenes: tuple[RandomPlan, ...]


def _function(name: str, table: dict[str, Any]) -> FunctionPlan:
    return FunctionPlan(name, float(table["weight"]), float(table.get("may_miss", 0.01)), table["cases"])


def _twin(table: dict[str, Any]) -> TwinPlan:
    moves: Moves = table["moves"]
    return TwinPlan(table["of"], moves, table["size"], float(table["max_wrong"]), float(table["weight"]))


def _random(table: dict[str, Any]) -> RandomPlan:
    share = table.get("max_share")
    return RandomPlan(
        table["name"],
        table["spheres"],
        table["triangles"],
        tuple(table["args"]),
        float(table["max_wrong"]),
        None if share is None else float(share),
        float(table["weight"]),
    )


def _check_names(plan: Plan, step: Step) -> None:
    """Every function of the step with every kind of its cases, and a twin for every picture."""
    known = functions_of(step.number)
    if not known and not plan.functions:
        pass  # a step of one's own, without a judge.py: the judge looks at pictures only
    elif [function.name for function in plan.functions] != list(step.functions) or set(known) != set(step.functions):
        raise GraderFault(f"{step.id}: cases.toml must list the functions of step.toml, in its order")
    for function in plan.functions:
        if list(function.cases) != [group.name for group in known[function.name].groups]:
            kinds = ", ".join(group.name for group in known[function.name].groups)
            raise GraderFault(f"{step.id}: cases.toml must list for {function.name}, in this order: {kinds}")
    if [twin.twin_of for twin in plan.twins] != [image.name for image in step.images]:
        raise GraderFault(f"{step.id}: cases.toml must list a twin for each picture of step.toml, in its order")


@lru_cache(maxsize=64)
def _parse(text: str, step: Step, path: Path) -> Plan:
    table = parse_table(text, path, "a plan of hidden cases", "raysteps.judge", "cases.schema.json")
    plan = Plan(
        tuple(_function(name, function) for name, function in table.get("functions", {}).items()),
        tuple(_twin(twin) for twin in table.get("twins", [])),
        tuple(_random(scene) for scene in table.get("random_scenes", [])),
    )
    _check_names(plan, step)
    return plan


def read_plan(project: Project, step: Step) -> Plan | None:
    """None in a student's kit, which has no solutions; a bad file is the kit's fault."""
    path = project.solutions / step.id / "cases.toml"
    if not path.is_file():
        return None
    return _parse(read_text(path), step, path)
