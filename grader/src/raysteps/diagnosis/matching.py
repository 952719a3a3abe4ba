"""How well a known mistake explains what was seen, function by function and picture by picture."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from raysteps.diagnosis.answers import Questions, Said
from raysteps.diagnosis.evidence import Evidence, Picture, differing
from raysteps.diagnosis.fingerprints import Fingerprint
from raysteps.diagnosis.sameness import likeness
from raysteps.judge.bvhs import BVH
from raysteps.judge.trees import TREE
from raysteps.mistakes.catalogue import Mutant
from raysteps.programs.pictures import Pixels

GOOD = 0.7  # of the wrong cases of a function: from there on a mistake explains it
_GOOD_PICTURE = 0.8  # of the wrong pixels
_GOOD_WITH_PICTURES = 0.55  # of the cases, where the mistake explains all pictures that are wrong
GOOD_WEAK = 0.95  # of the cases, where wrong answers hardly differ and no picture is explained
_GOOD_AGAINST_PICTURES = 0.85  # of the cases, where pictures are wrong and the mistake explains none
_ANOTHER = 0.2  # of the cases of its own function: below, that is wrong in another way; the same words alone give 0.25
_NOT_AGAINST = 0.4  # of the cases of its own function that a mistake must explain which pictures name
_FEWEST_CASES = 2.0
_FEWEST_WEAK = 4.0  # where wrong answers hardly differ
_FEWEST_PIXELS = 12


@dataclass(frozen=True)
class Agreement:
    """Of a mistake and the student in one function: the cases in which either is wrong, and how alike they are where
    both are. `weak`: wrong answers hardly differ, so that they prove less."""

    mine: frozenset[int]
    mistake: frozenset[int]
    alike: Mapping[int, float]
    weak: bool = False

    @property
    def score(self) -> float:
        """The share of the cases where one of the two is wrong in which both are, in the same way."""
        whole = sum(self.alike.values())
        enough = whole >= (_FEWEST_WEAK if self.weak else _FEWEST_CASES)
        return whole / len(self.mine | self.mistake) if enough else 0.0


@dataclass
class Match:
    """What a mistake has to do with what is wrong, by the name of a function or picture.

    `telling`: the pictures that are not of one colour, which may have any cause. `spoilt`: wrong pictures in which the
    mistake shows. `against`: what the mistake spoils and is right.
    """

    mutant: Mutant
    functions: dict[str, Agreement] = field(default_factory=dict)
    pictures: dict[str, float] = field(default_factory=dict)
    telling: set[str] = field(default_factory=set)
    spoilt: set[str] = field(default_factory=set)
    against: list[str] = field(default_factory=list)

    def explains(self, told: Collection[str] = ()) -> dict[str, float]:
        """With a score from 0 to 1. `told`: pictures that other mistakes spoil: they do not speak against it."""
        least = {name: self._least(one, told) for name, one in self.functions.items()}
        scores = {name: one.score for name, one in self.functions.items() if one.score >= least[name]}
        return scores | self._drawn()

    def _drawn(self) -> dict[str, float]:
        return {name: score for name, score in self.pictures.items() if score >= _GOOD_PICTURE}

    def _least(self, one: Agreement, told: Collection[str]) -> float:
        drawn = self._drawn()
        telling = drawn.keys() & self.telling
        if one.weak:
            return GOOD if telling else GOOD_WEAK
        if self.telling - set(told) and not telling:
            return _GOOD_AGAINST_PICTURES
        return _GOOD_WITH_PICTURES if drawn and len(drawn) == len(self.pictures) else GOOD

    def is_another(self) -> bool:
        """Whether the function in which the mistake sits is wrong in another way."""
        own = self.functions.get(self.mutant.function)
        return own is not None and own.score < _ANOTHER

    def named_by_pictures(self) -> bool:
        """Whether it explains all pictures that say something, and its own function does not speak against it."""
        if not self.telling or not self.telling <= self._drawn().keys():
            return False
        own = self.functions.get(self.mutant.function)
        return not self.functions or (own is not None and own.score >= _NOT_AGAINST)


def agreement(questions: Questions, mistake: Mapping[int, Said], mine: Mapping[int, Said]) -> Agreement:
    """Cases of which nobody knows the answer are left out."""
    unknown = {number for said in (mistake, mine) for number, one in said.items() if not one.known}
    both = (mistake.keys() & mine.keys()) - unknown
    cases, right = questions.cases, questions.right
    alike = {
        number: likeness(questions.function, cases[number], right[number], mistake[number], mine[number])
        for number in both
    }
    wrong, other = frozenset(mine.keys() - unknown), frozenset(mistake.keys() - unknown)
    weak = questions.function.yes_or_no or questions.function.answer in (TREE, BVH)
    return Agreement(wrong, other, alike, weak)


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
            found.pictures[name] = picture_score(drawn, picture)
            found.telling |= {name} if picture.says_something else set()
            found.spoilt |= {name} if spoils(drawn, picture) else set()
        elif spoils(drawn, picture):
            found.against.append(name)
    return found
