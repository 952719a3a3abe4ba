"""The figures of docs/benchmarks.md."""

from tools.bench.charts import Axis, Chart, Series, linear_axis, log_axis, svg_text
from tools.bench.model import RenderNumbers, ScaleNumbers, ScaleRow, ThreadsNumbers
from tools.bench.records import geometric_mean
from tools.bench.render import median_of, names_of

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
