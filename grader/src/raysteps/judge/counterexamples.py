"""The example that a wrong function is shown with: the smallest counterexample, made from a wrong case that becomes
simpler as long as it stays wrong in the same way, and kept in a file for `replay`."""

from collections.abc import Callable, Collection, Sequence
from dataclasses import asdict, dataclass, field
from itertools import chain, islice
from pathlib import Path
from typing import ClassVar, Literal

from raysteps.common.documents import Malformed, Text, parse
from raysteps.common.errors import GraderFault, UsageError, reason
from raysteps.common.files import write_json
from raysteps.common.text import printable, shorten
from raysteps.course.manifest import Step
from raysteps.judge.answers import NumericProblem, TooLarge, TooMuchWork
from raysteps.judge.choice_sequence import Choice, Recorder
from raysteps.judge.functions import FORMER_NAMES, Case, Function, Group, functions_of, seed_of
from raysteps.judge.random_source import RandomSource
from raysteps.judge.shrink_passes import (
    Candidate,
    Change,
    ItemIndex,
    Recipe,
    changes,
    combined,
    jittered,
    live_choices,
    make,
)
from raysteps.judge.worker import Ask, JudgedCase, Reply, answers_until_trouble, judge_reply
from raysteps.results.store import CASES_FOLDER, case_path

# How long a student's program may run for the examples that a step is shown with.

_RUN_SECONDS = 2.0
_SECONDS_OF_A_HANG = 1.0  # of a function that is known to hang


@dataclass
class CpuBudget:
    """Seconds of a processor that a student's program may take for the examples of a step. What passes in the judge and
    the reference does not count, so that a busy machine shows the same examples. A program that sleeps comes to an end,
    too: `idle` is how long it may do so, or wait for a processor."""

    left: float = 8.0
    idle: float = 20.0

    def next_run(self, *, hangs: bool = False) -> float:
        most = _SECONDS_OF_A_HANG if hangs else _RUN_SECONDS
        return most if min(self.left, self.idle) > 0 else 0.0

    def spend(self, cpu_seconds: float, wall_seconds: float) -> None:
        """Of one run."""
        self.left -= cpu_seconds
        self.idle -= max(0.0, wall_seconds - cpu_seconds)


# Which of many candidates are wrong in the same way as a known case, and which of these is beyond doubt.

_JITTERS = 4
_TRIED_FOR_STABILITY = 5
_REFERENCE_SECONDS = 60.0


@dataclass(frozen=True)
class FailingCandidate:
    """A candidate that is wrong as well, and how it came from the last one."""

    candidate: Candidate
    change: Change
    judged: JudgedCase


def _silent(judged: JudgedCase) -> bool:
    return judged.outcome in ("crashed", "timeout")


def is_same_kind(one: str, other: str) -> bool:
    """Whether two problems are the same but for a number that may differ from case to case."""
    if isinstance(one, NumericProblem) and isinstance(other, NumericProblem):
        return one.kind == other.kind
    return type(one) is type(other) and one == other


def _same_way(one: JudgedCase, other: JudgedCase) -> bool:
    if one.outcome != other.outcome:
        return False
    return one.outcome == "timeout" or is_same_kind(one.verdict.problem, other.verdict.problem)


