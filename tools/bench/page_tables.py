"""The tables of docs/benchmarks.md, as Markdown."""

from collections.abc import Iterable
from textwrap import fill

from tools.bench.model import (
    BoxesNumbers,
    BuildRays,
    GradingNumbers,
    LoopNumbers,
    Machine,
    ParseNumbers,
    PovrayRow,
    RenderNumbers,
    ScaleNumbers,
    SceneRays,
    ThreadsNumbers,
    mean_costs,
)
from tools.bench.render import COMPARED, PEER, against_povray, all_against_embree, faster, median_of
from tools.bench.tables import counted, markdown, median, megabytes, milliseconds, ratio, spread


def machine_line(machine: Machine) -> str:
    """What was measured on."""
    pinned = "pinned to one processor where one thread is measured" if machine.pinned else "not pinned"
    cores = f"{machine.cores} core{'s' if machine.cores > 1 else ''}"
    return f"{machine.processor}, {cores}, {machine.system}; {machine.compiler} {machine.flags}; {pinned}."


def _sides(scene: SceneRays) -> Iterable[list[str]]:
    peer = median_of(scene, PEER)
    for side in scene.structures:
        yield [
            f"{scene.scene} ({scene.surfaces})",
            side.name,
            spread(side.ns_per_ray, 0),
            ratio(side.ns_per_ray.median, peer),
            spread(side.picture_seconds, 3),
            milliseconds(side.build_seconds, 1),
            megabytes(side.bytes),
            counted(side.surface_tests_per_ray, 1),
            counted(side.box_tests_per_ray, 1),
        ]


def _one_build(build: BuildRays) -> str:
    scenes = build.scenes
    headings = ("scene (surfaces)", "structure", "ns/ray (quartiles)", "to Embree", "picture, s", "build, ms",
                "memory, MB", "surfaces/ray", "boxes/ray")  # fmt: skip
    table = markdown(headings, [row for scene in scenes for row in _sides(scene)])
    mean_rows = [(name, f"{mean:.2f}") for name, mean in all_against_embree(scenes)]
    means_table = markdown(("structure", "time of a ray against Embree's, geometric mean"), mean_rows)
    machine = fill(f"**The {build.build} build.** {machine_line(build.machine)}", 120, break_on_hyphens=False)
    lines = [machine, table]
    return "\n\n".join([*lines, means_table] if mean_rows else lines)


def _povray(rows: list[PovrayRow]) -> Iterable[list[str]]:
    for row in rows:
        if row.skipped:
            yield [row.scene, row.skipped, "", "", "", "", ""]
            continue
        theirs = row.programs[0]
        for number, side in enumerate(row.programs):
            ratios = [f"{faster(theirs, side, what):.2f}" if number else "" for what in COMPARED]
            tracing = [spread(what(side), 3) for what in COMPARED]
            process = median(side.process_seconds, 2)
            yield [row.scene, side.program, *tracing, process, *ratios]


def render_tables(document: RenderNumbers) -> str:
    """Rays beside Embree's, then pictures beside POV-Ray's."""
    parts = [_one_build(build) for build in document.builds]
    if document.povray:
        headings = ("scene", "program", "tracing, s", "tracing, processor, s", "process, s", "times faster",
                    "times faster, processor")  # fmt: skip
        parts.append(markdown(headings, _povray(document.povray)))
        clock, processor = (dict(against_povray(document.povray, what)) for what in COMPARED)
        means = [(name, f"{clock[name]:.2f}", f"{processor[name]:.2f}") for name in clock if name in processor]
        heads = ("program", "tracing: times faster than POV-Ray, geometric mean", "of the processor")
        parts.append(markdown(heads, means))
    return "\n\n".join(parts)


def scale_tables(document: ScaleNumbers) -> str:
    """Every measurement, and the slopes."""
    headings = ("scene", "structure", "surfaces", "build, ms", "memory, MB", "peak, MB", "surfaces/ray", "boxes/ray",
                "ns/ray")  # fmt: skip
    rows = [
        (
            row.scene,
            row.structure,
            str(row.surfaces),
            milliseconds(row.build_seconds, 1),
            megabytes(row.bytes),
            megabytes(row.peak_bytes, 0),
            f"{row.surface_tests_per_ray:.1f}",
            f"{row.box_tests_per_ray:.1f}",
            median(row.ns_per_ray, 0),
        )
        for row in document.rows
    ]
    slopes = [
        (
            line["scene"],
            line["structure"],
            f"{line['from']} to {line['to']}",
            f"{line['tests_exponent']:.3f}",
            f"{line['tests_per_doubling']:.2f}",
            f"{line['time_exponent']:.3f}",
        )
        for line in document.growth
    ]
    heads = ("scene", "structure", "surfaces", "tests ~ N^", "tests more per doubling", "time ~ N^")
    return "\n\n".join([machine_line(document.machine), markdown(heads, slopes), markdown(headings, rows)])


def threads_tables(document: ThreadsNumbers) -> str:
    """One line for each scene, structure and number of threads."""
    rows = [
        (row.scene, row.accel, str(row.threads), spread(row.render_seconds, 3), f"{row.speed_up:.2f}")
        for row in document.rows
    ]
    table = markdown(("scene", "structure", "threads", "picture, s", "speed-up"), rows)
    return f"{machine_line(document.machine)}\n\n{table}"


def parse_tables(document: ParseNumbers) -> str:
    """One line for each scene."""
    rows = [
        (row.scene, f"{row.bytes / 1e6:.1f}", str(row.surfaces), spread(row.megabytes_per_second, 1))
        for row in document.rows
    ]
    return f"{machine_line(document.machine)}\n\n{markdown(('scene', 'MB', 'surfaces', 'MB/s'), rows)}"


def loop_tables(document: LoopNumbers) -> str:
    """One line for each step."""
    rows = [(row.step, spread(row.seconds, 2)) for row in document.rows]
    return f"{machine_line(document.machine)}\n\n{markdown(('step', 'seconds'), rows)}"


def boxes_tables(document: BoxesNumbers) -> str:
    """What boxes save."""
    rows = [
        (
            f"{row.scene} ({row.objects})",
            row.accel,
            f"{row.share_tested:.3%}",
            f"{row.tests_per_ray:.1f}",
            f"{row.time_saved:.1%}",
            f"{row.speed_up:.1f}",
        )
        for row in document.rows
    ]
    headings = ("scene (objects)", "structure", "objects tested", "tests per ray", "time saved", "speed-up")
    return markdown(headings, rows)


def grading_tables(document: GradingNumbers) -> str:
    """One line for each way, with the mean of its runs."""
    rows = [
        (mean.way, str(mean.runs), str(mean.submissions), f"{mean.seconds:.2f}", f"{mean.cpu_seconds:.2f}")
        for mean in mean_costs(document.costs)
    ]
    return markdown(("way", "runs", "submissions at a time", "seconds each", "CPU seconds each"), rows)
