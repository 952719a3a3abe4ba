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


def _worth(match: Match, open_: Collection[str]) -> float:
    explained = {name: score for name, score in match.explains().items() if name in open_}
    worth = sum(score * (_PICTURE if name in match.pictures else 1.0) for name, score in explained.items())
    worth -= _AGAINST * len(match.against)
    return worth - (_NOT_ITS_OWN if match.functions and match.mutant.function not in match.explains() else 0.0)


def _is_named_by(match: Match, open_: set[str]) -> bool:
    """By a function, or by pictures alone."""
    explained = match.explains().keys() & open_
    return bool(explained & match.functions.keys()) or (bool(explained) and match.named_by_pictures())


def name_mistakes(matches: Sequence[Match]) -> list[Named]:
    """The likeliest first. `matches`: of all known mistakes, in the catalogue's order."""
    open_ = {name for match in matches for name in (*match.functions, *match.pictures)}
    named: list[Named] = []
    while len(named) < _MOST:
        able = [(match, _worth(match, open_)) for match in matches if _is_named_by(match, open_)]
        able = [(match, worth) for match, worth in able if worth > 0]
        if not able:
            break
        best, worth = max(able, key=lambda pair: pair[1])
        explained = [name for name in best.explains() if name in open_]
        alike = [
            match.mutant
            for match, other in able
            if match is not best
            and worth - other <= _HAIR
            and [name for name in match.explains() if name in open_] == explained
        ]
        named.append(Named(best.mutant, tuple(explained), tuple(alike)))
        open_ -= set(explained)
    return named + _pairs(matches, open_)[: _MOST - len(named)]


def _pairs(matches: Sequence[Match], open_: Collection[str]) -> list[Named]:
    """For functions that no single mistake explains."""
    found: list[Named] = []
    for function in dict.fromkeys(name for match in matches for name in match.functions if name in open_):
        pair = best_pair(function, matches)
        found += [Named(match.mutant, (function,), ()) for match in pair or ()]
    return found
