"""What there is to show of a known mistake."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from raysteps.common.errors import GraderFault
from raysteps.diagnosis.fingerprints import Fingerprint
from raysteps.diagnosis.learning import known_mistakes
from raysteps.judge.plan import read_plan
from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.manifest import Step
from raysteps.mistakes.catalogue import Mutant, read_mutants
from raysteps.programs.pictures import Pixels, compare
from raysteps.programs.rendering import reference_picture


@dataclass(frozen=True)
class Exhibit:
    """A mistake, the picture with the most wrong pixels, and all in which it shows."""

    mutant: Mutant
    picture: str | None  # none where all pictures stay right
    pixels: Pixels | None
    pictures: Sequence[str]
    functions: Sequence[str]  # whose answers to the judge it makes wrong


def references(kit: BuiltKit, step: Step) -> dict[str, Pixels]:
    """The right pictures of the step, by name."""
    return {case.name: reference_picture(kit, kit.project.root / case.scene, case.args) for case in step.images}


def _exhibit(step: Step, mutant: Mutant, known: Fingerprint, right: Mapping[str, Pixels]) -> Exhibit:
    wrong = {
        case.name: compare(known.pictures[case.name], right[case.name], case.max_wrong)
        for case in step.images
        if case.name in known.pictures
    }
    shown = {name: seen.wrong_share * right[name].size for name, seen in wrong.items() if not seen.passed}
    best = max(shown, key=lambda name: shown[name], default=None)
    functions = [name for name in step.functions if known.answers.get(name)]
    return Exhibit(mutant, best, known.pictures[best] if best else None, list(shown), functions)


def exhibits(kit: BuiltKit, step: Step, say: Say) -> list[Exhibit]:
    """One for each mistake, in the order of the catalogue."""
    mutants = read_mutants(kit.project, step)
    if not mutants:
        raise GraderFault(f"{step.id}: there is no catalogue of mistakes")
    known = known_mistakes(kit, step, read_plan(kit.project, step), mutants, say)
    right = references(kit, step)
    return [_exhibit(step, mutant, known[mutant.id], right) for mutant in mutants]
