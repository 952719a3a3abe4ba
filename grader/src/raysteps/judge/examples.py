"""The example that a wrong function is shown with: the smallest that was found, kept in a file for `replay`."""

from collections.abc import Callable
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.common.text import shorten
from raysteps.judge.case_files import CaseFile, write_case
from raysteps.judge.choices import Choice, Recorder
from raysteps.judge.functions import Group, seed_of
from raysteps.judge.generators import functions_of
from raysteps.judge.judged import Judged
from raysteps.judge.patience import Patience
from raysteps.judge.shrinking import Shrinker
from raysteps.judge.worker_client import Ask
from raysteps.kit.manifest import Step
from raysteps.results.case_places import place_of

LONGEST = 2000  # characters of an input or an answer in words
_PATIENCE = 8.0  # seconds that a student's worker runs for the examples of a step


def choices_of(group: Group, seed: str, place: int) -> list[Choice]:
    """What the case at that place of its kind is made of. Drawing once more costs less than remembering always."""
    draw = Recorder(seed)
    for _ in range(place):
        group.make(draw)
    draw.choices.clear()
    group.make(draw)
    return draw.choices


class Examples:
    """Of one step. `reference` is asked without keeping what it says: the questions are about one submission."""

    def __init__(
        self, student: Ask, reference: Ask, folder: Path, say: Callable[[str], None] = lambda text: None
    ) -> None:
        self._student = student
        self._reference = reference
        self._folder = folder
        self._say = say
        self._patience = Patience(_PATIENCE)

    def smallest(self, step: Step, found: Judged, place: int, seed: int) -> tuple[Judged, str]:
        """The simplest case that is wrong in the same way, and its file, by its place in the folder of the results.
        What goes wrong here costs no grade: the case is shown as it was asked, without a file."""
        try:
            return self._smallest(step, found, place, seed)
        except (GraderFault, ArithmeticError, LookupError, OSError, TypeError, ValueError) as error:
            self._say(f"no small case of {step.number} {found.case.function}: {error!r}")
            return found, ""

    def _smallest(self, step: Step, found: Judged, place: int, seed: int) -> tuple[Judged, str]:
        function = functions_of(step.number)[found.case.function]
        kind = found.case.group
        choices = choices_of(function.by_name[kind], seed_of(step.id, function.name, kind, seed), place)
        shrinker = Shrinker(function, self._student, self._reference, self._patience)
        found = shrinker.shrink(found, choices)
        verdict, given = found.verdict, shorten(found.case.given(), LONGEST)
        expected, actual = shorten(verdict.expected, LONGEST), shorten(verdict.actual, LONGEST)
        line, name = found.case.line(1), place_of(step.number, function.name)
        case = CaseFile(step.id, function.name, kind, seed, line, str(verdict.problem), given, expected, actual)
        write_case(self._folder / name, case)
        return found, name
