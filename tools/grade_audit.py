"""The command `dev check`: stubs, references, mistakes and alternatives are graded, and the grades are judged."""

import random
import shutil
import tempfile
from collections.abc import Collection, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.platform import processor_count
from raysteps.course.manifest import Step, choose
from raysteps.course.mutants import read_mutants
from raysteps.course.project import Project
from raysteps.diagnosis.mutant_fingerprints import mutant_fingerprints
from raysteps.grading.pipeline import grade_submission
from raysteps.judge.plan import read_plan
from raysteps.results.model import Settings, StepResult
from raysteps.sandbox.detect import find_sandbox
from raysteps.sandbox.task import Sandbox
from raysteps.submission.load import Submission
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback
from tools.direct_grading import sandbox_of_the_kit
from tools.selftest.stamps import machine_mark
from tools.test_submissions import Entrant, alternatives, half_done, mutants, reference, stub

# Which files are handed in together. A mistake must cost its own step and no other, so every mistake is graded
# between correct neighbours, and several mistakes at once.

_RIGHT_EVERY = 4  # a step is wrong in so many rounds less one, then right


@dataclass(frozen=True)
class Round:
    """One file for each step, in order, and the steps that are graded."""

    entrants: tuple[Entrant, ...]
    graded: tuple[str, ...]


def _turns(wrong: Sequence[Entrant], right: Sequence[Entrant], at: int) -> Iterator[Entrant | None]:
    """What step number `at` hands in, round after round; none when all its files have had their turn."""
    mistakes, others, turn = list(wrong), list(right), at
    while mistakes or others:
        is_right = turn % _RIGHT_EVERY == 0 or not mistakes
        yield (others.pop(0) if others else right[turn % len(right)]) if is_right else mistakes.pop(0)
        turn += 1
    while True:
        yield None


def _with_neighbours(steps: Sequence[Step], fresh: Sequence[bool]) -> tuple[str, ...]:
    """The steps with something new, and those beside them, which must stay right."""
    near = [fresh[max(0, at - 1) : at + 2] for at in range(len(steps))]
    return tuple(step.id for step, around in zip(steps, near, strict=True) if any(around))


def rounds_of(project: Project, steps: Sequence[Step]) -> list[Round]:
    """The stubs, the references, then wrong and right files side by side until every mistake and every alternative had
    its turn."""
    every = tuple(step.id for step in steps)
    right = tuple(reference(project, step) for step in steps)
    rounds = [Round(tuple(stub(project, step) for step in steps), every), Round(right, every)]
    columns = [
        _turns([*mutants(project, step), *half_done(project, step)], alternatives(project, step) or [own], at)
        for at, (step, own) in enumerate(zip(steps, right, strict=True))
    ]
    for turn in zip(*columns, strict=True):
        if not any(turn):
            return rounds
        entrants = tuple(entrant or own for entrant, own in zip(turn, right, strict=True))
        rounds.append(Round(entrants, _with_neighbours(steps, [entrant is not None for entrant in turn])))
    raise AssertionError("the turns have no end")


def random_pairs(project: Project, steps: Sequence[Step], amount: int, seed: int) -> list[Round]:
    """Two mistakes in two different steps, and the reference everywhere else."""
    draw = random.Random(seed)  # noqa: S311 - a choice, not a secret
    every = [entrant for step in steps for entrant in mutants(project, step)]
    pairs = [(a, b) for at, a in enumerate(every) for b in every[at + 1 :] if a.step != b.step]
    found = []
    for pair in draw.sample(pairs, min(amount, len(pairs))):
        wrong = {entrant.step: entrant for entrant in pair}
        entrants = tuple(wrong.get(step.id) or reference(project, step) for step in steps)
        found.append(Round(entrants, tuple(wrong)))
    return found


# What a true grade says about a file, and what it said.


def missed(result: StepResult) -> list[str]:
    """What cost points, each with its reason."""
    found = [f"test {test.name}: {test.message}" for test in result.tests if not test.passed]
    found += [f"picture {image.name}: {image.message}" for image in result.images if not image.passed]
    found += [f"{item.kind} {item.name}: {item.message}" for item in result.hidden if not item.passed]
    return found if result.cumulative.passed else [*found, f"together: {result.cumulative.message}"]


