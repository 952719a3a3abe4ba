"""Which files are handed in together. A mistake must cost its own step and no other, so every mistake is graded between
correct neighbours, and several mistakes at once."""

import random
from collections.abc import Iterator, Sequence

from raysteps.kit.manifest import Step
from raysteps.kit.project import Project
from raysteps.upkeep.truth.entrants import Entrant, alternatives, mutants, reference, stub

Round = tuple[Entrant, ...]  # one for each step, in order
_RIGHT_EVERY = 4  # a step is wrong in so many rounds less one, then right


def _turns(wrong: Sequence[Entrant], right: Sequence[Entrant], at: int) -> Iterator[tuple[Entrant, bool]]:
    """What step number `at` hands in, round after round, and whether all its files have had their turn."""
    mistakes, others, turn = list(wrong), list(right), at
    while True:
        is_right = turn % _RIGHT_EVERY == 0 or not mistakes
        entrant = (others.pop(0) if others else right[turn % len(right)]) if is_right else mistakes.pop(0)
        turn += 1
        yield entrant, not mistakes and not others


def rounds_of(project: Project, steps: Sequence[Step]) -> list[Round]:
    """The stubs, the references, then wrong and right files side by side until every mistake and every alternative had
    its turn."""
    first = tuple(stub(project, step) for step in steps)
    second = tuple(reference(project, step) for step in steps)
    columns = []
    for at, (step, right) in enumerate(zip(steps, second, strict=True)):
        columns.append(_turns(mutants(project, step), alternatives(project, step) or [right], at))
    rounds = [first, second]
    for turns in zip(*columns, strict=True):
        rounds.append(tuple(entrant for entrant, _ in turns))
        if all(done for _, done in turns):
            break
    return rounds


def random_pairs(project: Project, steps: Sequence[Step], amount: int, seed: int) -> list[Round]:
    """Two mistakes in two different steps, and the reference everywhere else."""
    draw = random.Random(seed)  # noqa: S311 - a choice, not a secret
    every = [entrant for step in steps for entrant in mutants(project, step)]
    pairs = [(a, b) for at, a in enumerate(every) for b in every[at + 1 :] if a.step != b.step]
    found = []
    for pair in draw.sample(pairs, min(amount, len(pairs))):
        wrong = {entrant.step: entrant for entrant in pair}
        found.append(tuple(wrong.get(step.id) or reference(project, step) for step in steps))
    return found
