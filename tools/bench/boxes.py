"""The command `bench boxes`: what boxes save, against testing every surface."""

import json
import tempfile
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from raysteps.common.errors import GraderFault, UsageError
from raysteps.course.project import Project, generated
from raysteps.report.terminal import progress
from raysteps.toolchain.build_kit import build_kit
from tools.bench.model import BoxesNumbers, BoxesRow
from tools.bench.records import keep
from tools.bench.tables import terminal_table
from tools.selftest.programs import ACCELERATIONS, render_with

_DEFAULTS = (("sphereflake", 4), ("tetrahedra", 6), ("gears", 2), ("mountain", 6))
_SECONDS = 3600


def _measure(program: Path, scene: Path, accel: str, size: str, folder: Path) -> tuple[bytes, dict[str, float]]:
    picture, stats = folder / f"{accel}.ppm", folder / f"{accel}.json"
    options = ("--step", "6", "--stats", stats)
    outcome = render_with(program, scene, accel, picture, *options, size=size, seconds=_SECONDS)
    if outcome.timed_out:
        raise GraderFault(f"{scene.name} with --accel {accel} took more than {_SECONDS} seconds")
    if outcome.code != 0:
        raise UsageError(outcome.stderr.strip())
    return picture.read_bytes(), json.loads(stats.read_text(encoding="utf-8"))


def measure_scene(program: Path, scene: Path, size: str) -> list[BoxesRow]:
    """All ways, which must give the same bytes."""
    rows: list[BoxesRow] = []
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        first = b""
        brute = 0.0
        for accel in ACCELERATIONS:
            picture, stats = _measure(program, scene, accel, size, Path(folder))
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


def _table(rows: list[BoxesRow], size: str) -> Table:
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
    missing = [str(scene) for scene in scenes if not scene.is_file()]
    if missing:
        raise UsageError(f"{missing[0]}: is not there; expected a scene")
    with console.status("starting") as status:
        program = build_kit(project, progress(console, status)).reference("raytrace")
    every = [generated(project, kind, factor) for kind, factor in _DEFAULTS] + scenes
    rows: list[BoxesRow] = []
    for scene in every:
        with console.status(f"measuring {escape(scene.name)}"):
            rows += measure_scene(program, scene, size)
    console.print(_table(rows, size))
    console.print("All ways gave the same picture, byte for byte, on every scene.")
    keep(project, BoxesNumbers(size=size, rows=rows), console)
    return 0
