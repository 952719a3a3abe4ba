"""The commands `bench grading`, `bench loop` and `bench waits`: what a submission costs in a class, against the plain
way, measured in turns; how long a student waits from a changed file to the result of `raysteps check NN`, and a person
for all else."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.errors import GraderFault
from raysteps.common.platform import processor_count, refuse_on_windows
from raysteps.common.process import Outcome, run
from raysteps.course.manifest import Step, choose, read_steps
from raysteps.course.mutants import reference_source
from raysteps.course.project import Project
from raysteps.course.settings import FILE as COURSE
from raysteps.course.settings import read_course
from raysteps.exports.autograders import kit_files
from raysteps.report.terminal import progress
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.cmake import release_tree
from tools.bench.model import (
    Cost,
    GradingNumbers,
    LoopNumbers,
    LoopRow,
    Spread,
    WaitsNumbers,
    WaitsRow,
    keep,
    mean_costs,
)
from tools.bench.programs import children_seconds, machine, variable
from tools.bench.tables import median, terminal_table

_SECONDS = 3600
_CLASS_SIZE = 8
_PLAIN = "plain"
_VERSION = "grader/src/raysteps/__init__.py"
_PARTS = ("CMakeLists.txt", "CMakePresets.json", "cmake", "framework", "scenes", "solutions", "steps", _VERSION)


def _measure(way: str, number: int, submissions: int, work: Callable[[], None]) -> Cost:
    start, used = time.monotonic(), children_seconds()
    work()
    seconds, processor = time.monotonic() - start, children_seconds() - used
    return Cost(way, number, submissions, round(seconds / submissions, 2), round(processor / submissions, 2))


def _must(words: list[str | Path], cwd: Path, name: str = "") -> Outcome:
    """Runs it; messages call it by its first word, where it has no name."""
    outcome = run(words, seconds=_SECONDS, cwd=cwd)
    if outcome.code != 0 or outcome.timed_out:
        raise GraderFault(f"{name or words[0]} failed: {(outcome.stdout + outcome.stderr)[-2000:]}")
    return outcome


def plain_way(project: Project, steps: list[Step], submission: Path) -> None:
    """What one does without a grader: a fresh copy of the kit with the student's files in it, configured, built,
    tested and rendered."""
    with tempfile.TemporaryDirectory(prefix="raysteps-plain-") as name:
        root = Path(name)
        for part in _PARTS:
            source = project.root / part
            (root / part).parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if source.is_dir() else shutil.copyfile)(source, root / part)
        for step in steps:
            shutil.copyfile(submission / "steps" / step.path, root / "steps" / step.path)
        build = root / "build"
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        _must(["cmake", "-S", root, "-B", build, *generator], root)
        tests = [f"test-isolated-{step.number}" for step in steps]
        at_once = str(processor_count())
        _must(["cmake", "--build", build, "--parallel", at_once, "--target", "raytrace-mine", *tests], root)
        _must(["ctest", "--test-dir", build, "--output-on-failure", "-R", f"^({'|'.join(tests)})$"], root)
        for step in steps:
            for case in step.images:
                picture = root / f"{step.id}-{case.name}.ppm"
                _must([build / "bin" / "raytrace-mine", root / case.scene, *case.args, "-o", picture, "--quiet"], root)


def _class_of(project: Project, folder: Path, size: int) -> Path:
    for number in range(size):
        shutil.copytree(project.samples / "complete", folder / f"student-{number:03d}")
    return folder


def _class_way(project: Project, submissions: Path, out: Path, *only: str) -> None:
    jobs = str(processor_count())
    words: list[str | Path] = [sys.executable, "-P", "-m", "raysteps", "grade-class", submissions, "--out", out]
    _must([*words, "--jobs", jobs, *(["--only", *only] if only else [])], project.root)


def _table(costs: list[Cost]) -> Table:
    headings = ("way", "runs", "seconds", "CPU seconds", "CPU against plain")
    table = terminal_table("one complete submission", headings)
    means = mean_costs(costs)
    plain = next(mean.cpu_seconds for mean in means if mean.way == _PLAIN)
    for mean in means:
        label = mean.way if mean.way == _PLAIN else f"{mean.way}, class of {mean.submissions}"
        against = f"1/{plain / mean.cpu_seconds:.1f}"
        table.add_row(label, str(mean.runs), f"{mean.seconds:.2f}", f"{mean.cpu_seconds:.2f}", against)
    return table


def grading(project: Project, rounds: int, console: Console) -> int:
    """Measures the plain way, a class, and a class of each step alone, in turns; prints one table and writes
    build/bench/grading.json."""
    refuse_on_windows("bench grading")
    steps = read_steps(project)
    with console.status("starting") as status:  # both runs of a class share it
        kit = build_kit(project, progress(console, status))
    costs: list[Cost] = []
    with tempfile.TemporaryDirectory(prefix="raysteps-bench-") as name:
        submissions = _class_of(project, Path(name) / "class", _CLASS_SIZE)
        for number in range(rounds):
            with console.status(f"round {number + 1} of {rounds}"):
                plain = partial(plain_way, project, steps, project.samples / "complete")
                costs.append(_measure(_PLAIN, number, 1, plain))
                out = Path(name) / f"out-{number}"
                together = partial(_class_way, project, submissions, out)
                costs.append(_measure("all steps", number, _CLASS_SIZE, together))
                for step in steps:
                    alone = partial(_class_way, project, submissions, out / step.number, step.number)
                    costs.append(_measure(f"step {step.number}", number, _CLASS_SIZE, alone))
    console.print(_table(costs))
    keep(project, GradingNumbers(machine=machine(kit.folder), costs=costs), console)
    return 0


# From a changed file to the result.

_START = "import sys; sys.path.insert(0, sys.argv.pop(1)); from raysteps.cli.app import main; sys.exit(main())"


def _copy_with_solutions(project: Project, root: Path) -> Project:
    """A kit of its own, so that nobody's files are changed. Its steps are the solutions."""
    for file in kit_files(project):
        target = root / file.place
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file.source, target)
    for step in read_steps(project):
        (root / "steps" / step.path).write_text(reference_source(project, step), encoding="utf-8")
    settled = read_course(project).path
    if settled is not None:
        shutil.copy(settled, root / COURSE)
    return Project(root)


