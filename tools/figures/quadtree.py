"""Step 06: boxes within boxes, in two dimensions."""

import math

from tools.figures.drawing import Drawing, Point

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
