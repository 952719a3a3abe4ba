"""Which files are handed in together. A mistake must cost its own step and no other, so every mistake is graded between
correct neighbours, and several mistakes at once."""

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from raysteps.kit.manifest import Step
from raysteps.kit.project import Project
from raysteps.upkeep.entrants import Entrant, alternatives, mutants, reference, stub

_RIGHT_EVERY = 4  # a step is wrong in so many rounds less one, then right


@dataclass(frozen=True)
class Round:
    """One file for each step, in order, and the steps that are graded."""

    entrants: tuple[Entrant, ...]
    graded: tuple[str, ...]


def _turns(wrong: Sequence[Entrant], right: Sequence[Entrant], at: int) -> Iterator[Entrant | None]:
    """What step number `at` hands in, round after round; none when all its files have had their turn."""
    mistakes, others, turn = list(wrong), list(right), at
    while mistakes or others:
        is_right = turn % _RIGHT_EVERY == 0 or not mistakes
        yield (others.pop(0) if others else right[turn % len(right)]) if is_right else mistakes.pop(0)
        turn += 1
    while True:
        yield None


def _with_neighbours(steps: Sequence[Step], fresh: Sequence[bool]) -> tuple[str, ...]:
    """The steps with something new, and those beside them, which must stay right."""
    near = [fresh[max(0, at - 1) : at + 2] for at in range(len(steps))]
    return tuple(step.id for step, around in zip(steps, near, strict=True) if any(around))


def rounds_of(project: Project, steps: Sequence[Step]) -> list[Round]:
    """The stubs, the references, then wrong and right files side by side until every mistake and every alternative had
    its turn."""
    every = tuple(step.id for step in steps)
    right = tuple(reference(project, step) for step in steps)
    rounds = [Round(tuple(stub(project, step) for step in steps), every), Round(right, every)]
    columns = [
        _turns(mutants(project, step), alternatives(project, step) or [own], at)
        for at, (step, own) in enumerate(zip(steps, right, strict=True))
    ]
    for turn in zip(*columns, strict=True):
        if not any(turn):
            return rounds
        entrants = tuple(entrant or own for entrant, own in zip(turn, right, strict=True))
        rounds.append(Round(entrants, _with_neighbours(steps, [entrant is not None for entrant in turn])))
    raise AssertionError("the turns have no end")


def random_pairs(project: Project, steps: Sequence[Step], amount: int, seed: int) -> list[Round]:
    """Two mistakes in two different steps, and the reference everywhere else."""
    draw = random.Random(seed)  # noqa: S311 - a choice, not a secret
    every = [entrant for step in steps for entrant in mutants(project, step)]
    pairs = [(a, b) for at, a in enumerate(every) for b in every[at + 1 :] if a.step != b.step]
    found = []
    for pair in draw.sample(pairs, min(amount, len(pairs))):
        wrong = {entrant.step: entrant for entrant in pair}
        entrants = tuple(wrong.get(step.id) or reference(project, step) for step in steps)
        found.append(Round(entrants, tuple(wrong)))
    return found
