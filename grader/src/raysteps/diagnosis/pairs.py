"""Two mistakes in one function: neither explains it alone, together they do."""

from collections.abc import Sequence
from itertools import combinations

from raysteps.diagnosis.matching import GOOD, GOOD_WEAK, Agreement, Match

_SAME = 0.6  # of a case from which on the answers are taken for the same
_OWN = 4  # cases that only this one of the two explains
_MIXED = 0.5  # of a case which both mistakes spoil, and where the answer is a third one


def pair_score(one: Agreement, other: Agreement) -> float:
    """The share of the wrong cases that one of the two explains; 0 where one of them is not needed."""
    mine, both = one.mine & other.mine, one.mistake & other.mistake
    whole = 0.0
    own = {0: 0, 1: 0}
    for number in mine:
        first, second = one.alike.get(number, 0.0), other.alike.get(number, 0.0)
        whole += max(first, second, _MIXED if number in both else 0.0)
        own[0] += first >= _SAME > second
        own[1] += second >= _SAME > first
    return whole / len(mine | one.mistake | other.mistake) if min(own.values()) >= _OWN else 0.0


def best_pair(function: str, matches: Sequence[Match]) -> tuple[Match, Match] | None:
    """The two that explain the function together; mistakes of this function only."""
    here = [match for match in matches if match.mutant.function == function and match.functions[function].mistake]
    scored = [
        (pair_score(one.functions[function], other.functions[function]), (one, other))
        for one, other in combinations(here, 2)
        if one.mutant.id != other.mutant.id
    ]
    best = max(scored, key=lambda item: item[0], default=None)
    least = GOOD_WEAK if any(match.functions[function].weak for match in here) else GOOD
    return best[1] if best is not None and best[0] >= least else None