def earned(result: StepResult) -> list[str]:
    """What gave points, or the beginning of a long list."""
    found = [f"test '{test.name}'" for test in result.tests if test.passed]
    found += [f"picture {image.name}" for image in result.images if image.earned]
    found += [f"hidden {item.kind} {item.name}" for item in result.hidden if item.share]
    return [*found[:_MAX_EARNED], *([f"{len(found) - _MAX_EARNED} more"] if len(found) > _MAX_EARNED else [])]


_MAX_EARNED = 5


@dataclass(frozen=True)
class ObservedGrade:
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
    def lost(self) -> str:
        """What cost points."""
        return "; ".join(missed(self.result))[:1000]

    @property
    def problem(self) -> str:
        """Why the points are not true; empty when they are."""
        result, kind = self.result, self.entrant.kind
        points = f"{result.points:g} of {result.max:g} points"
        if kind == "stub":
            return (
                ""
                if result.points == 0
                else f"a stub has {points}, for {', '.join(earned(result)) or 'nothing that is shown'}"
            )
        if result.status == "does-not-build":
            return f"it does not build: {' '.join(result.messages)[:300]}"
        if self.entrant.is_right:
            return "" if result.status == "passed" else f"it is right and has {points}: {self.lost}"
        band = self.entrant.band
        if band is not None:
            fair = band.low <= result.points <= band.high
            return "" if fair else f"it has {points}, and {band.low:g} to {band.high:g} are fair: {band.why}"
        return "" if result.points < result.max else "nobody notices it: it has all points"


# Grades one round: one submission made of the entrants of all steps.


def grade_round(
    kit: BuiltKit, handed_in: Round, sandbox: Sandbox, *, seed: int, only: Collection[str]
) -> list[ObservedGrade]:
    """Of the steps that the round grades, those in `only`. Nobody reads the smallest wrong cases."""
    graded = tuple(step for step in handed_in.graded if step in only)
    if not graded:
        return []
    sources = {entrant.step: entrant.source.encode() for entrant in handed_in.entrants}
    settings = Settings(seed=seed, only=graded, feedback="diagnosis")
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        submission = Submission("truth", sources, {})
        results = {
            result.id: result for result in grade_submission(kit, submission, settings, sandbox, Path(folder)).steps
        }
    return [ObservedGrade(entrant, results[entrant.step]) for entrant in handed_in.entrants if entrant.step in results]


# The table of `dev check`, and what is not as it should be.

LEAST_NAMED = 0.95  # of all mistakes
LEAST_BY_TESTS = 0.80  # of all mistakes, by the visible tests alone
LEAST_PAIRS = 0.90  # of the pairs of mistakes
IN_SANDBOX = 5  # rounds, among them the stubs and the references


@dataclass(frozen=True)
class Row:
    """What came of one step's files; one row more sums up."""

    name: str
    stub: float
    reference: float
    mutants: int
    caught: int
    by_tests: int
    by_pictures: int
    named: int
    alternatives: int
    full: int
    half_done: int
    fair: int


def row_of(name: str, seen: Sequence[ObservedGrade]) -> Row:
    """Counts each file once, however often it was handed in."""
    wrong = {one.entrant.name: one for one in seen if one.entrant.kind == "mutant"}
    half = {one.entrant.name: one for one in seen if one.entrant.kind == "half"}
    others = {one.entrant.name for one in seen if one.entrant.kind == "alternative"}
    less = {one.entrant.name for one in seen if one.entrant.kind == "alternative" and one.problem}
    return Row(
        name,
        sum(one.result.points for one in seen if one.entrant.kind == "stub"),
        min((one.result.points for one in seen if one.entrant.kind == "reference"), default=0.0),
        len(wrong),
        sum(not one.problem for one in wrong.values()),
        sum(one.tests_noticed for one in wrong.values()),
        sum(one.pictures_noticed for one in wrong.values()),
        sum(one.named for one in wrong.values()),
        len(others),
        len(others - less),
        len(half),
        sum(not one.problem for one in half.values()),
    )


