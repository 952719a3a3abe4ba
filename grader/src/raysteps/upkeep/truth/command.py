"""The command `dev check`: stubs, references, mistakes and alternatives are graded, and the grades are judged."""

import os
from collections.abc import Collection, Sequence
from concurrent.futures import ThreadPoolExecutor

from rich.console import Console

from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.kit_building import build_kit
from raysteps.kit.manifest import Step, choose
from raysteps.kit.project import Project
from raysteps.upkeep.truth.grading import grade_round
from raysteps.upkeep.truth.report import (
    LEAST_PAIRS,
    print_notes,
    problems_of,
    row_of,
    shortfalls,
    table_of,
    total,
)
from raysteps.upkeep.truth.rounds import Round, random_pairs, rounds_of
from raysteps.upkeep.truth.verdicts import Seen


def _graded(
    kit: BuiltKit, rounds: Sequence[Round], what: str, seed: int, only: Collection[str], say: Say
) -> list[list[Seen]]:
    """Several rounds at a time, each on one processor: the slowest step of one holds up no other."""

    def grade(numbered: tuple[int, Round]) -> list[Seen]:
        number, handed_in = numbered
        say(f"{what} {number} of {len(rounds)}")
        return grade_round(kit, handed_in, seed=seed, only=only)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(grade, enumerate(rounds, start=1)))


def _pairs(kit: BuiltKit, steps: Sequence[Step], amount: int, seed: int, console: Console, say: Say) -> list[str]:
    """Two mistakes at a time: both must be named."""
    rounds = random_pairs(kit.project, steps, amount, seed)
    graded = _graded(kit, rounds, "pair", seed, {step.id for step in steps}, say)
    both = [seen for seen in graded if all(one.named for one in seen)]
    console.print(f"{len(both)} of {len(graded)} random pairs of mistakes in two steps have both named (seed {seed})")
    for seen in graded:
        for one in seen:
            if not one.named:
                beside = " and ".join(f"{other.entrant.step[:2]} {other.entrant.name}" for other in seen)
                console.print(f"pair {beside}: {one.entrant.name} is called {one.said}", markup=False, highlight=False)
    if len(both) < LEAST_PAIRS * len(graded):
        return [f"both are named in {len(both)} of {len(graded)} pairs, fewer than {LEAST_PAIRS:.0%}"]
    return []


def check_truth(
    project: Project, console: Console, say: Say, *, only: Sequence[str] = (), pairs: int = 0, seed: int = 1
) -> int:
    """Prints the table and what is wrong; 1 when something is."""
    kit = build_kit(project, say)
    chosen = [step.id for step in choose(kit.steps, list(only))]
    rounds = _graded(kit, rounds_of(project, kit.steps), "round", seed, chosen, say)
    rows = [row_of(step, [one for seen in rounds for one in seen if one.entrant.step == step]) for step in chosen]
    every = [one for seen in rounds for one in seen]
    console.print(table_of(rows))
    print_notes(console, every)
    problems = problems_of(rounds) + shortfalls(total(rows))
    if pairs:
        problems += _pairs(kit, [step for step in kit.steps if step.id in chosen], pairs, seed, console, say)
    for problem in problems:
        console.print(f"not true: {problem}", markup=False, highlight=False)
    console.print(f"{len(rounds)} rounds graded with seed {seed}; {len(problems) or 'no'} problems")
    return 1 if problems else 0
