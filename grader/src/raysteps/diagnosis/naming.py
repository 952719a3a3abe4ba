"""The fewest known mistakes that explain what is wrong."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from raysteps.diagnosis.matching import Match
from raysteps.diagnosis.pairs import best_pair
from raysteps.mistakes.catalogue import Mutant
from raysteps.results.model import Diagnosis

_MOST = 3
_HAIR = 0.01  # mistakes whose worth differs by less cannot be told apart
_PICTURE = 0.5  # what a picture counts beside a function
_AGAINST = 0.25
_NOT_ITS_OWN = 0.3  # the function in which the mistake sits is right here


@dataclass(frozen=True)
class Named:
    """A mistake with what it explains, and those that explain it as well."""

    mutant: Mutant
    explains: tuple[str, ...]
    alike: tuple[Mutant, ...]

    def diagnosis(self) -> Diagnosis:
        mutant = self.mutant
        alike = list(dict.fromkeys(other.name for other in self.alike if other.name != mutant.name))
        seen = list(self.explains)
        return Diagnosis("mistake", mutant.id, mutant.name, mutant.sees, mutant.cause, mutant.hint, seen, alike)


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
        if not explained or match.is_another() or not (functions or match.named_by_pictures()):
            return 0.0
        worth = sum(score * (_PICTURE if name in match.pictures else 1.0) for name, score in explained.items())
        worth -= _AGAINST * len(match.against)
        return worth - (_NOT_ITS_OWN if match.functions and match.mutant.function not in functions else 0.0)


def name_mistakes(matches: Sequence[Match]) -> list[Named]:
    """The likeliest first. `matches`: of all known mistakes, in the catalogue's order."""
    open_ = _Open({name for match in matches for name in (*match.functions, *match.pictures)}, set())
    named: list[Named] = []
    while len(named) < _MOST:
        worths = [(match, open_.worth(match)) for match in matches]
        best, most = max(worths, key=lambda pair: pair[1], default=(None, 0.0))
        if best is None or most <= 0:
            break
        explained = open_.explained_by(best)
        alike = [
            match.mutant
            for match, worth in worths
            if match is not best and most - worth <= _HAIR and open_.explained_by(match).keys() == explained.keys()
        ]
        named.append(Named(best.mutant, tuple(explained), tuple(alike)))
        open_.names -= explained.keys()
        open_.told |= best.spoilt
    return named + _pairs(matches, open_.names)[: _MOST - len(named)]


def _pairs(matches: Sequence[Match], open_: Collection[str]) -> list[Named]:
    """For functions that no single mistake explains."""
    found: list[Named] = []
    for function in dict.fromkeys(name for match in matches for name in match.functions if name in open_):
        pair = best_pair(function, matches)
        found += [Named(match.mutant, (function,), ()) for match in pair or ()]
    return found
