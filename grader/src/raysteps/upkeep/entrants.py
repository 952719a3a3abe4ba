"""What may be handed in for a step, and what a true grade gives it."""

from dataclasses import dataclass
from typing import Literal

from raysteps.kit.manifest import Step
from raysteps.kit.project import Project
from raysteps.kit.stubs import stub_for
from raysteps.mistakes.alternatives import read_alternatives
from raysteps.mistakes.catalogue import Mutant, read_mutants, reference_source

Kind = Literal["stub", "reference", "mutant", "alternative"]


@dataclass(frozen=True)
class Entrant:
    """One file for one step. A mutant is wrong, a stub is nothing, the others are right."""

    kind: Kind
    step: str
    name: str
    source: str
    mutant: Mutant | None = None

    @property
    def is_right(self) -> bool:
        return self.kind in ("reference", "alternative")


def reference(project: Project, step: Step) -> Entrant:
    """The kit's own solution, as a student would hand it in."""
    return Entrant("reference", step.id, "the reference", reference_source(project, step))


def stub(project: Project, step: Step) -> Entrant:
    """Without the lines that tell that nothing was begun, so that it is run like any other file."""
    lines = stub_for(project, step).splitlines()
    source = "\n".join(line for line in lines if "RAYSTEPS_TODO" not in line) + "\n"
    return Entrant("stub", step.id, "stub", source)


def mutants(project: Project, step: Step) -> list[Entrant]:
    """One for each known mistake."""
    right = reference_source(project, step)
    known = read_mutants(project, step)
    return [Entrant("mutant", step.id, mutant.id, mutant.applied(right), mutant) for mutant in known]


def right_ones(project: Project, step: Step) -> list[Entrant]:
    """The reference, then the other correct ways."""
    return [reference(project, step), *alternatives(project, step)]


def alternatives(project: Project, step: Step) -> list[Entrant]:
    """One for each other correct way."""
    known = read_alternatives(project, step)
    return [Entrant("alternative", step.id, one.name, one.source) for one in known]
