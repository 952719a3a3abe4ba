"""The command `bench waits`: how long a person waits, from the first picture to the grades of a class."""

import os
import re
import subprocess
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import GraderFault
from raysteps.common.platform import refuse_on_windows
from raysteps.common.process import run
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project
from raysteps.toolchain.cmake import release_tree
from tools.bench.grading import class_of, copy_with_solutions, edit, started_in
from tools.bench.model import Spread, WaitsNumbers, WaitsRow, keep
from tools.bench.programs import children_seconds, machine
from tools.bench.tables import median, terminal_table

_SECONDS = 7200
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
                outcome = run(started_in(self._kit, *words), seconds=_SECONDS, cwd=self._kit.root)
                if outcome.code != 0 or outcome.timed_out:
                    raise GraderFault(f"raysteps {words[0]} failed: {(outcome.stdout + outcome.stderr)[-2000:]}")
                clock.append(outcome.seconds)
                processor.append(children_seconds() - before)
        return WaitsRow(what, Spread.of(clock), Spread.of(processor))


@contextmanager
def _watching(kit: Project, number: str) -> Iterator[Callable[[], None]]:
    """While `watch` runs; what is yielded waits until it has said what came of the latest save."""
    words = started_in(kit, "watch", number, "--no-browser", "--quick")
    unbuffered = os.environ | {"PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(
        words, cwd=kit.root, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True, encoding="utf-8",
        env=unbuffered,
    ) as process:  # fmt: skip
        assert process.stdout is not None
        lines = process.stdout
        patience = threading.Timer(_SECONDS, process.terminate)
        patience.start()

        def wait() -> None:
            if not any(_SAID.match(line) for line in lines):
                raise GraderFault(f"raysteps watch {number} ended by itself")

        try:
            yield wait
        finally:
            patience.cancel()
            process.terminate()


def _save_to_picture(kit: Project, number: str, rounds: int) -> WaitsRow:
    step = next(step for step in read_steps(kit) if step.number == number)
    seconds = []
    with _watching(kit, number) as wait:
        wait()
        for saved in range(rounds):
            start = time.monotonic()
            edit(kit, step, saved)
            wait()
            seconds.append(time.monotonic() - start)
    return WaitsRow(f"watch {number}, from a save to tests and pictures", Spread.of(seconds), None)


@contextmanager
def _without_compiler_cache() -> Iterator[None]:
    before = os.environ.get("CCACHE_DISABLE")
    os.environ["CCACHE_DISABLE"] = "1"
    try:
        yield
    finally:
        del os.environ["CCACHE_DISABLE"]
        if before is not None:
            os.environ["CCACHE_DISABLE"] = before


def bench_waits(project: Project, options: WaitsOptions, console: Console) -> int:
    """Measures in a copy of the kit in which nothing is built, prints a table and writes build/bench/waits.json."""
    refuse_on_windows("bench waits")
    with tempfile.TemporaryDirectory(prefix="raysteps-waits-") as name:
        folder = Path(name)
        kit = copy_with_solutions(project, folder / "kit")
        typed = _Stopwatch(kit, console)
        with _without_compiler_cache():
            rows = [typed.row("demo, the first command", 1, "demo")]
        rows += [typed.row(f"`{' '.join(words)}`", options.rounds, *words) for words in _QUICK]
        for number in _WATCHED:
            with console.status(f"watching step {number}"):
                rows.append(_save_to_picture(kit, number, options.rounds))
        one = kit.samples / "complete"
        rows.append(typed.row("grade, all steps", options.rounds, "grade", one, "--out", folder / "one"))
        submissions = class_of(kit, folder / "class", options.submissions)
        words = ("grade-class", submissions, "--out", folder / "grades", "--jobs", str(os.cpu_count() or 1))
        rows.append(typed.row(f"grade-class, {options.submissions} submissions", 1, *words))
        found = machine(release_tree(kit).folder)
    table = terminal_table("how long a person waits, in seconds", ("way", "least", "median", "of processors"))
    for row in rows:
        least, usual = f"{row.seconds.min:.2f}", median(row.seconds, 2)
        table.add_row(escape(row.what), least, usual, median(row.processor_seconds, 2))
    console.print(table)
    keep(project, WaitsNumbers(machine=found, rows=rows), console)
    return 0
