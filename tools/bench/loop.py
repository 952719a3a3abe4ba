"""The command `bench loop`: from a changed file to the result of `raysteps check NN`."""

import shutil
import sys
import tempfile
from pathlib import Path

from rich.console import Console

from raysteps.common.errors import GraderFault
from raysteps.common.process import Outcome, run
from raysteps.course.manifest import Step, choose, read_steps
from raysteps.course.project import Project
from raysteps.course.stubs import without_markers
from raysteps.exports.autograders import kit_files
from raysteps.toolchain.cmake import release_tree
from tools.bench.model import LoopNumbers, LoopRow, Spread, keep
from tools.bench.programs import machine
from tools.bench.tables import terminal_table

_SECONDS = 1800
_START = "import sys; sys.path.insert(0, sys.argv.pop(1)); from raysteps.cli.app import main; sys.exit(main())"


def _copy(project: Project, root: Path) -> Project:
    """A kit of its own, so that nobody's files are changed. Its steps are the solutions."""
    for file in kit_files(project):
        target = root / file.place
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file.source, target)
    for step in read_steps(project):
        source = without_markers((project.solutions / step.path).read_text(encoding="utf-8"))
        (root / "steps" / step.path).write_text(source, encoding="utf-8")
    return Project(root)


def _check(copy: Project, step: Step) -> Outcome:
    words: list[str | Path] = [sys.executable, "-P", "-c", _START, copy.root / "grader" / "src", "check", step.number]
    outcome = run(words, seconds=_SECONDS, cwd=copy.root)
    if outcome.code != 0 or outcome.timed_out:
        raise GraderFault(f"raysteps check {step.number} failed: {(outcome.stdout + outcome.stderr)[-2000:]}")
    return outcome


def _edit(copy: Project, step: Step, number: int) -> None:
    source = copy.root / "steps" / step.path
    with source.open("a", encoding="utf-8") as file:
        file.write(f"// changed for the {number}. time\n")


def _measured(copy: Project, step: Step, rounds: int) -> LoopRow:
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
        copy = _copy(project, Path(name))
        for step in chosen:
            with console.status(f"changing and checking step {step.id}"):
                rows.append(_measured(copy, step, rounds))
        found = machine(release_tree(copy))
    table = terminal_table("from a saved file to the result of check", ("step", "median", "least", "most"))
    for row in rows:
        spread = row.seconds
        table.add_row(row.step, f"{spread.median:.2f} s", f"{spread.min:.2f} s", f"{spread.max:.2f} s")
    console.print(table)
    keep(project, LoopNumbers(machine=found, rows=rows), console)
    return 0
