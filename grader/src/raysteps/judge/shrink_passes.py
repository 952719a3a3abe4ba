"""Which cases lie near a given one and may be simpler."""

import dataclasses
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, groupby, zip_longest
from typing import Any

from raysteps.common.vectors import Vector
from raysteps.judge.choice_sequence import (
    Choice,
    ChoiceValue,
    InvalidChoice,
    Replay,
    complexity,
    simpler_directions,
    simpler_reals,
    simpler_wholes,
)
from raysteps.judge.functions import Case, Function
from raysteps.judge.protocol import Inputs, Lights, PixelSamples, Real, Value, f32
from raysteps.judge.scripted_tracer import DirectSamples, Script, ScriptedHit
from raysteps.judge.searches import Rays, RaySegments
from raysteps.judge.surfaces import Surfaces

# Other inputs made from given ones: with shorter lists, or with other numbers in the same places.

ItemIndex = tuple[str, int]  # the name of an input that is a list, and which of its items

_ITEMS = {
    Surfaces: "surfaces",
    Lights: "lights",
    PixelSamples: "samples",
    DirectSamples: "samples",
    Rays: "rays",
    RaySegments: "rays",
    Script: "hits",
}
_NAMES = {(ScriptedHit, "distance")}  # by which a hit is known again
_JITTER = 1e-5  # of a vector's largest component, or of the number
_MAX_NUMBER = 1e38  # beyond it a little more may be infinite


def _items(value: Value) -> tuple[Any, ...]:
    attribute = _ITEMS.get(type(value))
    found: tuple[Any, ...] = getattr(value, attribute) if attribute else ()
    return found


def item_indices(inputs: Inputs) -> list[ItemIndex]:
    """All items of all lists."""
    return [(name, i) for name, value in inputs.items() for i in range(len(_items(value)))]


def _shortened(value: Value, dropped: set[int]) -> Value:
    left = tuple(item for i, item in enumerate(_items(value)) if i not in dropped)
    shorter: Value = dataclasses.replace(value, **{_ITEMS[type(value)]: left})  # type: ignore[type-var]
    return shorter


def without(inputs: Inputs, dropped: frozenset[ItemIndex]) -> Inputs:
    """Without some items of the lists."""
    names = {name for name, _ in dropped}
    return {
        name: _shortened(value, {i for other, i in dropped if other == name}) if name in names else value
        for name, value in inputs.items()
    }


def _with_numbers(value: Any, change: Callable[[float, float], float], size: float = 0.0) -> Any:
    """Every float as `change` makes it from the number and the size of the vector that it belongs to."""
    if isinstance(value, float):
        return change(value, size)
    if isinstance(value, tuple):
        largest = max((abs(x) for x in value if isinstance(x, float)), default=0.0)
        return tuple(_with_numbers(item, change, largest) for item in value)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        names = [part.name for part in dataclasses.fields(value) if (type(value), part.name) not in _NAMES]
        return dataclasses.replace(value, **{name: _with_numbers(getattr(value, name), change) for name in names})
    return value


def with_plain_zeros(inputs: Inputs) -> Inputs:
    """No zero has a sign."""
    return {name: _with_numbers(value, lambda x, _: x + 0.0) for name, value in inputs.items()}


def with_digits(inputs: Inputs, digits: int) -> Inputs:
    """Single numbers rounded; vectors stay, as they may be unit vectors."""
    return {
        name: Real(f32(float(f"{value.value:.{digits}g}"))) if isinstance(value, Real) else value
        for name, value in inputs.items()
    }


def jittered(inputs: Inputs, sign: Callable[[], float]) -> Inputs:
    """Every number a little off; of single numbers, 0 stays 0."""

    def off(number: float, size: float) -> float:
        if not abs(number) < _MAX_NUMBER:
            return number
        return f32(number + sign() * _JITTER * (max(1.0, size) if size else abs(number)))

    return {name: _with_numbers(value, off) for name, value in inputs.items()}


# Cases that may take the place of a wrong one, and what each is made of.


@dataclass(frozen=True)
class Recipe:
    """What a case is made of. Places count the items of the list as it was made, before some are dropped."""

    values: tuple[ChoiceValue, ...]
    dropped: frozenset[ItemIndex] = frozenset()
    plain_zeros: bool = False
    digits: int | None = None  # of single numbers


@dataclass(frozen=True)
class Candidate:
    recipe: Recipe  # only what was really used
    case: Case
    choices: tuple[Choice, ...]
    places: tuple[ItemIndex, ...]  # of items that are left

    @cached_property
    def complexity(self) -> tuple[int, float]:
        return complexity(self.case.inputs)


def make(function: Function, group: str, recipe: Recipe) -> Candidate | None:
    """The case of a recipe, or nothing where the generator cannot make one of it."""
    replay = Replay(recipe.values)
    try:
        inputs = function.by_name[group].make(replay)
        every = item_indices(inputs)
        inputs = without(inputs, recipe.dropped)
        inputs = inputs if recipe.digits is None else with_digits(inputs, recipe.digits)
        case = Case(function.name, group, with_plain_zeros(inputs) if recipe.plain_zeros else inputs)
        if any(isinstance(value, Rays) and not value.rays for value in inputs.values()):
            return None  # the answer would have no words
        case.line(0)
    except (InvalidChoice, ArithmeticError, ValueError, LookupError):
        return None
    used = replace(recipe, values=tuple(choice.value for choice in replay.choices))
    left = tuple(place for place in every if place not in recipe.dropped)
    return Candidate(used, case, tuple(replay.choices), left)


