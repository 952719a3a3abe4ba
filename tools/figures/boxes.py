"""Steps 06 and 09: a tree of boxes, slabs, what an overlap test saves, what a cut costs, and the tests of a ray."""

import math

from tools.bench.charts import Axis, Chart, Series, linear_axis, log_axis, svg_text
from tools.figures.drawing import Drawing, Point
from tools.figures.measuring import Measurement


def slabs() -> Drawing:
    """The worked example: three intervals and what they have in common."""
    figure = Drawing(
        640,
        310,
        "Three slabs, three intervals",
        "Left: the ray from (-3, 0, 3) along (0.6, 0, -0.8) and the box from -1 to 1, seen along y. Right: x is "
        "inside from 3.33 to 6.67, y always, z from 2.5 to 5. Common to all: from 3.33 to 5.",
    )
    scale, middle = 38.0, (160.0, 160.0)

    def at(x: float, z: float) -> Point:
        return middle[0] + x * scale, middle[1] - z * scale

    figure.rect(at(-1, 3.2), 2 * scale, 6.2 * scale, "w-blue")
    figure.rect(at(-3.4, 1), 6.4 * scale, 2 * scale, "w-green")
    figure.rect(at(-1, 1), 2 * scale, 2 * scale, "l ink thick")

    def along(distance: float) -> Point:
        return at(-3 + 0.6 * distance, 3 - 0.8 * distance)

    figure.arrow(at(-3, 3), along(7.3), "ink")
    figure.line(along(10 / 3), along(5), "red thick")
    for distance, color, words in (
        (2.5, "green", "2.5"),
        (10 / 3, "blue", "3.33"),
        (5.0, "green", "5"),
        (20 / 3, "blue", "6.67"),
    ):
        figure.dot(along(distance), color, 4)
        figure.text((along(distance)[0] + 8, along(distance)[1] - 4), words, f"small t-{color}")
    figure.dot(at(-3, 3), "ink", 5)
    figure.text((at(-3, 3)[0] + 10, at(-3, 3)[1] + 2), "origin", "small")
    figure.text((160, 298), "x to the right, z upwards", "small t-muted", "middle")
    left, unit = 372.0, 30.0
    for row, (name, low, high, color) in enumerate(
        (("x", 10 / 3, 20 / 3, "blue"), ("y", 0.0, 8.0, "muted"), ("z", 2.5, 5.0, "green"), ("box", 10 / 3, 5.0, "red"))
    ):
        y = 80.0 + 45 * row
        figure.text((left - 14, y + 5), name, f"strong t-{color}", "end")
        figure.rect(
            (left + low * unit, y - 8), (high - low) * unit, 16, f"w-{'grey' if color == 'muted' else color} l {color}"
        )
    for distance in range(0, 9, 2):
        figure.line((left + distance * unit, 58), (left + distance * unit, 236), "muted thin dash")
        figure.text((left + distance * unit, 254), str(distance), "small t-muted", "middle")
    figure.text((left + 4 * unit, 274), "distance along the ray", "small t-muted", "middle")
    figure.text((left + 10 / 3 * unit, 40), "enter", "small t-red", "middle")
    figure.text((left + 5 * unit, 40), "leave", "small t-red", "middle")
    for distance in (10 / 3, 5.0):
        figure.line((left + distance * unit, 46), (left + distance * unit, 206), "red thin")
    return figure


def overlap() -> Drawing:
    """A slanted triangle touches few boxes; its bounds touch many."""
    figure = Drawing(
        640,
        330,
        "Bounds and the thing itself",
        "A thin slanted triangle in a grid of 8 by 8 boxes. Left: the boxes that its bounds touch. Right: the boxes "
        "that the triangle itself touches, far fewer.",
    )
    size = 30.0
    corners = ((0.4, 0.5), (7.6, 6.9), (7.0, 7.5))
    for left, precise in ((30.0, False), (370.0, True)):
        top, count = 30.0, 0
        for column in range(8):
            for row in range(8):
                touched = not precise or _crosses(corners, (float(column), float(row)))
                count += touched
                kind = ("w-red " if not precise else "w-green ") if touched else ""
                figure.rect((left + column * size, top + (7 - row) * size), size, size, f"{kind}l muted thin")
        points = [(left + x * size, top + (8 - y) * size) for x, y in corners]
        if not precise:
            figure.rect((left + 0.4 * size, top + 0.5 * size), 7.2 * size, 7 * size, "l red dash")
        figure.polygon(points, "l w-blue blue")
        words = f"its bounds: {count} boxes" if not precise else f"the triangle: {count} boxes"
        figure.text((left + 4 * size, 300), words, "t-green" if precise else "t-red", "middle")
    return figure


