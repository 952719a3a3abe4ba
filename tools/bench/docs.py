"""The command `bench docs`: tables and figures of docs/benchmarks.md, from what was measured last."""

import re
from collections.abc import Callable, Iterable
from textwrap import fill
from typing import TypeVar

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import GraderFault, UsageError
from raysteps.common.files import write_if_changed
from raysteps.course.project import Project
from tools.bench.charts import Axis, Chart, Series, linear_axis, log_axis, svg_text
from tools.bench.mitsuba import time_ratio
from tools.bench.model import (
    BoxesNumbers,
    BuildRays,
    GradingNumbers,
    LoopNumbers,
    Machine,
    MitsubaNumbers,
    Numbers,
    ParseNumbers,
    PlayNumbers,
    PovrayRow,
    RenderNumbers,
    ScaleNumbers,
    ScaleRow,
    SceneRays,
    ThreadsNumbers,
    WaitsNumbers,
    geometric_mean,
    kept,
    mean_costs,
)
from tools.bench.render import COMPARED, PEER, against_povray, all_against_embree, faster, median_of, names_of
from tools.bench.tables import counted, markdown, median, megabytes, milliseconds, ratio, spread

# Tables, as Markdown.


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


def mitsuba_tables(document: MitsubaNumbers) -> str:
    """Time, noise, and both at once."""
    rows = [
        (
            row.scene,
            side.program,
            spread(side.seconds, 3),
            f"{side.variance:.3g}",
            f"{side.mean:.5f}",
            f"{time_ratio(row.programs[0], side):.2f}",
        )
        for row in document.rows
        for side in row.programs
    ]
    heads = ("scene", "program", "seconds", "variance of a pixel", "mean light", "time for one error, to Mitsuba's")
    size = f"{document.size}x{document.size}, {document.samples} samples of each pixel"
    words = f"Mitsuba {document.version}, scalar_rgb; {size}. {machine_line(document.machine)}"
    return f"{fill(words, 120, break_on_hyphens=False)}\n\n{markdown(heads, rows)}"


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


def waits_tables(document: WaitsNumbers) -> str:
    """One line for each thing that is waited for."""
    rows = [
        (
            row.what,
            str(len(row.seconds.rounds)),
            f"{row.seconds.min:.2f}",
            f"{row.seconds.median:.2f}",
            median(row.processor_seconds, 2),
        )
        for row in document.rows
    ]
    heads = ("way", "times", "least, s", "median, s", "of processors, s")
    return f"{machine_line(document.machine)}\n\n{markdown(heads, rows)}"


def play_tables(document: PlayNumbers) -> str:
    """One line for each step, what the first visit loads above; and one for each live figure."""
    rows = [(row.step, f"{row.first:.2f}", spread(row.later, 2)) for row in document.rows]
    visit = f"{document.first_bytes / 1e6:.1f} MB, and {document.first_seconds:.1f} s until its first picture"
    known = document.memory_bytes > 0
    memory = f"; in the end the page takes {document.memory_bytes / 1e9:.1f} GB of memory" if known else ""
    machine = f"{document.machine.processor}, {document.machine.cores} cores, {document.machine.system}"
    words = f"{document.browser}, local server; {machine}. The first visit: {visit}{memory}."
    table = markdown(("step", "first save, s", "later saves, s"), rows)
    dragged = "The live figures while a handle is dragged, each frame with an answer of its own:"
    figures = markdown(
        ("step", "figure", "frames per second", "median, ms", "95 % within, ms"),
        [
            (one.step, one.figure, f"{one.per_second:.0f}", f"{one.median:.0f}", f"{one.most:.0f}")
            for one in document.figures
        ],
    )
    return f"{fill(words, 120, break_on_hyphens=False)}\n\n{table}\n\n{dragged}\n\n{figures}"


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
    table = markdown(("way", "runs", "submissions at a time", "seconds each", "CPU seconds each"), rows)
    return f"{machine_line(document.machine)}\n\n{table}"


# Figures.

_WIDE = 760.0
_NARROW = 300.0
_SAMPLED = ("none", "boxes")


def render_figure(document: RenderNumbers) -> str:
    """Bars: nanoseconds a ray, for each scene and structure that gets all rays."""
    scenes = document.builds[0].scenes
    series = []
    for name in names_of(scenes):
        values = [median_of(scene, name) for scene in scenes]
        if name not in _SAMPLED:
            series.append(Series(name, [(place, value) for place, value in enumerate(values) if value]))
    every = [value for one in series for _, value in one.points]
    groups = tuple(scene.scene for scene in scenes)
    x = Axis("one thread, all rays of the picture", -0.5, len(groups) - 0.5)
    chart = Chart("time of a ray", x, linear_axis("nanoseconds", every), series, groups)
    return svg_text([chart], width=_WIDE)


def _value(row: ScaleRow, what: str) -> float:
    return row.tests_per_ray if what == "tests" else float(row.ns_per_ray.median)