def total(rows: Sequence[Row]) -> Row:
    """The sum of all steps."""
    sums = [sum(getattr(row, field) for row in rows) for field in list(Row.__dataclass_fields__)[1:]]
    return Row("all", *sums)


def table_of(rows: Sequence[Row]) -> Table:
    """One row for each step, and their sum."""
    table = Table(title="Is a grade true?", title_justify="left")
    headings = ("step", "stub", "reference", "mistakes", "caught", "by tests", "by pictures", "named", "other ways")
    for heading in (*headings, "full marks", "half-done", "fair"):
        table.add_column(heading, justify="left" if heading == "step" else "right")
    for row in [*rows, total(rows)]:
        mistakes = (row.mutants, row.caught, row.by_tests, row.by_pictures, row.named)
        others = (row.alternatives, row.full, row.half_done, row.fair)
        table.add_row(escape(row.name), f"{row.stub:g}", f"{row.reference:g}", *map(str, (*mistakes, *others)))
    return table


def problems_of(rounds: Sequence[Sequence[ObservedGrade]]) -> list[str]:
    """What is not true, each with the files that were handed in with it."""
    found = []
    for seen in rounds:
        beside = ", ".join(f"{one.entrant.step[:2]} {one.entrant.name}" for one in seen if not one.entrant.is_right)
        for one in seen:
            if one.problem:
                place = f"{one.entrant.step}: {one.entrant.kind} {one.entrant.name}"
                found.append(f"{place}: {one.problem} (wrong in this round: {beside or 'none'})")
    return list(dict.fromkeys(found))


def shortfalls(summed: Row) -> list[str]:
    """Shares that are too small."""
    found = []
    if summed.mutants and summed.named < LEAST_NAMED * summed.mutants:
        found.append(f"{summed.named} of {summed.mutants} mistakes are named, fewer than {LEAST_NAMED:.0%}")
    if summed.mutants and summed.by_tests < LEAST_BY_TESTS * summed.mutants:
        found.append(f"the visible tests notice {summed.by_tests} of {summed.mutants}, fewer than {LEAST_BY_TESTS:.0%}")
    return found


def print_notes(console: Console, seen: Sequence[ObservedGrade]) -> None:
    """The mistakes that the visible tests do not notice, and those that are called something else."""
    wrong = {(one.entrant.step, one.entrant.name): one for one in seen if one.entrant.kind == "mutant"}
    for (step, name), one in wrong.items():
        if not one.named:
            console.print(f"not named: {step} {name}; said is {one.said}", markup=False, highlight=False)
    unnoticed: dict[str, list[str]] = {}
    for (step, name), one in wrong.items():
        if not one.tests_noticed:
            unnoticed.setdefault(step, []).append(name)
    for step, names in unnoticed.items():
        console.print(f"not noticed by the visible tests: {step}: {', '.join(names)}", markup=False, highlight=False)


@dataclass(frozen=True)
class _Audit:
    """How the rounds of one check are graded."""

    kit: BuiltKit
    sandbox: Sandbox
    seed: int
    only: Collection[str]
    say: ProgressCallback

    def grade(self, rounds: Sequence[Round], what: str) -> list[list[ObservedGrade]]:
        """Several rounds at a time, each on one processor: the slowest step of one holds up no other. One more than
        there are processors, since only one of them at a time judges, which is Python."""

        def grade_one(numbered: tuple[int, Round]) -> list[ObservedGrade]:
            number, handed_in = numbered
            self.say(f"{what} {number} of {len(rounds)}")
            return grade_round(self.kit, handed_in, self.sandbox, seed=self.seed, only=self.only)

        with ThreadPoolExecutor(processor_count() + 1) as pool:
            return list(pool.map(grade_one, enumerate(rounds, start=1)))


