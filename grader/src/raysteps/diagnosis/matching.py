"""How well a known mistake explains what was seen, function by function and picture by picture."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from raysteps.diagnosis.answers import Questions, Said
from raysteps.diagnosis.evidence import Evidence, Picture, differing
from raysteps.diagnosis.fingerprints import Fingerprint
from raysteps.diagnosis.sameness import likeness
from raysteps.mistakes.catalogue import Mutant
from raysteps.programs.pictures import Pixels

GOOD = 0.8  # a score from which on a mistake explains something
_FEWEST_CASES = 2.0
_FEWEST_YES_OR_NO = 4.0  # where all wrong answers are the same
_FEWEST_PIXELS = 12


@dataclass(frozen=True)
class Agreement:
    """Of a mistake and the student in one function: the cases in which either is wrong, and how alike they are where
    both are. `fewest`: agreeing cases below this prove nothing."""

    mine: frozenset[int]
    mistake: frozenset[int]
    alike: Mapping[int, float]
    fewest: float = _FEWEST_CASES

    @property
    def score(self) -> float:
        """The share of the cases where one of the two is wrong in which both are, in the same way."""
        whole = sum(self.alike.values())
        return whole / len(self.mine | self.mistake) if whole >= self.fewest else 0.0


@dataclass
class Match:
    """What a mistake has to do with what is wrong, by the name of a function or picture.

    `against`: what the mistake spoils, and is right.
    """

    mutant: Mutant
    functions: dict[str, Agreement] = field(default_factory=dict)
    pictures: dict[str, float] = field(default_factory=dict)
    against: list[str] = field(default_factory=list)

    def explains(self) -> dict[str, float]:
        """With a score from 0 to 1."""
        scores = {name: agreement.score for name, agreement in self.functions.items()} | self.pictures
        return {name: score for name, score in scores.items() if score >= GOOD}


def agreement(questions: Questions, mistake: Mapping[int, Said], mine: Mapping[int, Said]) -> Agreement:
    """Cases of which nobody knows the answer are left out."""
    unknown = {number for said in (mistake, mine) for number, one in said.items() if not one.known}
    both = (mistake.keys() & mine.keys()) - unknown
    cases, right = questions.cases, questions.right
    alike = {
        number: likeness(questions.function, cases[number], right[number], mistake[number], mine[number])
        for number in both
    }
    fewest = _FEWEST_YES_OR_NO if questions.function.yes_or_no else _FEWEST_CASES
    return Agreement(frozenset(mine.keys() - unknown), frozenset(mistake.keys() - unknown), alike, fewest)


def picture_score(mistake: Pixels | None, picture: Picture) -> float:
    """The share of the pixels where one of the two is wrong in which they are the same."""
    if mistake is None or mistake.shape != picture.mine.shape:
        return 0.0
    wrong = picture.wrong | differing(mistake, picture.reference)
    if wrong.sum() < _FEWEST_PIXELS:
        return 0.0
    return float((wrong & ~differing(mistake, picture.mine)).sum() / wrong.sum())


def spoils(mistake: Pixels | None, picture: Picture) -> bool:
    """Whether the mistake shows in this picture."""
    if mistake is None or mistake.shape != picture.reference.shape:
        return True
    return float(differing(mistake, picture.reference).mean()) > 2 * picture.case.max_wrong


def match(mutant: Mutant, fingerprint: Fingerprint, evidence: Evidence) -> Match:
    """One mistake against everything that was seen."""
    found = Match(mutant)
    for name, mine in evidence.answers.items():
        mistake = fingerprint.answers.get(name, {})
        if mine:
            found.functions[name] = agreement(evidence.questions[name], mistake, mine)
        elif mistake:
            found.against.append(name)
    for name, picture in evidence.pictures.items():
        drawn = fingerprint.pictures.get(name)
        if picture.is_wrong:
            found.pictures[name] = picture_score(drawn, picture) if picture.says_something else 0.0
        elif spoils(drawn, picture):
            found.against.append(name)
    return found
