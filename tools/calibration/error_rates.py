"""The command `dev errors`: how often the judge calls a right solution wrong, and how often it finds a planted bias.

Only the hidden cases are asked, since all that is left to chance is among them; by programs that load the step, since
nothing here is strange code. No answer is kept from one seed to the next."""

import math
import os
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_if_changed
from raysteps.common.platform import processor_count
from raysteps.common.text import print_plain
from raysteps.course.manifest import Step, choose, kit_steps
from raysteps.course.mutants import reference_source, replaced_once
from raysteps.course.project import Project
from raysteps.judge.hidden_tests import make_cases, run_hidden_tests
from raysteps.judge.plan import Plan, read_plan
from raysteps.judge.worker import Ask, ask_student, uncached_reference_answers
from raysteps.results.model import HiddenResult
from raysteps.sandbox.task import Sandbox, TaskResult
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.compile import StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback
from raysteps.toolchain.limits import limits_of
from tools.bench.docs import replace_part
from tools.bench.tables import markdown
from tools.direct_grading import plain_sandbox
from tools.test_submissions import right_ones

FACTORS = (1.01, 1.02, 1.05)
_SECONDS = 120.0  # of a processor, for one function


@dataclass(frozen=True)
class PlantedBias:
    """A place of a reference where what is estimated is made larger by a factor."""

    number: str
    function: str
    find: str
    put: str

    def applied(self, source: str, factor: float) -> str:
        return replaced_once(source, self.find, self.put.replace("FACTOR", f"{factor:g}F"), self.function)


PLANTED = (
    PlantedBias("12", "sampled_light", "return radiance * hit", "return FACTOR * radiance * hit"),
    PlantedBias("12", "sample_sphere", "1.0F / (2.0F * k_pi * height)}", "1.0F / (FACTOR * 2.0F * k_pi * height)}"),
    PlantedBias("13", "path_light", "Color weight = k_white;", "Color weight(FACTOR);"),
    PlantedBias("14", "scatter_metal", ".weight = fresnel * seen", ".weight = FACTOR * fresnel * seen"),
    PlantedBias("14", "scatter_glass", ".weight = Color(weight)", ".weight = Color(FACTOR * weight)"),
    PlantedBias("15", "mis_path_light", "Color weight = k_white;", "Color weight(FACTOR);"),
)


def averages_of(step: Step, plan: Plan, seed: int) -> set[tuple[str, str]]:
    """Functions and kinds of cases that ask for a mean to some precision, and for nothing exact."""
    cases = [case for function in plan.functions for case in make_cases(step, function, seed)]
    return {(case.function, case.group) for case in cases if "precision" in case.inputs}


@dataclass
class Tally:
    """What became of the grades of one file, or of several right ones."""

    grades: int = 0
    wrong: int = 0
    by_averages: int = 0  # those that the averages alone call wrong
    first: str = ""  # why one was wrong

    def add(self, seed: int, whose: str, results: Sequence[HiddenResult], averages: set[tuple[str, str]]) -> None:
        short = [result for result in results if result.share < 1]
        kinds = {(result.name, group.name) for result in short for group in result.groups if group.share < 1}
        self.grades += 1
        self.wrong += bool(short)
        self.by_averages += bool(kinds & averages)
        if short and not self.first:
            self.first = f"{whose}, seed {seed}: {short[0].message}"


@dataclass
class StepRates:
    """Of one step. `planted`: by function and factor."""

    step: Step
    has_averages: bool = False
    right: Tally = field(default_factory=Tally)
    solutions: int = 0
    planted: dict[tuple[str, float], Tally] = field(default_factory=dict)


class _Files:
    """The right solutions and the biased references of a step, built once."""

    def __init__(self, kit: BuiltKit, sandbox: Sandbox, step: Step, folder: Path) -> None:
        plan = read_plan(kit.project, step)
        if plan is None:
            raise GraderFault(f"{step.id}: has no cases.toml")
        self.plan, self.step = plan, step
        self._kit, self._sandbox, self._folder = kit, sandbox, folder
        others = [one for one in right_ones(kit.project, step) if one.kind != "reference"]
        self.right = {one.name: self._ask(one.source) for one in others}
        source = reference_source(kit.project, step)
        self.planted = {
            (planted.function, factor): self._ask(planted.applied(source, factor))
            for planted in PLANTED
            if planted.number == step.number
            for factor in FACTORS
        }

    def _ask(self, source: str) -> Ask:
        limits = limits_of(self.step, {"seconds": _SECONDS})
        place = Path(tempfile.mkdtemp(dir=self._folder))
        build = StudentBuild(self._kit.in_one_process(), self._sandbox, place)
        compiled = build.compile(self.step, source.encode(), limits)
        if compiled.binary is None:
            raise GraderFault(f"{self.step.id}: does not build: {compiled.ran.outcome.stderr[:2000]}")
        program, ran = build.program("worker", self.step, {self.step.number: compiled.binary}, limits)
        if program is None:
            raise GraderFault(f"{self.step.id}: does not link: {ran.outcome.stderr[:2000] if ran else ''}")
        return ask_student(self._sandbox, program, limits)

    def grade(self, ask: Ask, reference: Ask, seed: int) -> list[HiddenResult]:
        return run_hidden_tests(self.step, self.plan, ask, reference, seed, _SECONDS)


def _once(kit: BuiltKit) -> Ask:
    """The reference, which answers a question of one seed once, however many files are compared with it."""
    known: dict[bytes, TaskResult] = {}

    def ask(cases: bytes, _: float) -> TaskResult:
        if cases not in known:
            known[cases] = uncached_reference_answers(kit, cases)
        return known[cases]

    return ask