def _differs_in_the_sandbox(
    audit: _Audit, rounds: Sequence[Round], graded: Sequence[Sequence[ObservedGrade]], amount: int
) -> list[str]:
    """The first rounds and some others again, as submissions are graded: each step in a box of its own, in the sandbox
    that they get. What comes of it must be the same."""
    others = range(2, len(rounds))
    draw = random.Random(audit.seed)  # noqa: S311 - a choice, not a secret
    chosen = [0, 1, *draw.sample(others, len(others))][:amount]
    again = audit.grade([rounds[at] for at in chosen], "in the sandbox")
    return [
        f"{kept.entrant.step}: {kept.entrant.name}: {kept.result.points:g} points in the sandbox ({kept.lost}), "
        f"{one.result.points:g} without ({one.lost})"
        for at, seen in zip(chosen, again, strict=True)
        for one, kept in zip(graded[at], seen, strict=True)
        if one.result.points != kept.result.points
    ]


def _pairs(audit: _Audit, amount: int, console: Console) -> list[str]:
    """Two mistakes at a time: both must be named."""
    steps = [step for step in audit.kit.steps if step.id in audit.only]
    graded = audit.grade(random_pairs(audit.kit.project, steps, amount, audit.seed), "pair")
    both = [seen for seen in graded if all(one.named for one in seen)]
    named = f"{len(both)} of {len(graded)} random pairs of mistakes in two steps have both named"
    console.print(f"{named} (seed {audit.seed})")
    for seen in graded:
        for one in seen:
            if not one.named:
                beside = " and ".join(f"{other.entrant.step[:2]} {other.entrant.name}" for other in seen)
                console.print(f"pair {beside}: {one.entrant.name} is called {one.said}", markup=False, highlight=False)
    if len(both) < LEAST_PAIRS * len(graded):
        return [f"both are named in {len(both)} of {len(graded)} pairs, fewer than {LEAST_PAIRS:.0%}"]
    return []


def _answers(project: Project) -> Path:
    return project.build / "truth"


def forget_answers(project: Project) -> None:
    """What the kit's programs answered in earlier checks."""
    shutil.rmtree(_answers(project), ignore_errors=True)


def check_truth(
    project: Project,
    console: Console,
    say: ProgressCallback,
    *,
    only: Sequence[str] = (),
    pairs: int = 0,
    seed: int = 1,
    in_sandbox: int = IN_SANDBOX,
) -> int:
    """Prints the table and what is wrong; 1 when something is. All that is handed in is the kit's own, so nothing has
    to be kept from it; `in_sandbox` rounds are graded as submissions are, too."""
    strict = build_kit(project, say, of_all_parts=True)
    kit = strict.in_one_process()
    chosen = [step.id for step in choose(kit.steps, list(only))]
    sandbox = sandbox_of_the_kit(_answers(project), f"{machine_mark()} {kit.description.compiler_version}")
    for step in kit.steps:
        if step.id in chosen:  # before anybody is graded, and with what is run again for the grades
            mutant_fingerprints(kit, step, read_plan(project, step), read_mutants(project, step), say, sandbox)
    handed_in = rounds_of(project, kit.steps)
    audit = _Audit(kit, sandbox, seed, chosen, say)
    rounds = audit.grade(handed_in, "round")
    rows = [row_of(step, [one for seen in rounds for one in seen if one.entrant.step == step]) for step in chosen]
    every = [one for seen in rounds for one in seen]
    console.print(table_of(rows))
    print_notes(console, every)
    problems = problems_of(rounds) + shortfalls(total(rows))
    boxed = replace(audit, kit=strict, sandbox=find_sandbox())
    problems += _differs_in_the_sandbox(boxed, handed_in, rounds, in_sandbox)
    if pairs:
        problems += _pairs(audit, pairs, console)
    for problem in problems:
        console.print(f"not true: {problem}", markup=False, highlight=False)
    if len(chosen) == len(kit.steps):
        sandbox.forget_unused()
    console.print(f"{len(rounds)} rounds graded with seed {seed}; {len(problems) or 'no'} problems")
    return 1 if problems else 0