def _crosses(corners: tuple[Point, ...], low: Point) -> bool:
    """Separating axes in the plane: the square's two, and one for each edge."""
    square = [(low[0] + x, low[1] + y) for x in (0, 1) for y in (0, 1)]
    axes = [(1.0, 0.0), (0.0, 1.0)]
    axes += [(b[1] - a[1], a[0] - b[0]) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
    for axis in axes:
        one = [axis[0] * x + axis[1] * y for x, y in square]
        two = [axis[0] * x + axis[1] * y for x, y in corners]
        if min(one) > max(two) or min(two) > max(one):
            return False
    return True


def cut() -> Drawing:
    """The worked example of step 09: ten surfaces, two cuts."""
    figure = Drawing(
        640,
        300,
        "What a cut costs",
        "Ten surfaces in a box of 4 by 2 by 2: nine in its first quarter, one in its last. Left: a cut between the "
        "heaps gives two small boxes and costs 5. Right: a cut of the list into halves stretches the second box and "
        "costs 7.75.",
    )
    unit = 62.0
    for left, good in ((36.0, True), (356.0, False)):
        top = 60.0
        figure.rect((left, top), 4 * unit, 2 * unit, "l muted dash")
        boxes = ((0.0, 1.0, "green"), (3.0, 4.0, "green")) if good else ((0.0, 1.0, "green"), (0.25, 4.0, "red"))
        for low, high, color in boxes:
            inset = 0 if color == "green" else 4
            corner = (left + low * unit, top + inset)
            figure.rect(corner, (high - low) * unit - inset, 2 * unit - 2 * inset, f"l {color} w-{color}")
        for i in range(9):
            place = (left + (0.18 + 0.32 * (i % 3)) * unit, top + (0.35 + 0.62 * (i // 3)) * unit)
            figure.dot(place, "ink" if good or (i % 3 < 2 and i < 8 and i != 7) else "red", 5)
        figure.dot((left + 3.5 * unit, top + unit), "ink" if good else "red", 5)
        words = ("9 in area 16, 1 in area 16", "1 + 16/40 · 9 + 16/40 · 1 = 5")
        if not good:
            words = ("5 in area 16, 5 in area 38", "1 + 16/40 · 5 + 38/40 · 5 = 7.75")
        figure.text((left + 2 * unit, 222), words[0], "", "middle")
        figure.text((left + 2 * unit, 248), words[1], "strong " + ("t-green" if good else "t-red"), "middle")
        figure.text((left + 2 * unit, 42), "between the heaps" if good else "half of the list", "", "middle")
    figure.text(
        (320, 282), "the whole box: area 40, ten surfaces; without a cut the cost is 10", "small t-muted", "middle"
    )
    return figure


# A quadtree: the octree in the plane, and what a ray asks of it.

# A flat world of 16 x 16: centre and radius of balls.
_BALLS: tuple[tuple[float, float, float], ...] = (
    (2.2, 13.2, 0.9),
    (4.6, 10.6, 0.7),
    (1.8, 1.6, 0.8),
    (5.2, 2.2, 0.7),
    (2.4, 7.0, 0.6),
    (6.4, 5.0, 0.7),
    (10.6, 13.4, 0.9),
    (13.2, 12.3, 0.8),
    (13.4, 9.4, 0.8),
    (14.8, 14.4, 0.6),
    (9.2, 11.6, 0.6),
    (10.0, 2.4, 0.8),
    (14.0, 3.4, 0.9),
)
_RAY = ((-1.0, 3.6), (0.86, 0.51))


def _span(low: Point, size: float) -> tuple[float, float] | None:
    """Where the ray enters and leaves a square."""
    enter, leave = 0.0, math.inf
    for axis in (0, 1):
        near, far = sorted((low[axis] + side - _RAY[0][axis]) / _RAY[1][axis] for side in (0.0, size))
        enter, leave = max(enter, near), min(leave, far)
    return (enter, leave) if enter < leave else None


def _touching(low: Point, size: float) -> list[tuple[float, float, float]]:
    def gap(ball: tuple[float, float, float]) -> float:
        outside = [max(low[i] - ball[i], 0.0, ball[i] - low[i] - size) for i in (0, 1)]
        return math.hypot(*outside) - ball[2]

    return [ball for ball in _BALLS if gap(ball) < 0]


def _leaves(low: Point, size: float, depth: int) -> list[tuple[Point, float]]:
    if depth == 2 or len(_touching(low, size)) <= 2:
        return [(low, size)]
    half = size / 2
    corners = [(low[0] + x * half, low[1] + y * half) for y in (0, 1) for x in (0, 1)]
    return [leaf for corner in corners for leaf in _leaves(corner, half, depth + 1)]


def quadtree() -> Drawing:
    """An octree in two dimensions: the boxes that a ray enters, in order, and what it tests."""
    figure = Drawing(
        640,
        400,
        "Boxes within boxes, seen from above",
        "A square world cut into four, and these into four where more than two balls touch them. A ray enters some "
        "of the boxes, numbered in order; only balls that touch these are tested. The search stops at the box with "
        "the hit.",
    )
    scale, left, top = 21.5, 34.0, 28.0

    def at(point: Point) -> Point:
        return left + point[0] * scale, top + (16 - point[1]) * scale

    leaves = _leaves((0.0, 0.0), 16.0, 0)
    entered = sorted((span[0], span[1], leaf) for leaf in leaves if (span := _span(*leaf)))
    visited, tested, hit = [], set(), None
    for enter, leave, leaf in entered:
        visited.append(leaf)
        for ball in _touching(*leaf):
            tested.add(ball)
            to_center = [ball[i] - _RAY[0][i] for i in (0, 1)]
            along = sum(to_center[i] * _RAY[1][i] for i in (0, 1))
            chord = ball[2] ** 2 - (math.hypot(*to_center) ** 2 - along**2)
            if chord > 0 and enter <= along - math.sqrt(chord) <= leave:
                hit = along - math.sqrt(chord)
        if hit is not None:
            break
    for low, size in leaves:
        corner = at((low[0], low[1] + size))
        figure.rect(
            corner, size * scale, size * scale, "l muted thin w-red" if (low, size) in visited else "l muted thin"
        )
    figure.rect(at((0, 16)), 16 * scale, 16 * scale, "l ink")
    for x, y, radius in _BALLS:
        figure.circle(at((x, y)), radius * scale, "l w-red red" if (x, y, radius) in tested else "l w-grey muted")
    assert hit is not None
    end = (_RAY[0][0] + hit * _RAY[1][0], _RAY[0][1] + hit * _RAY[1][1])
    figure.arrow(at(_RAY[0]), at(end), "blue thick")
    figure.line(at(end), at((_RAY[0][0] + 19.5 * _RAY[1][0], _RAY[0][1] + 19.5 * _RAY[1][1])), "blue thin dash")
    for number, (low, size) in enumerate(visited, 1):
        place = at((low[0], low[1] + size))
        figure.text((place[0] + 6, place[1] + 17), str(number), "strong t-red")
    for row, (words, kind) in enumerate(
        (
            (f"{len(_BALLS)} balls, {len(leaves)} leaves", ""),
            ("numbers: boxes in the order", "t-red"),
            ("in which the ray enters them", "t-red"),
            (f"coloured: the {len(tested)} balls it tests", "t-red"),
            ("grey: never asked", "t-muted"),
            ("the hit ends the search", "t-blue"),
        )
    ):
        figure.text((402, 90 + 30 * row - (12 if row == 2 else 0)), words, kind)
    return figure


# What was counted.

_MIDDLE = 420.0
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
