"""Cases that may take the place of a wrong one, and what each is made of."""

from dataclasses import dataclass, replace
from functools import cached_property

from raysteps.judge.choices import Choice, Chosen, Replay, Unfit
from raysteps.judge.functions import Case, Function
from raysteps.judge.reshaping import Place, places, with_digits, with_plain_zeros, without
from raysteps.judge.searches import Rays
from raysteps.judge.simplicity import complexity


@dataclass(frozen=True)
class Recipe:
    """What a case is made of. Places count the items of the list as it was made, before some are dropped."""

    values: tuple[Chosen, ...]
    dropped: frozenset[Place] = frozenset()
    plain_zeros: bool = False
    digits: int | None = None  # of single numbers


@dataclass(frozen=True)
class Candidate:
    recipe: Recipe  # only what was really used
    case: Case
    choices: tuple[Choice, ...]
    places: tuple[Place, ...]  # of items that are left

    @cached_property
    def complexity(self) -> tuple[int, float]:
        return complexity(self.case.inputs)


def make(function: Function, group: str, recipe: Recipe) -> Candidate | None:
    """The case of a recipe, or nothing where the generator cannot make one of it."""
    replay = Replay(recipe.values)
    try:
        inputs = function.by_name[group].make(replay)
        every = places(inputs)
        inputs = without(inputs, recipe.dropped)
        inputs = inputs if recipe.digits is None else with_digits(inputs, recipe.digits)
        case = Case(function.name, group, with_plain_zeros(inputs) if recipe.plain_zeros else inputs)
        if any(isinstance(value, Rays) and not value.rays for value in inputs.values()):
            return None  # the answer would have no words
        case.line(0)
    except (Unfit, ArithmeticError, ValueError, LookupError):
        return None
    used = replace(recipe, values=tuple(choice.value for choice in replay.choices))
    left = tuple(place for place in every if place not in recipe.dropped)
    return Candidate(used, case, tuple(replay.choices), left)
