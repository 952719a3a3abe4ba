"""The example that a wrong function is shown with: the smallest that was found, kept in a file for `replay`."""

from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import ClassVar, Literal

from raysteps.common.documents import Malformed, Text, parse
from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import write_json
from raysteps.common.text import printable, shorten
from raysteps.course.manifest import Step
from raysteps.judge.choice_sequence import Choice, Recorder
from raysteps.judge.functions import FORMER_NAMES, Group, functions_of, seed_of
from raysteps.judge.shrink import CpuBudget, Shrinker
from raysteps.judge.worker import Ask, JudgedCase
from raysteps.results.store import FOLDER, place_of

# A single case in a file, to be asked again: cases/NN-function.json beside results.json.

SCHEMA: Literal["raysteps/case/v1"] = "raysteps/case/v1"
_LARGEST = 1 << 20  # bytes


@dataclass(frozen=True)
class CaseFile:
    """`line` is what the worker reads, with any number in front; the words are what people read, as it was when the
    file was written. It tells no seed: it may be handed back."""

    FORMER_KEYS: ClassVar = ("seed",)

    schema: Literal["raysteps/case/v1"]
    step: str
    function: str
    kind: str
    line: Text
    problem: str
    given: str
    expected: str
    actual: str


def write_case(path: Path, case: CaseFile) -> None:
    write_json(path, asdict(case))


def _refuse(path: Path, problem: str) -> UsageError:
    return UsageError(f"{path}: {problem}; expected a case as `check` writes it, such as {FOLDER}/02-closest-hit.json")


def read_case(path: Path) -> CaseFile:
    """Anything may stand in a file that somebody names."""
    try:
        with path.open("rb") as file:
            data = file.read(_LARGEST + 1)
        if len(data) > _LARGEST:
            raise _refuse(path, "too large")
        case = parse(data, CaseFile)
    except IsADirectoryError as error:
        raise _refuse(path, "a folder; name a file in it") from error
    except FileNotFoundError as error:
        raise _refuse(path, "is not there") from error
    except OSError as error:
        raise _refuse(path, f"cannot be read ({reason(error)})") from error
    except Malformed as error:
        raise _refuse(path, str(error)) from error
    function, line = printable(case.function), printable(case.line)
    for name, former in FORMER_NAMES.items():
        if function == former:
            function, line = name, line.replace(former, name, 1)
    words = (printable(text) for text in (case.problem, case.given, case.expected, case.actual))
    return CaseFile(SCHEMA, printable(case.step), function, printable(case.kind), line, *words)


LONGEST = 2000  # characters of an input or an answer in words


def choices_of(group: Group, seed: str, place: int) -> list[Choice]:
    """What the case at that place of its kind is made of. Drawing once more costs less than remembering always."""
    draw = Recorder(seed)
    for _ in range(place):
        group.make(draw)
    draw.choices.clear()
    group.make(draw)
    return draw.choices


@dataclass
class Examples:
    """Of one step. `reference` is asked without keeping what it says: the questions are about one submission."""

    student: Ask
    reference: Ask
    folder: Path
    say: Callable[[str], None] = lambda text: None
    budget: CpuBudget = field(default_factory=CpuBudget)
    above: float = -1.0  # what a function must earn more than to get one: else an earlier one is shown, and stays

    def smallest(self, step: Step, found: JudgedCase, place: int, seed: int) -> tuple[JudgedCase, str]:
        """The simplest case that is wrong in the same way, and its file, by its place in the folder of the results.
        What goes wrong here costs no grade: the case is shown as it was asked, without a file."""
        try:
            return self._smallest(step, found, place, seed)
        except (GraderFault, ArithmeticError, LookupError, OSError, TypeError, ValueError) as error:
            self.say(f"no small case of {step.number} {found.case.function}: {error!r}")
            return found, ""

    def _smallest(self, step: Step, found: JudgedCase, place: int, seed: int) -> tuple[JudgedCase, str]:
        function = functions_of(step.number)[found.case.function]
        kind = found.case.group
        choices = choices_of(function.by_name[kind], seed_of(step.id, function.name, kind, seed), place)
        shrinker = Shrinker(function, self.student, self.reference, self.budget)
        found = shrinker.shrink(found, choices)
        verdict, given = found.verdict, shorten(found.case.given(), LONGEST)
        expected, actual = shorten(verdict.expected, LONGEST), shorten(verdict.actual, LONGEST)
        line, name = found.case.line(1), place_of(step.number, function.name)
        case = CaseFile(SCHEMA, step.id, function.name, kind, line, str(verdict.problem), given, expected, actual)
        write_case(self.folder / name, case)
        return found, name
