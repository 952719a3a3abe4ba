"""The smallest counterexample: a wrong case, made simpler as long as it stays wrong in the same way."""

from collections.abc import Collection, Sequence
from itertools import chain, islice

from raysteps.judge.answers import TooLarge, Wasteful
from raysteps.judge.candidates import Candidate, Recipe, make
from raysteps.judge.changes import Change, changes, combined, live_choices
from raysteps.judge.choices import Choice
from raysteps.judge.functions import Function
from raysteps.judge.judged import Judged
from raysteps.judge.patience import Patience
from raysteps.judge.reshaping import Place
from raysteps.judge.trials import Trials
from raysteps.judge.worker_client import Ask

_ROUNDS = 12
_ROUNDS_OF_SILENCE = 3  # where each costs a hang
_MOST = 200  # candidates in a round
_MOST_CHOICES = 8000  # of all candidates in a round together
_LEAST = 60
_TRIES = 3  # for each candidate of a round: many changes make a case that was asked before, or none
_BARREN = 3  # rounds without a simpler case
_BEST = 30  # changes that did well and are tried together


def _shape(candidate: Candidate) -> tuple[int, frozenset[Place]]:
    return len(candidate.choices), candidate.recipe.dropped


class Shrinker:
    """Goes from a wrong case to simpler ones, round by round."""

    def __init__(self, function: Function, student: Ask, reference: Ask, patience: Patience) -> None:
        self._function = function
        self._trials = Trials(function, student, reference, patience)
        self._patience = patience

    def shrink(self, found: Judged, choices: Sequence[Choice]) -> Judged:
        """The simplest case that was found in a bounded number of rounds; the given one, if there is none."""
        base = make(self._function, found.case.group, Recipe(tuple(choice.value for choice in choices)))
        unclear = isinstance(found.verdict.problem, Wasteful | TooLarge)
        if base is None or unclear or not found.asked or base.case.line(0) != found.case.line(0):
            return found
        tried = {base.case.line(0)}
        live = set(live_choices(self._function, base))
        good: list[Change] = []
        barren = 0
        for _ in range(_ROUNDS_OF_SILENCE if found.outcome == "timeout" else _ROUNDS):
            seconds = self._patience.next_run()
            proposed = self._proposed(base, live, good, tried) if seconds and barren < _BARREN else []
            if not proposed:
                break
            wrong = self._trials.wrong(found, proposed, seconds)
            simpler = [one for one in wrong if one.candidate.complexity < base.complexity]
            best = self._trials.simplest_stable(simpler)
            good = [one.change for one in simpler if one is not best][:_BEST]
            barren += 1
            if best is not None:
                if _shape(best.candidate) != _shape(base):
                    live = set(live_choices(self._function, best.candidate))
                base, found, barren = best.candidate, best.judged, 0
        return found

    def _proposed(
        self, base: Candidate, live: Collection[int], good: Sequence[Change], tried: set[str]
    ) -> list[tuple[Candidate, Change]]:
        """New ones only, as many as a round may have."""
        most = max(_LEAST, min(_MOST, _MOST_CHOICES // max(1, len(base.choices))))
        found: list[tuple[Candidate, Change]] = []
        group = base.case.group
        may_drop = not self._function.by_name[group].saves
        every = chain(combined(good), changes(base, live, may_drop=may_drop))
        for change in islice(every, _TRIES * most):
            if len(found) == most:
                break
            candidate = make(self._function, group, change.of(base.recipe))
            if candidate is not None and candidate.case.line(0) not in tried:
                tried.add(candidate.case.line(0))
                found.append((candidate, change))
        return sorted(found, key=lambda one: one[0].complexity)
