"""What a true grade says about a file, and what it said."""

from dataclasses import dataclass

from raysteps.results.model import StepResult
from raysteps.upkeep.entrants import Entrant


@dataclass(frozen=True)
class Seen:
    """One file with its result."""

    entrant: Entrant
    result: StepResult

    @property
    def tests_noticed(self) -> bool:
        """Whether the visible tests alone show that something is wrong."""
        return not all(test.passed for test in self.result.tests)

    @property
    def pictures_noticed(self) -> bool:
        return not all(image.passed for image in self.result.images)

    @property
    def named(self) -> bool:
        """Whether the first diagnosis is this mistake, alone or with those that look the same."""
        mutant = self.entrant.mutant
        first = next(iter(self.result.diagnoses), None)
        if mutant is None or first is None or first.kind != "mistake":
            return False
        return first.id == mutant.id or mutant.name in first.alike

    @property
    def said(self) -> str:
        """What the first diagnosis is."""
        first = next(iter(self.result.diagnoses), None)
        return "nothing" if first is None else f"{first.id} ({first.kind})"

    @property
    def problem(self) -> str:
        """Why the points are not true; empty when they are."""
        result, kind = self.result, self.entrant.kind
        points = f"{result.points:g} of {result.max:g} points"
        if result.inconsistent:
            return f"it is honest, and the grader contradicts it: {result.inconsistent[0]}"
        if kind == "stub":
            return "" if result.points == 0 else f"a stub has {points}"
        if result.status == "does-not-build":
            return f"it does not build: {' '.join(result.messages)[:300]}"
        if self.entrant.is_right:
            why = "; ".join(result.messages)[:500]
            return "" if result.status == "passed" else f"it is right and has {points}: {why}"
        return "" if result.points < result.max else "nobody notices it: it has all points"
