"""What the judge knows of a function: its kinds of cases, and how its answers are compared."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from raysteps.judge.answers import Answer
from raysteps.judge.numbers import text
from raysteps.judge.protocol import Inputs
from raysteps.judge.random_source import RandomSource

Make = Callable[[RandomSource], Inputs]


@dataclass(frozen=True)
class Group:
    """One kind of cases. `telling`: a stub, or a function that always answers the same, gets none of them right.
    `saves`: who is wasteful in all of them spares the rays nothing. `exact`: the numbers are, and a little beside
    them the right answer may be another."""

    name: str
    make: Make
    telling: bool = True
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