def _started_in(kit: Project, *words: str | Path) -> list[str | Path]:
    """The words that start a command of that kit, with the Python that runs here."""
    return [sys.executable, "-P", "-c", _START, kit.root / "grader" / "src", *words]


def _check(copy: Project, step: Step) -> Outcome:
    return _must(_started_in(copy, "check", step.number), copy.root, f"raysteps check {step.number}")


def _edit(copy: Project, step: Step, number: int) -> None:
    source = copy.root / "steps" / step.path
    with source.open("a", encoding="utf-8") as file:
        file.write(f"// changed for the {number}. time\n")


def _measured_loop(copy: Project, step: Step, rounds: int) -> LoopRow:
    _check(copy, step)  # builds the kit, which is not done again for a changed step
    seconds = []
    for number in range(1, rounds + 1):
        _edit(copy, step, number)
        seconds.append(_check(copy, step).seconds)
    return LoopRow(step.id, Spread.of(seconds))


def bench_loop(project: Project, steps: list[str], rounds: int, console: Console) -> int:
    """Measures, prints a table and writes build/bench/loop.json."""
    chosen = choose(read_steps(project), steps)
    rows = []
    with tempfile.TemporaryDirectory(prefix="raysteps-loop-") as name:
        copy = _copy_with_solutions(project, Path(name))
        for step in chosen:
            with console.status(f"changing and checking step {step.id}"):
                rows.append(_measured_loop(copy, step, rounds))
        found = machine(release_tree(copy).folder)
    table = terminal_table("from a saved file to the result of check", ("step", "median", "least", "most"))
    for row in rows:
        spread = row.seconds
        table.add_row(row.step, f"{spread.median:.2f} s", f"{spread.min:.2f} s", f"{spread.max:.2f} s")
    console.print(table)
    keep(project, LoopNumbers(machine=found, rows=rows), console)
    return 0


