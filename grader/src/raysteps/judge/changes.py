"""Which cases lie near a given one and may be simpler."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, groupby, zip_longest

from raysteps.judge.candidates import Candidate, Recipe, make
from raysteps.judge.choices import Choice, Chosen
from raysteps.judge.functions import Function
from raysteps.judge.numbers import Vector
from raysteps.judge.reshaping import Place
from raysteps.judge.simplicity import simpler_directions, simpler_reals, simpler_wholes

_CORNERS: tuple[Vector, ...] = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 1.0, 1.0))

_COSINES = (1.0, 0.8, 0.6, 0.28, 0.96, -0.6, -0.8)  # of right triangles with short sides


@dataclass(frozen=True)
class Change:
    """Other values at some of the choices, and items to leave out."""

    values: tuple[tuple[int, Chosen], ...] = ()
    dropped: frozenset[Place] = frozenset()
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