_CORNERS: tuple[Vector, ...] = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 1.0, 1.0))

_COSINES = (1.0, 0.8, 0.6, 0.28, 0.96, -0.6, -0.8)  # of right triangles with short sides


@dataclass(frozen=True)
class Change:
    """Other values at some of the choices, and items to leave out."""

    values: tuple[tuple[int, ChoiceValue], ...] = ()
    dropped: frozenset[ItemIndex] = frozenset()
    plain_zeros: bool = False
    digits: int | None = None

    def of(self, base: Recipe) -> Recipe:
        values = list(base.values)
        for place, value in self.values:
            if place < len(values):
                values[place] = value
        digits = base.digits if self.digits is None else self.digits
        return Recipe(tuple(values), base.dropped | self.dropped, base.plain_zeros or self.plain_zeros, digits)

    def and_then(self, other: "Change") -> "Change":
        """Both; where they differ, this one."""
        values = {**dict(other.values), **dict(self.values)}
        zeros = self.plain_zeros or other.plain_zeros
        digits = other.digits if self.digits is None else self.digits
        return Change(tuple(sorted(values.items())), self.dropped | other.dropped, zeros, digits)


def _simpler(choice: Choice) -> Sequence[ChoiceValue]:
    value = choice.value
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return simpler_wholes(value, round(choice.low), round(choice.high))
    if isinstance(value, tuple):
        return simpler_directions(value)
    return simpler_reals(value, choice.low, choice.high)


def _drops(left: Sequence[ItemIndex]) -> Iterator[Change]:
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


def _at_once(simpler: Sequence[Sequence[ChoiceValue]]) -> Iterator[Change]:
    """Everything as simple as can be; then so the first half, the second half, the quarters."""
    parts = 1
    while parts <= 4:
        for part in range(parts):
            piece = range(len(simpler) * part // parts, len(simpler) * (part + 1) // parts)
            yield Change(tuple((place, simpler[place][0]) for place in piece if simpler[place]))
        parts *= 2


def _points(choices: Sequence[Choice]) -> Iterator[Change]:
    """Three neighbours with the same bounds are taken for a point, and several points for the corners of something."""
    start = 0
    for _, run in groupby(choices, key=lambda choice: (type(choice.value), choice.low, choice.high)):
        size = len(list(run))
        if type(choices[start].value) is float and size % 3 == 0:
            ends = range(start, start + size, 3)
            for turn in range(3):
                corners = [(place, _CORNERS[(i + turn) % 3]) for i, place in enumerate(ends)]
                yield Change(tuple((place + axis, point[axis]) for place, point in corners for axis in range(3)))
            for place in ends:
                yield from (Change(tuple((place + i, x) for i, x in enumerate(point))) for point in _CORNERS)
        start += size


def _angles(choices: Sequence[Choice]) -> Iterator[Change]:
    """What a direction above a surface is made of, together: one of them alone leaves the others' digits."""
    for place, (side, cosine, turn) in enumerate(zip(choices, choices[1:], choices[2:], strict=False)):
        kinds = [type(choice.value) for choice in (side, cosine, turn)]
        if kinds == [tuple, float, float] and (turn.low, turn.high) == (0, 1):
            for simple in (x for x in _COSINES if cosine.low <= x <= cosine.high):
                yield from (Change(((place, axis), (place + 1, simple), (place + 2, 0.0))) for axis in _CORNERS[1:4])


def changes(base: Candidate, live: Collection[int], *, may_drop: bool) -> Iterator[Change]:
    """The most promising first. `live` are the choices that matter."""
    simpler = [_simpler(choice) if place in live else [] for place, choice in enumerate(base.choices)]
    yield from _at_once(simpler)
    yield Change(plain_zeros=True)
    yield from (Change(digits=digits) for digits in (1, 2, 3))
    if may_drop:
        yield from _drops(base.places)
    together = chain(_points(base.choices), _angles(base.choices))
    yield from (change for change in together if any(place in live for place, _ in change.values))
    singles = [[Change(((place, value),)) for value in values] for place, values in enumerate(simpler)]
    for rank in zip_longest(*singles):
        yield from (change for change in rank if change is not None)


def live_choices(function: Function, base: Candidate, first: int = 0, end: int | None = None) -> list[int]:
    """Those on which the case depends. An item that was dropped left choices behind that change nothing any more."""
    end = len(base.choices) if end is None else end
    if not base.recipe.dropped:
        return list(range(first, end))
    values = [(place, next(iter(_simpler(base.choices[place])), None)) for place in range(first, end)]
    change = Change(tuple((place, value) for place, value in values if value is not None))
    other = make(function, base.case.group, change.of(base.recipe))
    if other is not None and other.case.line(0) == base.case.line(0):
        return []
    if end - first <= 1:
        return list(range(first, end))
    middle = (first + end) // 2
    return live_choices(function, base, first, middle) + live_choices(function, base, middle, end)


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
