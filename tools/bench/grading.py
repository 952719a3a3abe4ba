"""The commands `bench grading` and `bench loop`: what a submission costs in a class, against the plain way, measured in
turns; and how long a student waits from a changed file to the result of `raysteps check NN`."""

import os
import shutil
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.table import Table

from raysteps.common.errors import GraderFault
from raysteps.common.platform import refuse_on_windows
from raysteps.common.process import Outcome, run
from raysteps.course.manifest import Step, choose, read_steps
from raysteps.course.project import Project
from raysteps.course.settings import FILE as COURSE
from raysteps.course.settings import read_course
from raysteps.course.stubs import without_markers
from raysteps.exports.autograders import kit_files
from raysteps.report.terminal import progress
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.cmake import release_tree
from tools.bench.model import Cost, GradingNumbers, LoopNumbers, LoopRow, Spread, keep, mean_costs
from tools.bench.programs import children_seconds, machine
from tools.bench.tables import terminal_table

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


def _must(words: list[str | Path], cwd: Path) -> None:
    outcome = run(words, seconds=_SECONDS, cwd=cwd)
    if outcome.code != 0 or outcome.timed_out:
        raise GraderFault(f"{words[0]} failed: {(outcome.stdout + outcome.stderr)[-2000:]}")


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
        at_once = str(os.cpu_count() or 1)
        _must(["cmake", "--build", build, "--parallel", at_once, "--target", "raytrace-mine", *tests], root)
        _must(["ctest", "--test-dir", build, "--output-on-failure", "-R", f"^({'|'.join(tests)})$"], root)
        for step in steps:
            for case in step.images:
                picture = root / f"{step.id}-{case.name}.ppm"
                _must([build / "bin" / "raytrace-mine", root / case.scene, *case.args, "-o", picture, "--quiet"], root)


def class_of(project: Project, folder: Path, size: int) -> Path:
    for number in range(size):
        shutil.copytree(project.samples / "complete", folder / f"student-{number:03d}")
    return folder


def _class_way(project: Project, submissions: Path, out: Path, *only: str) -> None:
    jobs = str(os.cpu_count() or 1)
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
        submissions = class_of(project, Path(name) / "class", _CLASS_SIZE)
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

_LOOP_SECONDS = 1800
_START = "import sys; sys.path.insert(0, sys.argv.pop(1)); from raysteps.cli.app import main; sys.exit(main())"


def copy_with_solutions(project: Project, root: Path) -> Project:
    """A kit of its own, so that nobody's files are changed. Its steps are the solutions."""
    for file in kit_files(project):
        target = root / file.place
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file.source, target)
    for step in read_steps(project):
        source = without_markers((project.solutions / step.path).read_text(encoding="utf-8"))
        (root / "steps" / step.path).write_text(source, encoding="utf-8")
    settled = read_course(project).path
    if settled is not None:
        shutil.copy(settled, root / COURSE)
    return Project(root)


def started_in(kit: Project, *words: str | Path) -> list[str | Path]:
    """The words that start a command of that kit, with the Python that runs here."""
    return [sys.executable, "-P", "-c", _START, kit.root / "grader" / "src", *words]


def _check(copy: Project, step: Step) -> Outcome:
    outcome = run(started_in(copy, "check", step.number), seconds=_LOOP_SECONDS, cwd=copy.root)
    if outcome.code != 0 or outcome.timed_out:
        raise GraderFault(f"raysteps check {step.number} failed: {(outcome.stdout + outcome.stderr)[-2000:]}")
    return outcome


def edit(copy: Project, step: Step, number: int) -> None:
    source = copy.root / "steps" / step.path
    with source.open("a", encoding="utf-8") as file:
        file.write(f"// changed for the {number}. time\n")


def _measured_loop(copy: Project, step: Step, rounds: int) -> LoopRow:
    _check(copy, step)  # builds the kit, which is not done again for a changed step
    seconds = []
    for number in range(1, rounds + 1):
        edit(copy, step, number)
        seconds.append(_check(copy, step).seconds)
    return LoopRow(step.id, Spread.of(seconds))


def bench_loop(project: Project, steps: list[str], rounds: int, console: Console) -> int:
    """Measures, prints a table and writes build/bench/loop.json."""
    chosen = choose(read_steps(project), steps)
    rows = []
    with tempfile.TemporaryDirectory(prefix="raysteps-loop-") as name:
        copy = copy_with_solutions(project, Path(name))
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