def grade_seed(files: _Files, kit: BuiltKit, seed: int, rates: StepRates, *, planted: bool) -> None:
    """All right solutions with one seed, and the biased ones where they are asked for."""
    averages = averages_of(files.step, files.plan, seed)
    rates.has_averages = bool(averages)
    reference = _once(kit)
    for name, ask in {"the reference": reference, **files.right}.items():
        rates.right.add(seed, name, files.grade(ask, reference, seed), averages)
    for key, ask in files.planted.items() if planted else ():
        tally = rates.planted.setdefault(key, Tally())
        tally.add(seed, f"{key[0]} times {key[1]:g}", files.grade(ask, reference, seed), averages)


def _share(tally: Tally | None, has_averages: bool) -> str:
    if tally is None:
        return ""
    alone = f" ({tally.by_averages})" if has_averages else ""
    return f"{tally.wrong}{alone} of {tally.grades}"


def rows_of(all_rates: Sequence[StepRates]) -> Iterator[tuple[str, ...]]:
    """One for each step, and one for each planted bias."""
    for rates in all_rates:
        right = rates.right
        yield (rates.step.id, f"{rates.solutions} right solutions", f"{right.wrong} of {right.grades}", "", "", "")
        for function in dict.fromkeys(name for name, _ in rates.planted):
            found = [_share(rates.planted.get((function, factor)), rates.has_averages) for factor in FACTORS]
            yield ("", f"the reference, `{function}` biased", "", *found)


HEADINGS = ("step", "way", "called wrong", *(f"found at {100 * (factor - 1):.0f} %" for factor in FACTORS))


def _print(all_rates: Sequence[StepRates], seconds: float, console: Console) -> None:
    table = Table(title=f"hidden cases with fresh seeds, {seconds:.0f} s", title_justify="left")
    for heading in HEADINGS:
        table.add_column(heading)
    for row in rows_of(all_rates):
        table.add_row(*map(escape, row))
    console.print(table)
    for rates in all_rates:
        if rates.right.wrong:
            print_plain(console, f"{rates.step.id}: {rates.right.first}")
        for tally in rates.planted.values():
            if tally.wrong < tally.grades:
                console.print(f"{rates.step.id}: a planted bias was not found in every grade", soft_wrap=True)


def _write(project: Project, all_rates: Sequence[StepRates], seed: int) -> None:
    path = project.root / "docs" / "judge.md"
    grades = sum(rates.right.grades for rates in all_rates)
    words = f"{grades} grades of right solutions, seeds from {seed} on."
    page = replace_part(
        path.read_text(encoding="utf-8"),
        "errors",
        f"{words}\n\n{markdown(HEADINGS, rows_of(all_rates))}",
        path.name,
    )
    write_if_changed(path, page.encode())


@dataclass(frozen=True)
class ErrorOptions:
    """What `dev errors` was asked for."""

    grades: int = 120  # of right solutions, over all steps
    planted: int = 1  # seeds with which the biased files are graded
    seed: int = 1_000_001  # the first one
    minutes: float = math.inf  # after which no further seed is begun
    only: tuple[str, ...] = ()
    docs: bool = False


def measure(
    kit: BuiltKit, steps: Sequence[Step], sandbox: Sandbox, options: ErrorOptions, say: ProgressCallback
) -> Iterator[list[StepRates]]:
    """Seed by seed, all steps in turns, so that all get about as many grades; what is known after each seed."""
    with tempfile.TemporaryDirectory(prefix="raysteps-errors-") as folder:
        files = []
        for step in steps:
            say(f"building the files of step {step.number}")
            files.append(_Files(kit, sandbox, step, Path(folder)))
        all_rates = [StepRates(one.step, solutions=1 + len(one.right)) for one in files]
        seed, end = options.seed, time.monotonic() + 60 * options.minutes
        while (done := sum(rates.right.grades for rates in all_rates)) < options.grades and time.monotonic() < end:
            say(f"graded {done} of {options.grades}")
            os.utime(kit.folder)  # kits that were not used for long are deleted when another one is built
            planted = seed - options.seed < options.planted

            def one(pair: tuple[_Files, StepRates], seed: int = seed, planted: bool = planted) -> None:
                grade_seed(pair[0], kit, seed, pair[1], planted=planted)

            with ThreadPoolExecutor(processor_count()) as pool:
                list(pool.map(one, zip(files, all_rates, strict=True)))
            seed += 1
            yield all_rates


def errors(project: Project, options: ErrorOptions, console: Console, say: ProgressCallback) -> int:
    """Measures and prints; 1 when a right solution was called wrong."""
    if options.grades < 1:
        raise UsageError(f"--grades {options.grades}: expected 1 or more")
    chosen = choose(kit_steps(project), options.only)
    steps = [step for step in chosen if step.is_in_part_two]
    if len(steps) < len(chosen) and options.only:
        exact = next(step for step in chosen if step not in steps)
        raise UsageError(f"--only {exact.number}: nothing of its grade is left to chance; expected steps of part two")
    if not steps:
        raise UsageError("nothing of a grade is left to chance here; expected a kit that has part two")
    start = time.monotonic()
    all_rates: list[StepRates] = []
    for all_rates in measure(build_kit(project, say, of_all_parts=True), steps, plain_sandbox(), options, say):
        if options.docs:  # each time: who stops it keeps what is known
            _write(project, all_rates, options.seed)
    _print(all_rates, time.monotonic() - start, console)
    wrong = sum(rates.right.wrong for rates in all_rates)
    print(
        f"{wrong} of {sum(rates.right.grades for rates in all_rates)} grades of right solutions are false", flush=True
    )
    return 1 if wrong else 0