def scale_figure(document: ScaleNumbers, what: str, label: str) -> str:
    """Lines: one chart for each kind of scene, one line for each structure; what is `tests` or `time`."""
    rows = [row for row in document.rows if _value(row, what) > 0]
    x = log_axis("surfaces", [row.surfaces for row in rows])
    y = log_axis(label, [_value(row, what) for row in rows])
    structures = list(dict.fromkeys(row.structure for row in rows))
    charts = []
    for kind in dict.fromkeys(row.scene for row in rows):
        series = []
        for name in structures:
            line = [row for row in rows if (row.scene, row.structure) == (kind, name)]
            series.append(Series(name, [(row.surfaces, _value(row, what)) for row in line]))
        charts.append(Chart(kind, x, y, series))
    return svg_text(charts, width=_NARROW)


def threads_figure(document: ThreadsNumbers) -> str:
    """Bars: speed-up for each number of threads, the geometric mean of the scenes."""
    rows = document.rows
    counts = sorted({row.threads for row in rows})
    series = []
    for name in dict.fromkeys(row.accel for row in rows):
        points = []
        for place, count in enumerate(counts):
            ups = [row.speed_up for row in rows if (row.accel, row.threads) == (name, count)]
            points.append((float(place), geometric_mean(ups)))
        series.append(Series(name, points))
    every = [value for one in series for _, value in one.points]
    x = Axis("threads", -0.5, len(counts) - 0.5)
    groups = tuple(str(count) for count in counts)
    return svg_text([Chart("one picture on several threads", x, linear_axis("speed-up", every), series, groups)])


# The page.

T = TypeVar("T", bound=Numbers)
Figure = tuple[str, str, Callable[[T], str]]  # file, words and picture

_RAYS: Figure[RenderNumbers] = (
    "bench-rays.svg",
    "nanoseconds a ray for each scene and structure",
    render_figure,
)
_SCALE_TESTS: Figure[ScaleNumbers] = (
    "bench-scale-tests.svg",
    "tests of surfaces and boxes a ray, over the number of surfaces",
    lambda document: scale_figure(document, "tests", "tests a ray"),
)
_SCALE_TIME: Figure[ScaleNumbers] = (
    "bench-scale-time.svg",
    "nanoseconds a ray, over the number of surfaces",
    lambda document: scale_figure(document, "time", "nanoseconds a ray"),
)
_THREADS: Figure[ThreadsNumbers] = (
    "bench-threads.svg",
    "speed-up over the number of threads",
    threads_figure,
)
FIGURES = tuple(file for file, _, _ in (_RAYS, _SCALE_TESTS, _SCALE_TIME, _THREADS))


def _part(project: Project, kind: type[T], tables: Callable[[T], str], *drawn: Figure[T]) -> str | None:
    """Figures and tables; nothing where it was not measured."""
    document = kept(project, kind)
    if document is None:
        return None
    parts = []
    for file, words, draw in drawn:
        write_if_changed(project.root / "docs" / "pictures" / file, draw(document).encode())
        parts.append(f"![{words}](pictures/{file})")
    return "\n\n".join([*parts, tables(document)])


def parts_of(project: Project) -> dict[str, str | None]:
    """By the name of the benchmark."""
    return {
        "boxes": _part(project, BoxesNumbers, boxes_tables),
        "grading": _part(project, GradingNumbers, grading_tables),
        "render": _part(project, RenderNumbers, render_tables, _RAYS),
        "mitsuba": _part(project, MitsubaNumbers, mitsuba_tables),
        "scale": _part(project, ScaleNumbers, scale_tables, _SCALE_TESTS, _SCALE_TIME),
        "threads": _part(project, ThreadsNumbers, threads_tables, _THREADS),
        "parse": _part(project, ParseNumbers, parse_tables),
        "loop": _part(project, LoopNumbers, loop_tables),
        "waits": _part(project, WaitsNumbers, waits_tables),
        "play": _part(project, PlayNumbers, play_tables),
    }


def replace_part(page: str, name: str, content: str, document: str) -> str:
    """The page with new content between its two marks. `document` stands for it in messages."""
    begin, end = f"<!-- begin {name} -->", f"<!-- end {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if len(pattern.findall(page)) != 1:
        raise GraderFault(f"docs/{document}: expected one part between '{begin}' and '{end}'")
    return pattern.sub(lambda _: f"{begin}\n{content}\n{end}", page)


def page_of(name: str) -> str:
    """The document that shows a benchmark."""
    return "play.md" if name == PlayNumbers.name else "benchmarks.md"


def bench_docs(project: Project, console: Console) -> int:
    """Writes the parts that have been measured, and names the others."""
    measured = parts_of(project)
    if not any(measured.values()):
        raise UsageError("nothing has been measured yet; begin with: ./raysteps bench render")
    for document in dict.fromkeys(map(page_of, measured)):
        path = project.root / "docs" / document
        page = path.read_text(encoding="utf-8")
        for name, content in measured.items():
            if page_of(name) != document:
                continue
            if content is None:
                console.print(f"not measured here, left as it is: {name}")
            else:
                page = replace_part(page, name, content, document)
        changed = write_if_changed(path, page.encode())
        console.print(escape(f"{path} {'written' if changed else 'is up to date'}"), soft_wrap=True)
    return 0
