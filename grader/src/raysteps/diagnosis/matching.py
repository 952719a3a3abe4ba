"""How well a known mistake explains what was seen, function by function and picture by picture."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations

from raysteps.course.mutants import Mutant
from raysteps.diagnosis.evidence import Evidence, Picture, Questions, WrongAnswer, answer_similarity, differing
from raysteps.diagnosis.mutant_fingerprints import MutantFingerprint
from raysteps.images.compare import Pixels
from raysteps.judge.bvhs import BVH
from raysteps.judge.cases.octree_boxes import NO_PART
from raysteps.judge.hits import NOTHING_FOUND
from raysteps.judge.octrees import OCTREE
from raysteps.results.model import Diagnosis

MIN_SCORE = 0.7  # of the wrong cases of a function: from there on a mistake explains it
_GOOD_PICTURE = 0.8  # of the wrong pixels
_GOOD_WITH_PICTURES = 0.55  # of the cases, where the mistake explains all pictures that are wrong
MIN_WEAK_SCORE = 0.95  # of the cases, where wrong answers hardly differ and no picture without a tree is explained
_NEVER = 2.0  # where, besides, the mistake would draw other pictures
_GOOD_AGAINST_PICTURES = 0.85  # of the cases, where pictures are wrong and the mistake explains none
_ANOTHER = 0.2  # of a picture, or of cases where wrong answers hardly differ: below, that is wrong in another way
_NOT_AGAINST = 0.4  # of the cases of its own function that a mistake must explain which pictures, or those that call
# that function, name; that both are wrong gives 0.25, that both are so in the same way 0.45
_FEWEST_CASES = 2.0
_FEWEST_WEAK = 4.0  # where wrong answers hardly differ
_FEWEST_PIXELS = 12
_MOSTLY_EMPTY = 0.5  # of the cases
_FEWEST_DENYING = 4  # cases of its own function that a mistake makes wrong: who has them right has not made it


@dataclass(frozen=True)
class Agreement:
    """Of a mistake and the student in one function: the cases in which either is wrong, and how alike they are where
    both are. `weak`: wrong answers hardly differ, so that they prove less. `empty`: of the cases where both are wrong,
    the share in which nothing was found where there is something: so it looks whatever lost it. `constant`: the
    student's answer is always the same, which mistakes that are not seem to explain, above all two of them together."""

    mine: frozenset[int]
    mistake: frozenset[int]
    alike: Mapping[int, float]
    weak: bool = False
    empty: float = 0.0
    constant: bool = False

    @property
    def least_alike(self) -> float:
        """The score below which the student's function, if the mistake sits in it, is wrong in another way."""
        if self.weak:
            return _ANOTHER
        return MIN_WEAK_SCORE if self.constant else _NOT_AGAINST

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
    mistake shows. `against`: what the mistake spoils and is right. `denied`: its own function is among that.
    `in_trees`: pictures that hang on how a tree is built. `right_apart`: its own function is right where the
    reference's stand for the wrong ones before it, so its wrong answers are another function's. `refuted`: it draws
    another picture than the one that came out right, and no tree has a part in that.
    """

    mutant: Mutant
    functions: dict[str, Agreement] = field(default_factory=dict)
    pictures: dict[str, float] = field(default_factory=dict)
    telling: set[str] = field(default_factory=set)
    spoilt: set[str] = field(default_factory=set)
    against: list[str] = field(default_factory=list)
    denied: bool = False
    spoils_right: bool = False
    in_trees: set[str] = field(default_factory=set)
    right_apart: bool = False
    refuted: bool = False

    def explains(self, told: Collection[str] = ()) -> dict[str, float]:
        """With a score from 0 to 1. `told`: pictures that other mistakes spoil: they do not speak against it."""
        least = {name: self._least(one, told) for name, one in self.functions.items()}
        scores = {name: one.score for name, one in self.functions.items() if one.score >= least[name]}
        return scores | self._drawn()

    def _drawn(self) -> dict[str, float]:
        return {name: score for name, score in self.pictures.items() if score >= _GOOD_PICTURE}

    def _least(self, one: Agreement, told: Collection[str]) -> float:
        if one.constant and not one.weak:
            return MIN_WEAK_SCORE
        drawn = self._drawn()
        telling = drawn.keys() & self.telling
        if one.weak:
            plain = [score for name, score in self.pictures.items() if name in self.telling - self.in_trees - set(told)]
            if plain and max(plain) < _ANOTHER:
                return _NEVER
            return MIN_SCORE if telling - self.in_trees else MIN_WEAK_SCORE
        if self.telling - set(told) and not telling:
            return _GOOD_AGAINST_PICTURES
        return _GOOD_WITH_PICTURES if drawn and len(drawn) == len(self.pictures) else MIN_SCORE

    def is_different_mistake(self) -> bool:
        """Whether the function in which the mistake sits is wrong in another way, whatever those that call it look
        like. Or it is right, and those that the mistake explains only find nothing."""
        own = self.functions.get(self.mutant.function)
        if own is not None and own.score < own.least_alike:
            return True
        explained = self.explains().keys() & self.functions.keys()
        return self.denied and all(self.functions[name].empty > _MOSTLY_EMPTY for name in explained)

    def is_refuted(self) -> bool:
        """Whether a right picture outweighs what is known of its own function: yes and no are often the same answer by
        chance. Numbers that are wrong alike are not, and perhaps nothing that draws calls that function."""
        own = self.functions.get(self.mutant.function)
        return self.refuted and own is not None and own.weak

    def is_seen(self) -> bool:
        """Whether the pictures may look as the mistake makes them look: not where it explains none of those that are
        wrong and say something, or spoils one that is right."""
        explains_none = bool(self.telling) and not self.telling & self._drawn().keys()
        return not (explains_none or self.spoils_right)

    def named_by_pictures(self) -> bool:
        """Whether it explains all pictures that say something, and its own function does not speak against it."""
        if not self.telling or not self.telling <= self._drawn().keys():
            return False
        own = self.functions.get(self.mutant.function)
        return not self.functions or (own is not None and own.score >= _NOT_AGAINST)


def agreement(
    questions: Questions,
    mistake: Mapping[int, WrongAnswer],
    mine: Mapping[int, WrongAnswer],
    constant: bool = False,
) -> Agreement:
    """Cases of which nobody knows the answer are left out."""
    unknown = {number for said in (mistake, mine) for number, one in said.items() if not one.known}
    both = (mistake.keys() & mine.keys()) - unknown
    cases, right = questions.cases, questions.right
    alike = {
        number: answer_similarity(questions.function, cases[number], right[number], mistake[number], mine[number])
        for number in both
    }
    wrong, other = frozenset(mine.keys() - unknown), frozenset(mistake.keys() - unknown)
    weak = questions.function.yes_or_no or questions.function.answer in (OCTREE, BVH)
    empty = sum(mine[number].problem in (NOTHING_FOUND, NO_PART) for number in both) / len(both) if both else 0.0
    return Agreement(wrong, other, alike, weak, empty, constant)


def picture_score(mistake: Pixels | None, picture: Picture) -> float:
    """The share of the pixels where one of the two is wrong in which they are the same."""
    if mistake is None or mistake.shape != picture.mine.shape:
        return 0.0
    wrong = picture.wrong | differing(mistake, picture.reference)
    if wrong.sum() < _FEWEST_PIXELS:
        return 0.0
    return float((wrong & ~differing(mistake, picture.mine)).sum() / wrong.sum())


def shows_in(mistake: Pixels | None, picture: Picture) -> bool:
    """Whether the mistake shows in this picture."""
    if mistake is None or mistake.shape != picture.reference.shape:
        return True
    return float(differing(mistake, picture.reference).mean()) > 2 * picture.case.max_wrong


def match(mutant: Mutant, fingerprint: MutantFingerprint, evidence: Evidence) -> Match:
    """One mistake against everything that was seen."""
    own = mutant.function
    found = Match(mutant, right_apart=own in evidence.right_apart)
    is_right = own in evidence.right or (own in evidence.answers and not evidence.answers[own])
    found.denied = is_right and len(fingerprint.answers.get(own, {})) >= _FEWEST_DENYING
    for name, mine in evidence.answers.items():
        mistake = fingerprint.answers.get(name, {})
        if mine and found.denied and name in evidence.right_apart:
            continue  # a wrong function before it spoils it, and the mistake sits in a right one
        if mine:
            found.functions[name] = agreement(evidence.questions[name], mistake, mine, name in evidence.constant)
        elif mistake:
            found.against.append(name)
    for name, picture in evidence.pictures.items():
        drawn = fingerprint.pictures.get(name)
        if picture.is_wrong:
            found.pictures[name] = picture_score(drawn, picture)
            found.telling |= {name} if picture.says_something else set()
            found.in_trees |= {name} if picture.case.has_tree else set()
            found.spoilt |= {name} if shows_in(drawn, picture) else set()
        elif shows_in(drawn, picture):
            found.against.append(name)
            found.spoils_right = True
            is_drawn = drawn is not None and drawn.shape == picture.reference.shape
            found.refuted |= is_drawn and not picture.case.has_tree
    return found


# Two mistakes in one function: neither explains it alone, together they do.

_SAME = 0.6  # of a case from which on the answers are taken for the same
_OWN = 4  # cases that only this one of the two explains
_MIXED = 0.5  # of a case which both mistakes spoil, and where the answer is a third one


def pair_score(one: Agreement, other: Agreement) -> float:
    """The share of the wrong cases that one of the two explains; 0 where one of them is not needed. And where each of
    them is missing in what the other explains: of two mistakes one may hide the other, but not each the other."""
    mine, both = one.mine & other.mine, one.mistake & other.mistake
    whole = 0.0
    own, hidden = {0: 0, 1: 0}, {0: 0, 1: 0}
    for number in mine:
        first, second = one.alike.get(number, 0.0), other.alike.get(number, 0.0)
        whole += max(first, second, _MIXED if number in both else 0.0)
        for which, is_own in enumerate((first >= _SAME > second, second >= _SAME > first)):
            own[which] += is_own
            hidden[which] += is_own and number in both
    if min(own.values()) < _OWN or min(hidden.values()) >= _OWN:
        return 0.0
    return whole / len(mine | one.mistake | other.mistake)


def best_pair(function: str, matches: Sequence[Match]) -> tuple[Match, Match] | None:
    """The two that explain the function together; mistakes of this function only. None do where in most
    of the cases that both have wrong nothing was found: so it looks whatever loses what is there."""
    here = [match for match in matches if match.mutant.function == function and match.functions[function].mistake]
    if any(match.functions[function].constant for match in here):
        return None
    losing = {match.mutant.id for match in here if match.functions[function].empty > _MOSTLY_EMPTY}
    scored = [
        (pair_score(one.functions[function], other.functions[function]), (one, other))
        for one, other in combinations(here, 2)
        if one.mutant.id != other.mutant.id and not {one.mutant.id, other.mutant.id} <= losing
    ]
    best = max(scored, key=lambda item: item[0], default=None)
    least = MIN_WEAK_SCORE if any(match.functions[function].weak for match in here) else MIN_SCORE
    return best[1] if best is not None and best[0] >= least else None


# The fewest known mistakes that explain what is wrong.

_MAX = 3
_HAIR = 0.03  # mistakes whose worth differs by less cannot be told apart
_PICTURE = 0.5  # what a picture counts beside a function
_AGAINST = 0.25
_MAX_AGAINST = 3  # pictures that are right speak against a mistake, but many of them no louder than three
_NOT_ITS_OWN = 0.3  # the function in which the mistake sits is right here


@dataclass(frozen=True)
class NamedMistake:
    """A mistake with what it explains, and those that explain it as well. Not `seen`: the pictures look otherwise."""

    mutant: Mutant
    explains: tuple[str, ...]
    alike: tuple[Mutant, ...]
    seen: bool = True

    def and_again(self, other: "NamedMistake") -> "NamedMistake":
        """With all that it explains: what its pictures tell may explain more at a second look. Those that explain it
        as well explain both."""
        explains = dict.fromkeys((*self.explains, *other.explains))
        ids = {mutant.id for mutant in other.alike}
        alike = tuple(mutant for mutant in self.alike if mutant.id in ids)
        return NamedMistake(self.mutant, tuple(explains), alike, self.seen or other.seen)

    def diagnosis(self) -> Diagnosis:
        mutant = self.mutant
        alike = list(dict.fromkeys(other.name for other in self.alike if other.name != mutant.name))
        seen = list(self.explains)
        sees = mutant.sees if self.seen else ""
        return Diagnosis("mistake", mutant.id, mutant.name, sees, mutant.cause, mutant.hint, seen, alike)


@dataclass
class _Open:
    """What is not explained yet, and the pictures that are spoilt by what was named."""

    names: set[str]
    told: set[str]

    def explained_by(self, match: Match) -> dict[str, float]:
        return {name: score for name, score in match.explains(self.told).items() if name in self.names}

    def worth(self, match: Match) -> float:
        """Above 0 for a mistake that can be named: by a function, or by pictures alone."""
        explained = self.explained_by(match)
        functions = explained.keys() & match.functions.keys()
        if not explained or match.is_different_mistake() or not (functions or match.named_by_pictures()):
            return 0.0
        worth = sum(score * (_PICTURE if name in match.pictures else 1.0) for name, score in explained.items())
        worth -= _AGAINST * min(len(match.against), _MAX_AGAINST)
        return worth - (_NOT_ITS_OWN if match.functions and match.mutant.function not in functions else 0.0)


def name_mistakes(matches: Sequence[Match]) -> list[NamedMistake]:
    """The likeliest first. `matches`: of all known mistakes, in the catalogue's order."""
    open_ = _Open({name for match in matches for name in (*match.functions, *match.pictures)}, set())
    matches = [one for one in matches if not (one.right_apart or one.is_refuted())]
    found: dict[str, NamedMistake] = {}
    while True:
        worths = [(match, open_.worth(match)) for match in matches]
        best, most = max(worths, key=lambda pair: pair[1], default=(None, 0.0))
        is_known = best is not None and best.mutant.id in found
        if best is None or most <= 0 or (len(found) == _MAX and not is_known):
            break
        explained = open_.explained_by(best)
        alike = [
            match.mutant
            for match, worth in worths
            if match is not best and most - worth <= _HAIR and open_.explained_by(match).keys() == explained.keys()
        ]
        one = NamedMistake(best.mutant, tuple(explained), tuple(alike), best.is_seen())
        found[best.mutant.id] = found[best.mutant.id].and_again(one) if is_known else one
        open_.names -= explained.keys()
        open_.told |= best.spoilt
    pairs = [one for one in _pairs(matches, open_.names) if one.mutant.id not in found]
    return [*found.values(), *pairs[: _MAX - len(found)]]


def _pairs(matches: Sequence[Match], open_: Collection[str]) -> list[NamedMistake]:
    """For functions that no single mistake explains."""
    found: list[NamedMistake] = []
    for function in dict.fromkeys(name for match in matches for name in match.functions if name in open_):
        pair = best_pair(function, matches)
        found += [NamedMistake(match.mutant, (function,), ()) for match in pair or ()]
    return found
