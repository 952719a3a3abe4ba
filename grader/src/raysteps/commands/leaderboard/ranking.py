"""Ranks submissions by the work of one step."""

from collections.abc import Sequence
from dataclasses import dataclass

from raysteps.commands.leaderboard.entries import Entered
from raysteps.kit.manifest import Step
from raysteps.results.effort import Effort, NoEffort, effort_of


@dataclass(frozen=True)
class Ranked:
    """A submission in its place; who is alike in work and memory shares it."""

    rank: int
    name: str
    effort: Effort


@dataclass(frozen=True)
class NotRanked:
    """A submission without a place."""

    name: str
    reason: str


@dataclass(frozen=True)
class Board:
    """One step."""

    step: Step
    ranked: Sequence[Ranked]
    not_ranked: Sequence[NotRanked]
    kits: Sequence[str]  # that graded those in a place

    @property
    def reference_bytes(self) -> int | None:
        """None where results of several kits do not agree, or nobody is ranked."""
        known = {one.effort.reference_bytes for one in self.ranked}
        return known.pop() if len(known) == 1 else None


def _effort(entered: Entered, step: Step) -> Effort | NoEffort:
    if entered.document is None:
        return NoEffort(entered.why)
    result = next((result for result in entered.document["steps"] if result["id"] == step.id), None)
    return NoEffort("the step was not graded") if result is None else effort_of(result, step.limited_pictures)


def _standing(effort: Effort) -> tuple[float, int]:
    return effort.relative, effort.bytes


def _in_place(efforts: Sequence[tuple[str, Effort]]) -> list[Ranked]:
    """Names come last: among equals their order must tell nothing, should they be hidden."""
    ordered = sorted(efforts, key=lambda one: (*_standing(one[1]), *one[1].pictures.values(), one[0]))
    places = [_standing(effort) for _, effort in ordered]
    return [Ranked(places.index(_standing(effort)) + 1, name, effort) for name, effort in ordered]


def rank(entered: Sequence[Entered], step: Step) -> Board:
    """Least work first, then least memory. The same results give the same board, in whatever order they come."""
    efforts: list[tuple[str, Effort]] = []
    others: list[NotRanked] = []
    kits: set[str] = set()
    for one in entered:
        effort = _effort(one, step)
        if isinstance(effort, NoEffort):
            others.append(NotRanked(one.name, effort.reason))
            continue
        efforts.append((one.name, effort))
        kits |= {one.document["kit"]} if one.document is not None else set()
    others.sort(key=lambda other: (other.reason, other.name))
    return Board(step, _in_place(efforts), others, sorted(kits))
