"""The commands `bench boxes` and `bench threads`: whole pictures, by what raytrace says of them with --stats."""

import json
import tempfile
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.platform import processor_count
from raysteps.course.project import Project, generated
from raysteps.report.terminal import progress
from raysteps.toolchain.build_kit import build_kit
from tools.bench.model import BoxesNumbers, BoxesRow, Spread, ThreadsNumbers, ThreadsRow, keep
from tools.bench.programs import Programs, accelerations, checked, default_scenes, portable
from tools.bench.tables import median, milliseconds, terminal_table
from tools.selftest.programs import ACCELERATIONS, render_with

_SECONDS = 3600


def _rendered(
    program: Path, scene: Path, accel: str, size: str, *options: str | Path
) -> tuple[bytes, dict[str, float]]:
    """The picture, and what raytrace says of it."""
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        picture, stats = Path(folder) / "picture.ppm", Path(folder) / "stats.json"
        words = ("--stats", stats, *options)
        outcome = render_with(program, scene, accel, picture, *words, size=size, seconds=_SECONDS)
        if outcome.timed_out:
            raise GraderFault(f"{scene.name} with --accel {accel} took more than {_SECONDS} seconds")
        if outcome.code != 0:
            raise UsageError(outcome.stderr.strip())
        return picture.read_bytes(), json.loads(stats.read_text(encoding="utf-8"))


# What more processors bring to one picture.


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


def _in_turns(programs: Programs, scene: Path, accel: str, options: ThreadsOptions) -> list[ThreadsRow]:
    """All counts in turns; the first round warms up."""
    counts, size = thread_counts(processor_count()), f"{options.size}x{options.size}"
    times: dict[int, list[tuple[float, float]]] = {count: [] for count in counts}
    for number in range(options.rounds + 1):
        for count in counts:
            _, stats = _rendered(programs.raytrace, scene, accel, size, "--threads", str(count))
            if number > 0:
                times[count].append((stats["render_seconds"], stats["build_seconds"]))
    rows = []
    alone = Spread.of([seconds for seconds, _ in times[1]]).median
    for count in counts:
        seconds = Spread.of([taken for taken, _ in times[count]])
        building = Spread.of([built for _, built in times[count]])
        rows.append(ThreadsRow(scene.stem, accel, count, seconds, building, alone / seconds.median))
    return rows


def _print_threads(rows: list[ThreadsRow], console: Console) -> None:
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
                rows += _in_turns(programs, scene, accel, options)
    _print_threads(rows, console)
    keep(project, ThreadsNumbers(machine=programs.machine, rows=rows), console)
    return 0


# What boxes save, against testing every surface.

_DEFAULTS = (("sphereflake", 4), ("tetrahedra", 6), ("gears", 2), ("mountain", 6))


def measure_scene(program: Path, scene: Path, size: str) -> list[BoxesRow]:
    """All ways, which must give the same bytes."""
    rows: list[BoxesRow] = []
    first, brute = b"", 0.0
    for accel in ACCELERATIONS:
        picture, stats = _rendered(program, scene, accel, size, "--step", "6")
        seconds = max(stats["build_seconds"] + stats["render_seconds"], 1e-6)
        first, brute = first or picture, brute or seconds
        if picture != first:
            raise GraderFault(f"{scene.name}: --accel {accel} gives another picture than --accel none")
        rows.append(
            BoxesRow(
                scene.stem,
                accel,
                int(stats["surfaces"]),
                stats["share_tested"],
                stats["tests_per_ray"],
                round(seconds, 4),
                round(1 - seconds / brute, 4),
                round(brute / seconds, 2),
            )
        )
    return rows


def _boxes_table(rows: list[BoxesRow], size: str) -> Table:
    headings = ("scene", "objects", "accel", "objects tested", "tests per ray", "time", "saved", "speed-up")
    table = terminal_table(f"{size}, step 6, one ray per pixel and its shadow and mirror rays", headings)
    for row in rows:
        table.add_row(
            escape(row.scene) if row.accel == "none" else "",
            str(row.objects) if row.accel == "none" else "",
            row.accel,
            f"{row.share_tested:.3%}",
            f"{row.tests_per_ray:.1f}",
            f"{row.seconds:.3f} s",
            f"{row.time_saved:.1%}",
            f"{row.speed_up:.1f} x",
            end_section=row.accel == ACCELERATIONS[-1],
        )
    return table


def boxes(project: Project, scenes: list[Path], size: str, console: Console) -> int:
    """Measures, prints one table and writes build/bench/boxes.json."""
    checked(scenes)
    with console.status("starting") as status:
        program = build_kit(project, progress(console, status)).reference("raytrace")
    every = [generated(project, kind, factor) for kind, factor in _DEFAULTS] + scenes
    rows: list[BoxesRow] = []
    for scene in every:
        with console.status(f"measuring {escape(scene.name)}"):
            rows += measure_scene(program, scene, size)
    console.print(_boxes_table(rows, size))
    console.print("All ways gave the same picture, byte for byte, on every scene.")
    keep(project, BoxesNumbers(size=size, rows=rows), console)
    return 0
