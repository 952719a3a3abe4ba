"""The command `bench scale`: how building, memory and tests grow with the number of surfaces."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from rich.console import Console

from raysteps.common.errors import UsageError
from raysteps.course.project import Project
from tools.bench.model import GrowthRow, ScaleNumbers, ScaleRow, keep
from tools.bench.programs import Programs, ask, ask_pinned, listed, portable
from tools.bench.tables import median, megabytes, milliseconds, terminal_table

KINDS = ("cloud", "clusters", "terrain", "dust")
_FIT_FROM = 1000  # surfaces; below, all is in a few boxes
_ROUNDS = 3


@dataclass(frozen=True)
class ScaleOptions:
    """What `bench scale` was asked for."""

    most: int = 1_000_000
    structures: str = ""
    rounds: int = _ROUNDS


def sizes(most: int) -> list[int]:
    """100, 1000 and so on."""
    found = [100]
    while found[-1] * 10 <= most:
        found.append(found[-1] * 10)
    return found


def _measured(programs: Programs, kind: str, size: int, structure: str, rounds: int) -> ScaleRow:
    """Building on all processors; then the rays, alone on one."""
    words = ("scale", kind, str(size), structure)
    built = ask(ScaleRow, programs.bench, *words, "--rounds", str(rounds), "--size", "16", structure=structure)
    asked = ask_pinned(ScaleRow, programs.bench, *words, "--rounds", str(rounds), structure=structure)
    return replace(asked, build_seconds=built.build_seconds, peak_bytes=built.peak_bytes)


@dataclass(frozen=True)
class Growth:
    """How y grows with x: about x to the power of `exponent`, and by `per_doubling` with each doubling of x."""

    exponent: float
    per_doubling: float


def _slope(xs: Sequence[float], ys: Sequence[float]) -> float:
    middle_x, middle_y = math.fsum(xs) / len(xs), math.fsum(ys) / len(ys)
    spread = math.fsum((x - middle_x) ** 2 for x in xs)
    return math.fsum((x - middle_x) * (y - middle_y) for x, y in zip(xs, ys, strict=True)) / spread


def growth(points: Sequence[tuple[float, float]]) -> Growth:
    """Lines of least squares through at least two points: log y over log x, and y over the doublings of x."""
    doublings = [math.log2(x) for x, _ in points]
    values = [y for _, y in points]
    return Growth(_slope(doublings, [math.log2(value) for value in values]), _slope(doublings, values))


def growth_of(rows: list[ScaleRow]) -> Iterator[GrowthRow]:
    """For each structure on each kind of scene, from a thousand surfaces on."""
    for structure, scene in dict.fromkeys((row.structure, row.scene) for row in rows):
        line = [row for row in rows if (row.structure, row.scene) == (structure, scene)]
        line = [row for row in line if row.surfaces >= 0.9 * _FIT_FROM and row.tests_per_ray > 0]
        if len(line) >= 2:
            tests = growth([(row.surfaces, row.tests_per_ray) for row in line])
            time = growth([(row.surfaces, row.ns_per_ray.median) for row in line])
            yield {
                "structure": structure,
                "scene": scene,
                "from": line[0].surfaces,
                "to": line[-1].surfaces,
                "tests_exponent": tests.exponent,
                "tests_per_doubling": tests.per_doubling,
                "time_exponent": time.exponent,
            }


def _print(rows: list[ScaleRow], console: Console) -> None:
    headings = ("scene", "structure", "surfaces", "build", "structure's memory", "peak memory", "surfaces/ray",
                "boxes/ray", "ns/ray")  # fmt: skip
    table = terminal_table("how the structures grow", headings)
    for row in rows:
        table.add_row(
            row.scene,
            row.structure,
            str(row.surfaces),
            milliseconds(row.build_seconds, 2, " ms"),
            megabytes(row.bytes, unit=" MB"),
            megabytes(row.peak_bytes, 0, " MB"),
            f"{row.surface_tests_per_ray:.2f}",
            f"{row.box_tests_per_ray:.2f}",
            median(row.ns_per_ray, 0),
        )
    console.print(table)


def _print_growth(lines: list[GrowthRow], console: Console) -> None:
    for line in lines:
        console.print(
            f"{line['scene']}, {line['structure']}, {line['from']} to {line['to']} surfaces: tests grow as "
            f"N^{line['tests_exponent']:.3f}, by {line['tests_per_doubling']:.2f} with each doubling; "
            f"time as N^{line['time_exponent']:.3f}"
        )


def _chosen(programs: Programs, options: ScaleOptions) -> list[str]:
    structures = listed(programs.bench).structures
    trees = [side.name for side in structures if not side.slow and not side.foreign]
    asked = options.structures.split(",") if options.structures else trees
    for name in asked:
        if name not in [side.name for side in structures]:
            raise UsageError(f"--structures: expected names among {', '.join(trees)}, found '{name}'")
    return asked


def bench_scale(project: Project, options: ScaleOptions, console: Console) -> int:
    """Measures, prints a table and the slopes, and writes build/bench/scale.json."""
    with console.status("building the benchmarks"):
        programs = portable(project)
    rows: list[ScaleRow] = []
    for kind in KINDS:
        for structure in _chosen(programs, options):
            for size in sizes(options.most):
                with console.status(f"{kind} of {size} surfaces, {structure}"):
                    rows.append(_measured(programs, kind, size, structure, options.rounds))
    lines = list(growth_of(rows))
    _print(rows, console)
    _print_growth(lines, console)
    keep(project, ScaleNumbers(machine=programs.machine, rows=rows, growth=lines), console)
    return 0
