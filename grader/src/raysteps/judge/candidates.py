"""Cases that may take the place of a wrong one: what each is made of, and which ones lie near."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import zip_longest

from raysteps.judge.choices import Choice, Chosen, Replay, Unfit
from raysteps.judge.functions import Case, Function
from raysteps.judge.reshaping import Place, places, with_plain_zeros, without
from raysteps.judge.simplicity import complexity, simpler_directions, simpler_reals, simpler_wholes


@dataclass(frozen=True)
class Recipe:
    """What a case is made of. Places count the items of the list as it was made, before some are dropped."""

    values: tuple[Chosen, ...]
    dropped: frozenset[Place] = frozenset()
    plain_zeros: bool = False


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
        case = Case(function.name, group, with_plain_zeros(inputs) if recipe.plain_zeros else inputs)
        case.line(0)
    except (Unfit, ArithmeticError, ValueError, LookupError):
        return None
    used = replace(recipe, values=tuple(choice.value for choice in replay.choices))
    left = tuple(place for place in every if place not in recipe.dropped)
    return Candidate(used, case, tuple(replay.choices), left)


@dataclass(frozen=True)
class Change:
    """Other values at some of the choices, and items to leave out."""

    values: tuple[tuple[int, Chosen], ...] = ()
    dropped: frozenset[Place] = frozenset()
    plain_zeros: bool = False

    def of(self, base: Recipe) -> Recipe:
        values = list(base.values)
        for place, value in self.values:
            if place < len(values):
                values[place] = value
        return Recipe(tuple(values), base.dropped | self.dropped, base.plain_zeros or self.plain_zeros)

    def and_then(self, other: "Change") -> "Change":
        """Both; where they differ, this one."""
        values = {**dict(other.values), **dict(self.values)}
        zeros = self.plain_zeros or other.plain_zeros
        return Change(tuple(sorted(values.items())), self.dropped | other.dropped, zeros)


def _simpler(choice: Choice) -> Sequence[Chosen]:
    value = choice.value
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return simpler_wholes(value, round(choice.low), round(choice.high))
    if isinstance(value, tuple):
        return simpler_directions(value)
    return simpler_reals(value, choice.low, choice.high)


def _drops(left: Sequence[Place]) -> Iterator[Change]:
    """All items, all but one, and pieces of the list, large ones first."""
    yield Change(dropped=frozenset(left))
    size = len(left) // 2
    while size > 0:
        for start in range(0, len(left), size):
            yield Change(dropped=frozenset(left[start : start + size]))
        size //= 2
    if len(left) > 2:
        for one in left:
            yield Change(dropped=frozenset(left) - {one})


def _at_once(simpler: Sequence[Sequence[Chosen]]) -> Iterator[Change]:
    """Everything as simple as can be; then so the first half, the second half, the quarters."""
    parts = 1
    while parts <= 4:
        for part in range(parts):
            piece = range(len(simpler) * part // parts, len(simpler) * (part + 1) // parts)
            yield Change(tuple((place, simpler[place][0]) for place in piece if simpler[place]))
        parts *= 2


def changes(base: Candidate, *, may_drop: bool) -> Iterator[Change]:
    """The most promising first."""
    simpler = [_simpler(choice) for choice in base.choices]
    yield from _at_once(simpler)
    yield Change(plain_zeros=True)
    if may_drop:
        yield from _drops(base.places)
    singles = [[Change(((place, value),)) for value in values] for place, values in enumerate(simpler)]
    for rank in zip_longest(*singles):
        yield from (change for change in rank if change is not None)


def combined(good: Sequence[Change]) -> Iterator[Change]:
    """Changes that did well alone, the best first: as many together as possible, and all but one."""
    together = [Change()]
    for change in good:
        together.append(together[-1].and_then(change))
    yield from reversed(together[1:])
    for left_out in good:
        every = Change()
        for change in good:
            every = every if change is left_out else every.and_then(change)
        yield every