class ShrinkOracle:
    """Asks many candidates at once: one run of the student's worker and one of the reference's for each round."""

    def __init__(self, function: Function, student: Ask, reference: Ask, budget: CpuBudget) -> None:
        self._function = function
        self._student = student
        self._reference = reference
        self._budget = budget

    def wrong(
        self, found: JudgedCase, proposed: Sequence[tuple[Candidate, Change]], seconds: float
    ) -> list[FailingCandidate]:
        """Those that are wrong in the same way, the simplest first."""
        cases = [candidate.case for candidate, _ in proposed]
        replies = self._replies(cases, seconds, go_on=not _silent(found))
        answered = [i for i, reply in enumerate(replies) if reply is not None]
        expected = self._expected([cases[i] for i in answered])
        wrong = []
        for i, line in zip(answered, expected, strict=True):
            judged = self._judge(cases[i], line, replies[i])
            if judged is not None and judged.asked and _same_way(found, judged):
                wrong.append(FailingCandidate(*proposed[i], judged))
        return wrong

    def _replies(self, cases: Sequence[Case], seconds: float, *, go_on: bool) -> list[Reply | None]:
        """Simple cases come first: where the function crashes or hangs, the first such is the simplest."""
        replies: list[Reply | None] = []
        runs = 3 if go_on else 1
        while len(replies) < len(cases) and runs > 0 and seconds > 0:
            part = answers_until_trouble(self._student, cases[len(replies) :], seconds)
            self._budget.spend(part.cpu_seconds, part.wall_seconds)
            seconds, runs = self._budget.next_run(), runs - 1
            replies += part.replies
        return replies + [None] * (len(cases) - len(replies))

    def _expected(self, cases: Sequence[Case]) -> list[str]:
        """The reference's lines; empty where it has none."""
        part = answers_until_trouble(self._reference, cases, _REFERENCE_SECONDS) if cases else None
        lines = [reply.line if reply.outcome == "ok" else "" for reply in part.replies] if part else []
        return lines + [""] * (len(cases) - len(lines))

    def _judge(self, case: Case, expected: str, reply: Reply | None) -> JudgedCase | None:
        """Nothing where the reference itself fails: such a case is none."""
        try:
            return judge_reply(self._function, case, expected, reply) if reply is not None else None
        except GraderFault:
            return None

    def simplest_stable(self, wrong: Sequence[FailingCandidate]) -> FailingCandidate | None:
        """The simplest whose right answer stays the same when all numbers move a little: where it does not, correct
        methods may disagree. Kinds with exact numbers know what they do."""
        first = sorted(wrong, key=lambda one: one.candidate.complexity)[:_TRIED_FOR_STABILITY]
        if not first or self._function.by_name[first[0].candidate.case.group].exact:
            return next(iter(first), None)
        cases = [self._jittered(one.candidate.case, seed) for one in first for seed in range(_JITTERS)]
        lines = self._expected([one.candidate.case for one in first] + cases)
        for i, one in enumerate(first):
            near = range(len(first) + i * _JITTERS, len(first) + (i + 1) * _JITTERS)
            if all(self._agrees(one.candidate.case, lines[i], lines[k]) for k in near):
                return one
        return None

    def _jittered(self, case: Case, seed: int) -> Case:
        return Case(case.function, case.group, jittered(case.inputs, RandomSource(f"jitter {seed}").sign))

    def _agrees(self, case: Case, expected: str, near: str) -> bool:
        judged = self._judge(case, expected, Reply(near))
        return judged is not None and not judged.verdict.problem


_ROUNDS = 12
_ROUNDS_OF_SILENCE = 3  # where each costs a hang
_MAX = 200  # candidates in a round
_MAX_CHOICES = 8000  # of all candidates in a round together
_LEAST = 60
_TRIES = 3  # for each candidate of a round: many changes make a case that was asked before, or none
_BARREN = 3  # rounds without a simpler case
_BEST = 30  # changes that did well and are tried together


def _shape(candidate: Candidate) -> tuple[int, frozenset[ItemIndex]]:
    return len(candidate.choices), candidate.recipe.dropped


class Shrinker:
    """Goes from a wrong case to simpler ones, round by round."""

    def __init__(self, function: Function, student: Ask, reference: Ask, budget: CpuBudget) -> None:
        self._function = function
        self._oracle = ShrinkOracle(function, student, reference, budget)
        self._budget = budget

    def shrink(self, found: JudgedCase, choices: Sequence[Choice]) -> JudgedCase:
        """The simplest case that was found in a bounded number of rounds; the given one, if there is none."""
        base = make(self._function, found.case.group, Recipe(tuple(choice.value for choice in choices)))
        unclear = isinstance(found.verdict.problem, TooMuchWork | TooLarge)
        if base is None or unclear or not found.asked or base.case.line(0) != found.case.line(0):
            return found
        tried = {base.case.line(0)}
        live = set(live_choices(self._function, base))
        good: list[Change] = []
        barren = 0
        for _ in range(_ROUNDS_OF_SILENCE if found.outcome == "timeout" else _ROUNDS):
            seconds = self._budget.next_run(hangs=found.outcome == "timeout")
            proposed = self._proposed(base, live, good, tried) if seconds and barren < _BARREN else []
            if not proposed:
                break
            wrong = self._oracle.wrong(found, proposed, seconds)
            simpler = [one for one in wrong if one.candidate.complexity < base.complexity]
            best = self._oracle.simplest_stable(simpler)
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
        most = max(_LEAST, min(_MAX, _MAX_CHOICES // max(1, len(base.choices))))
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


# A single case in a file, to be asked again: cases/NN-function.json beside results.json.

SCHEMA: Literal["raysteps/case/v1"] = "raysteps/case/v1"
_MAX_BYTES = 1 << 20


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
    return UsageError(
        f"{path}: {problem}; expected a case as `check` writes it, such as {CASES_FOLDER}/02-closest-hit.json"
    )


def read_case(path: Path) -> CaseFile:
    """Anything may stand in a file that somebody names."""
    try:
        with path.open("rb") as file:
            data = file.read(_MAX_BYTES + 1)
        if len(data) > _MAX_BYTES:
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
class Counterexamples:
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
        line, name = found.case.line(1), case_path(step.number, function.name)
        case = CaseFile(SCHEMA, step.id, function.name, kind, line, str(verdict.problem), given, expected, actual)
        write_case(self.folder / name, case)
        return found, name
