"""What the judge asks of a step: solutions/NN-name/cases.toml."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Literal

from msgspec import Meta

from raysteps.common.documents import Text, parse_table, place_in_toml, read_text
from raysteps.common.errors import GraderFault
from raysteps.common.text import did_you_mean
from raysteps.course.manifest import Step, refuse_absent_scenes
from raysteps.course.project import Project
from raysteps.judge.functions import AGAIN, functions_of

Moves = Literal["camera", "camera and spheres"]
_Weight = Annotated[float, Meta(gt=0)]
_Wrong = Annotated[float, Meta(ge=0, le=1)]  # share of the pixels


@dataclass(frozen=True)
class FunctionPlan:
    """How many cases of each kind a function gets, and what each kind is worth beside the others."""

    name: str
    weight: float  # among the hidden items
    cases: Mapping[str, int]
    kind_weights: Mapping[str, float]


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

    name: Text
    spheres: Annotated[int, Meta(ge=0, le=2000)]
    triangles: Annotated[int, Meta(ge=0, le=2000)]
    args: tuple[str, ...]
    max_wrong: _Wrong
    weight: _Weight
    max_share: Annotated[float, Meta(gt=0, le=1)] | None = None


@dataclass(frozen=True)
class Plan:
    """The hidden part of one step."""

    functions: tuple[FunctionPlan, ...]
    twins: tuple[TwinPlan, ...]
    random_scenes: tuple[RandomPlan, ...]


_Cases = Annotated[int, Meta(ge=1, le=1000)]


@dataclass(frozen=True)
class _KindTable:
    """A kind of cases that counts more than another, or less."""

    cases: _Cases
    weight: _Weight


@dataclass(frozen=True)
class _FunctionTable:
    """A function in cases.toml: how many cases of each kind."""

    cases: Annotated[dict[str, _Cases | _KindTable], Meta(min_length=1)]


@dataclass(frozen=True)
class _TwinTable:
    """A picture of step.toml once more, in cases.toml."""

    of: Text
    moves: Moves
    size: Annotated[str, Meta(pattern="^[1-9][0-9]{0,3}x[1-9][0-9]{0,3}$")]
    weight: _Weight
    max_wrong: _Wrong = 0.0  # of a noisy picture none is needed


@dataclass(frozen=True)
class _PlanTable:
    """cases.toml."""

    functions: Annotated[dict[str, _FunctionTable], Meta(min_length=1)] | None = None
    twins: tuple[_TwinTable, ...] = ()
    random_scenes: tuple[RandomPlan, ...] = ()


_EXPECTED = {
    "of": "the name of a picture of step.toml",
    "moves": '"camera" or "camera and spheres"',
    "size": 'a size in pixels, such as "151x113"',
    "weight": "a number above 0",
    "max_wrong": "the share of pixels that may be wrong, from 0 to 1",
    "max_share": "the share of objects that a ray may be tested with, up to 1",
    "args": 'a list of words, such as ["--step", "2", "--size", "120x90"]',
    "spheres": "a whole number from 0 to 2000",
    "triangles": "a whole number from 0 to 2000",
}


def _wrong_kinds(function: FunctionPlan, kinds: Sequence[str]) -> tuple[str, str]:
    """The kind that is wrong, and how; nothing where all are as the judge knows them."""
    found = [kind for kind in function.cases if kind != AGAIN]
    for kind in found:
        if kind not in kinds:
            return kind, f"'{kind}' is no kind of cases of {function.name}{did_you_mean(kind, kinds) or '.'}"
    for kind in kinds:
        if kind not in found:
            return "", f"'{kind}' is missing, a kind of cases of {function.name}."
    return "", "" if found == list(kinds) else "the kinds of cases stand in another order."


def _check_names(plan: Plan, step: Step, text: str, path: Path) -> None:
    """Every function of the step with every kind of its cases, and a twin for every picture."""
    known = functions_of(step.number)
    if not known and not plan.functions:
        pass  # a step of one's own, without a judge.py: the judge looks at pictures only
    elif [function.name for function in plan.functions] != list(step.functions) or set(known) != set(step.functions):
        raise GraderFault(
            f"{path}:{place_in_toml(text, ['functions'])}: must list the functions of step.toml, in its order: "
            f"{', '.join(step.functions)}; found {', '.join(it.name for it in plan.functions) or 'none'}"
        )
    for function in plan.functions:
        kinds = [group.name for group in known[function.name].groups]
        kind, wrong = _wrong_kinds(function, kinds)
        if wrong:
            place = place_in_toml(text, ["functions", function.name, "cases", kind])
            raise GraderFault(f"{path}:{place}: {wrong} Expected, in this order: {', '.join(kinds)}")
    twins, pictures = [twin.twin_of for twin in plan.twins], [image.name for image in step.images]
    if twins != pictures:
        raise GraderFault(
            f"{path}:{place_in_toml(text, ['twins', '0'])}: must list a twin for each picture of step.toml, in its "
            f"order: {', '.join(pictures)}; found {', '.join(twins) or 'none'}"
        )


_ASKED_AGAIN = 24  # cases, of every function
_FUNCTIONS = 5.0  # what all functions are worth beside all scenes


def _function_plan(step: Step, name: str, table: _FunctionTable) -> FunctionPlan:
    cases = {**table.cases, AGAIN: _ASKED_AGAIN}
    kinds = {kind: it if isinstance(it, _KindTable) else _KindTable(it, 1.0) for kind, it in cases.items()}
    return FunctionPlan(
        name,
        _FUNCTIONS * step.share_of(name),
        {kind: it.cases for kind, it in kinds.items()},
        {kind: it.weight for kind, it in kinds.items()},
    )


@lru_cache(maxsize=64)
def _parse(text: str, step: Step, path: Path) -> Plan:
    table = parse_table(text, path, "a plan of hidden cases", _PlanTable, _EXPECTED)
    scenes = sum(scene.weight for scene in table.twins) + sum(scene.weight for scene in table.random_scenes)
    plan = Plan(
        tuple(_function_plan(step, name, it) for name, it in (table.functions or {}).items()),
        tuple(TwinPlan(twin.of, twin.moves, twin.size, twin.max_wrong, twin.weight / scenes) for twin in table.twins),
        tuple(replace(scene, weight=scene.weight / scenes) for scene in table.random_scenes),
    )
    _check_names(plan, step, text, path)
    return plan


def read_plan(project: Project, step: Step) -> Plan | None:
    """None in a student's kit, which has no solutions; a bad file is the kit's fault."""
    path = project.solutions / step.id / "cases.toml"
    if not path.is_file():
        if path.parent.is_dir():
            refuse_absent_scenes(step, project)
        return None
    plan = _parse(read_text(path), step, path)
    refuse_absent_scenes(step, project)
    return plan
