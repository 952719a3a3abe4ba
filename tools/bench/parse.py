"""The command `bench parse`: how fast scenes are read."""

from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.course.project import Project, generated
from tools.bench.model import ParseNumbers, ParseRow, keep
from tools.bench.programs import ask_pinned, checked, portable
from tools.bench.tables import median, quartiles, terminal_table

_LARGE = (("tetrahedra", 9), ("rings", 30), ("mountain", 9))


def bench_parse(project: Project, scenes: list[Path], rounds: int, console: Console) -> int:
    """Measures, prints a table and writes build/bench/parse.json."""
    named = checked(scenes)
    with console.status("building the benchmarks"):
        programs = portable(project)
    with console.status("making large scenes"):
        large = named or [generated(project, kind, size) for kind, size in _LARGE]
    rows: list[ParseRow] = []
    for scene in large:
        with console.status(f"reading {escape(scene.name)}"):
            words = ("parse", scene, "--rounds", str(rounds))
            rows.append(ask_pinned(ParseRow, programs.bench, *words, scene=scene.stem))
    headings = ("scene", "size", "surfaces", "speed", "quartiles")
    table = terminal_table("reading scenes, one thread, the text already in memory", headings)
    for row in rows:
        speed = row.megabytes_per_second
        table.add_row(
            escape(row.scene),
            f"{row.bytes / 1e6:.1f} MB",
            str(row.surfaces),
            median(speed, 1, " MB/s"),
            quartiles(speed, 1),
        )
    console.print(table)
    keep(project, ParseNumbers(machine=programs.machine, rows=rows), console)
    return 0
