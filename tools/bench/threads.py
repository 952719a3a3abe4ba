"""The command `bench threads`: what more processors bring to one picture."""

import json
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import GraderFault
from raysteps.common.process import run
from raysteps.course.project import Project
from tools.bench.model import Spread, ThreadsNumbers, ThreadsRow, keep
from tools.bench.programs import Programs, accelerations, checked, default_scenes, portable
from tools.bench.tables import median, milliseconds, terminal_table

_SECONDS = 3600


@dataclass(frozen=True)
class ThreadsOptions:
    """What `bench threads` was asked for."""

    scenes: list[Path]
    size: int = 512
    rounds: int = 5


def thread_counts(cores: int) -> list[int]:
    """1, 2, 4 and so on, and all."""
    counts = [1]
    while counts[-1] * 2 < cores:
        counts.append(counts[-1] * 2)
    return counts if cores == 1 else [*counts, cores]


def _render(programs: Programs, scene: Path, accel: str, threads: int, size: int) -> tuple[float, float]:
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        stats = Path(folder) / "stats.json"
        words: list[str | Path] = [programs.raytrace, scene, "-o", Path(folder) / "picture.ppm", "--stats", stats]
        options = ["--accel", accel, "--size", f"{size}x{size}", "--threads", str(threads), "--quiet"]
        outcome = run([*words, *options], seconds=_SECONDS)
        if outcome.code != 0 or outcome.timed_out:
            raise GraderFault(f"raytrace failed: {outcome.stderr.strip()[-2000:]}")
        document = json.loads(stats.read_text(encoding="utf-8"))
        return document["render_seconds"], document["build_seconds"]


def _measured(programs: Programs, scene: Path, accel: str, options: ThreadsOptions) -> list[ThreadsRow]:
    """All counts in turns; the first round warms up."""
    counts = thread_counts(os.cpu_count() or 1)
    times: dict[int, list[tuple[float, float]]] = {count: [] for count in counts}
    for number in range(options.rounds + 1):
        for count in counts:
            taken = _render(programs, scene, accel, count, options.size)
            if number > 0:
                times[count].append(taken)
    rows = []
    alone = Spread.of([seconds for seconds, _ in times[1]]).median
    for count in counts:
        seconds = Spread.of([taken for taken, _ in times[count]])
        building = Spread.of([built for _, built in times[count]])
        rows.append(ThreadsRow(scene.stem, accel, count, seconds, building, alone / seconds.median))
    return rows


def _print(rows: list[ThreadsRow], console: Console) -> None:
    headings = ("scene", "accel", "threads", "picture", "building", "speed-up")
    table = terminal_table("one picture on several threads", headings)
    for row in rows:
        table.add_row(
            escape(row.scene),
            row.accel,
            str(row.threads),
            median(row.render_seconds, 3, " s"),
            milliseconds(row.build_seconds, 2, " ms"),
            f"{row.speed_up:.2f} x",
        )
    console.print(table)


def bench_threads(project: Project, options: ThreadsOptions, console: Console) -> int:
    """Measures, prints a table and writes build/bench/threads.json."""
    scenes = checked(options.scenes) or default_scenes(project)
    with console.status("building the benchmarks"):
        programs = portable(project)
    rows: list[ThreadsRow] = []
    for scene in scenes:
        for accel in accelerations(programs):
            with console.status(f"{escape(scene.name)} with {accel}"):
                rows += _measured(programs, scene, accel, options)
    _print(rows, console)
    keep(project, ThreadsNumbers(machine=programs.machine, rows=rows), console)
    return 0
