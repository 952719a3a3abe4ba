"""How well a known mistake explains what was seen, function by function and picture by picture."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from raysteps.diagnosis.answers import Said, cases_of
from raysteps.diagnosis.evidence import Evidence, Picture, differing
from raysteps.diagnosis.fingerprints import Fingerprint
from raysteps.diagnosis.sameness import likeness
from raysteps.judge.functions import Function
from raysteps.judge.generators import functions_of
from raysteps.judge.plan import FunctionPlan, Plan
from raysteps.kit.manifest import Step
from raysteps.mistakes.catalogue import Mutant
from raysteps.programs.pictures import Pixels

GOOD = 0.8  # a score from which on a mistake explains something
_FEWEST_CASES = 2.0
_FEWEST_YES_OR_NO = 4.0  # where all wrong answers are the same
_FEWEST_PIXELS = 12


@dataclass
class Match:
    """Scores of what is wrong, from 0 to 1, by the name of a function or picture.

    `against`: what the mistake spoils, and is right.
    """

    mutant: Mutant
    functions: dict[str, float] = field(default_factory=dict)
    pictures: dict[str, float] = field(default_factory=dict)
    against: list[str] = field(default_factory=list)

    def explains(self) -> dict[str, float]:
        return {name: score for name, score in {**self.functions, **self.pictures}.items() if score >= GOOD}


def wrong_cases(said: Mapping[int, Said]) -> set[int]:
    return {number for number, one in said.items() if one.known}


def function_score(
    function: Function, plan: FunctionPlan, step: Step, mistake: Mapping[int, Said], mine: Mapping[int, Said]
) -> float:
    """The share of the cases where one of the two is wrong in which both are, in the same way."""
    unknown = {number for said in (mistake, mine) for number, one in said.items() if not one.known}
    wrong = (wrong_cases(mistake) | wrong_cases(mine)) - unknown
    both = wrong & mistake.keys() & mine.keys()
    cases = cases_of(step, plan)
    alike = sum(likeness(function, cases[number], mistake[number], mine[number]) for number in both)
    if alike < (_FEWEST_YES_OR_NO if function.yes_or_no else _FEWEST_CASES):
        return 0.0
    return alike / len(wrong)


def picture_score(mistake: Pixels | None, picture: Picture) -> float:
    """The share of the pixels where one of the two is wrong in which they are the same."""
    if mistake is None or mistake.shape != picture.mine.shape:
        return 0.0
    wrong = picture.wrong | differing(mistake, picture.reference)
    if wrong.sum() < _FEWEST_PIXELS:
        return 0.0
    return float((wrong & ~differing(mistake, picture.mine)).sum() / wrong.sum())


def spoils(mistake: Pixels | None, picture: Picture) -> bool:
    """Whether the mistake shows in a picture that is right."""
    if mistake is None or mistake.shape != picture.reference.shape:
        return True
    return float(differing(mistake, picture.reference).mean()) > 2 * picture.case.max_wrong


def match(mutant: Mutant, fingerprint: Fingerprint, evidence: Evidence, step: Step, plan: Plan | None) -> Match:
    """One mistake against everything that was seen."""
    found = Match(mutant)
    for function in plan.functions if plan is not None else ():
        mine = evidence.answers.get(function.name)
        mistake = fingerprint.answers.get(function.name, {})
        if mine is None:
            continue
        if wrong_cases(mine):
            known = functions_of(step.number)[function.name]
            found.functions[function.name] = function_score(known, function, step, mistake, mine)
        elif wrong_cases(mistake) and len(mine) == 0:
            found.against.append(function.name)
    for name, picture in evidence.pictures.items():
        drawn = fingerprint.pictures.get(name)
        if picture.is_wrong:
            found.pictures[name] = picture_score(drawn, picture) if picture.says_something else 0.0
        elif spoils(drawn, picture):
            found.against.append(name)
    return found
