"""Plots: of formulas, and of what was counted."""

import math

from tools.bench.charts import Axis, Chart, Series, linear_axis, log_axis, svg_text
from tools.figures.measuring import Measurement

_MIDDLE, _WIDE = 420.0, 560.0

# Formulas: how a highlight falls off, and how light becomes brightness.


def tone() -> str:
    """c / (c + 1) beside cutting off."""
    light = [i / 20 for i in range(101)]
    series = [
        Series("cut off at 1", [(c, min(c, 1.0)) for c in light], marked=False),
        Series("c / (c + 1)", [(c, c / (c + 1)) for c in light], marked=False),
    ]
    x, y = Axis("light c of one channel", 0.0, 5.0), Axis("what is shown, 1 is white", 0.0, 1.0)
    words = (
        "Cutting off is a straight line up to 1 and flat from there on, so 2 and 5 look the same. c / (c + 1) "
        "begins as steep, bends, is 0.5 at 1 and 0.83 at 5, and never reaches 1."
    )
    return svg_text([Chart("from light to brightness", x, y, series)], width=_WIDE, description=words, plate=True)


def highlight() -> str:
    """The cosine to the power of shine."""
    series = []
    for shine in (1, 10, 50, 200):
        points = [(float(degrees), math.cos(math.radians(degrees)) ** shine) for degrees in range(91)]
        series.append(Series(f"shine {shine}", points, marked=False))
    x, y = Axis("angle between r and v, in degrees", 0.0, 90.0), Axis("share of ks", 0.0, 1.0)
    words = "All curves begin at 1 and fall to 0; with shine 1 slowly, at 90 degrees, with shine 200 within 15 degrees."
    return svg_text([Chart("the width of a highlight", x, y, series)], width=_WIDE, description=words, plate=True)


# What was counted.

_NAMES = {"none": "every surface", "boxes": "64 boxes", "octree": "octree", "bvh": "bounding volumes"}


def _points(rows: list[list[float]]) -> list[tuple[float, float]]:
    return [(float(x), float(y)) for x, y in rows]


def growth(measured: Measurement) -> str:
    """Tests per ray against the size of the scene, on log axes."""
    found = measured["growth"]
    every = [_points(rows) for ways in found.values() for rows in ways.values()]
    x = log_axis("surfaces in the scene", [at for line in every for at, _ in line])
    y = log_axis("tests per ray, surfaces and boxes", [tests for line in every for _, tests in line])
    charts = [
        Chart(kind, x, y, [Series(_NAMES[name], _points(rows)) for name, rows in ways.items()])
        for kind, ways in found.items()
    ]
    words = (
        "Both axes are logarithmic. Without boxes, tests grow as the scene does. The paper's 64 boxes are a tenth "
        "of that and grow as fast. Octree and bounding volumes hardly grow."
    )
    return svg_text(charts, width=_MIDDLE, description=words, plate=True)


def depths(measured: Measurement) -> str:
    """Left: tests per ray. Right: entries per surface with both kinds of overlap test."""
    found = measured["depths"]
    x = Axis("greatest depth of the tree", 0.0, 7.0)
    surfaces, boxes = _points(found["surfaces"]), _points(found["boxes"])
    precise, bounds = _points(found["precise"]), _points(found["bounds"])
    tests = log_axis("tests per ray", [value for _, value in [*surfaces, *boxes]])
    entries = linear_axis("list entries per surface", [value for _, value in [*precise, *bounds]])
    left = [Series("surfaces tested", surfaces), Series("boxes tested", boxes), Series("entries, precise", [])]
    right = [Series("surfaces tested", []), Series("boxes tested", []), Series("entries, precise", precise)]
    charts = [
        Chart("gears: tests", x, tests, [*left, Series("entries, by bounds", [])]),
        Chart("gears: room in the lists", x, entries, [*right, Series("entries, by bounds", bounds)]),
    ]
    words = (
        "Left: each level of boxes saves surface tests and costs box tests; after five levels nothing is gained. "
        "Right: with a precise overlap test the lists stop growing, with bounds alone they grow from level to "
        "level."
    )
    return svg_text(charts, width=_MIDDLE, description=words, plate=True)


def acne(measured: Measurement) -> str:
    """Wrong pixels against the threshold."""
    found = measured["thresholds"]
    x = log_axis("threshold, in units of the scene", [at for rows in found.values() for at, _ in rows])
    y = linear_axis("wrong pixels, %", [100 * share for rows in found.values() for _, share in rows])
    series = [Series(name, [(at, 100 * share) for at, share in rows]) for name, rows in found.items()]
    words = (
        "A third of the pixels is wrong with too small a threshold: up to a millionth near the centre of the world, "
        "up to three millionths at coordinates around 100. From a hundredth on shadows are lost."
    )
    return svg_text([Chart("acne, and lost shadows", x, y, series)], width=_WIDE, description=words, plate=True)


def bounces(measured: Measurement) -> str:
    """Rays per pixel against the ray depth."""
    found = measured["bounces"]
    y = linear_axis("rays per pixel", [value for rows in found.values() for _, value in rows])
    series = [Series(name, _points(rows)) for name, rows in found.items()]
    chart = Chart("facing mirrors: what a deeper limit costs", Axis("greatest depth", 1.0, 10.0), y, series)
    words = "Rays per pixel grow with each level, less and less: only chains that stay between the mirrors go on."
    return svg_text([chart], width=_WIDE, description=words, plate=True)