# The command `bench waits`: how long a person waits, from the first picture to the grades of a class.

_WAITS_SECONDS = 7200
_QUICK = (("--help",), ("list",), ("next",), ("hint", "01"))
_WATCHED = ("01", "06")
_SAID = re.compile(r"^[✓✗]")  # what `watch` found out of a save


@dataclass(frozen=True)
class WaitsOptions:
    """What `bench waits` was asked for."""

    rounds: int
    submissions: int  # of the class


class _Stopwatch:
    """Commands of a kit, typed once or several times."""

    def __init__(self, kit: Project, console: Console) -> None:
        self._kit, self._console = kit, console

    def row(self, what: str, rounds: int, *words: str | Path) -> WaitsRow:
        clock, processor = [], []
        with self._console.status(escape(what)):
            for _ in range(rounds):
                before = children_seconds()
                outcome = _must(_started_in(self._kit, *words), self._kit.root, f"raysteps {words[0]}")
                clock.append(outcome.seconds)
                processor.append(children_seconds() - before)
        return WaitsRow(what, Spread.of(clock), Spread.of(processor))


@contextmanager
def _watching(kit: Project, number: str) -> Iterator[Callable[[], None]]:
    """While `watch` runs; what is yielded waits until it has said what came of the latest save."""
    words = _started_in(kit, "watch", number, "--no-browser", "--quick")
    unbuffered = os.environ | {"PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(
        words, cwd=kit.root, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, encoding="utf-8",
        env=unbuffered,
    ) as process:  # fmt: skip
        assert process.stdout is not None
        lines = process.stdout
        timeout = threading.Timer(_WAITS_SECONDS, process.terminate)
        timeout.start()

        def wait() -> None:
            if not any(_SAID.match(line) for line in lines):
                raise GraderFault(f"raysteps watch {number} ended by itself")

        try:
            yield wait
        finally:
            timeout.cancel()
            process.terminate()


def _save_to_picture(kit: Project, number: str, rounds: int) -> WaitsRow:
    step = next(step for step in read_steps(kit) if step.number == number)
    seconds = []
    with _watching(kit, number) as wait:
        wait()
        for saved in range(rounds):
            start = time.monotonic()
            _edit(kit, step, saved)
            wait()
            seconds.append(time.monotonic() - start)
    return WaitsRow(f"watch {number}, from a save to tests and pictures", Spread.of(seconds), None)


def bench_waits(project: Project, options: WaitsOptions, console: Console) -> int:
    """Measures in a copy of the kit in which nothing is built, prints a table and writes build/bench/waits.json."""
    refuse_on_windows("bench waits")
    with tempfile.TemporaryDirectory(prefix="raysteps-waits-") as name:
        folder = Path(name)
        kit = _copy_with_solutions(project, folder / "kit")
        typed = _Stopwatch(kit, console)
        with variable("CCACHE_DISABLE", "1"):
            rows = [typed.row("demo, the first command", 1, "demo")]
        rows += [typed.row(f"`{' '.join(words)}`", options.rounds, *words) for words in _QUICK]
        for number in _WATCHED:
            with console.status(f"watching step {number}"):
                rows.append(_save_to_picture(kit, number, options.rounds))
        one = kit.samples / "complete"
        rows.append(typed.row("grade, all steps", options.rounds, "grade", one, "--out", folder / "one"))
        submissions = _class_of(kit, folder / "class", options.submissions)
        words = ("grade-class", submissions, "--out", folder / "grades", "--jobs", str(processor_count()))
        rows.append(typed.row(f"grade-class, {options.submissions} submissions", 1, *words))
        found = machine(release_tree(kit).folder)
    table = terminal_table("how long a person waits, in seconds", ("way", "least", "median", "of processors"))
    for row in rows:
        least, usual = f"{row.seconds.min:.2f}", median(row.seconds, 2)
        table.add_row(escape(row.what), least, usual, median(row.processor_seconds, 2))
    console.print(table)
    keep(project, WaitsNumbers(machine=found, rows=rows), console)
    return 0
