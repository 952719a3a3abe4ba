"""Step 11: what lies between corners, between texels, and between levels."""

import math

from tools.figures.drawing import Drawing, Point, polar


def weights() -> Drawing:
    """The three small triangles."""
    figure = Drawing(
        640,
        250,
        "Weights of the corners",
        "A triangle a, b, c with a point p in it, which is joined to the corners. The small triangle opposite to each "
        "corner has that corner's colour. p is near b: the triangle opposite to b is the largest.",
    )
    a, b, c, p = (70.0, 215.0), (300.0, 205.0), (190.0, 30.0), (225.0, 165.0)
    figure.polygon([p, b, c], "w-blue")
    figure.polygon([p, c, a], "w-red")
    figure.polygon([p, a, b], "w-green")
    figure.polygon([a, b, c])
    for corner in (a, b, c):
        figure.line(p, corner, "muted thin")
    figure.dot(p)
    figure.text((233, 160), "p", "math")
    figure.text((46, 222), "a", "math t-blue")
    figure.text((310, 212), "b", "math t-red")
    figure.text((186, 22), "c", "math t-green")
    for i, (name, color, share) in enumerate((("a", "blue", "0.21"), ("b", "red", "0.55"), ("c", "green", "0.24"))):
        top = 66 + 44 * i
        figure.rect((352, top), 22, 22, f"w-{color}")
        figure.text((386, top + 16), f"opposite to {name}: its weight, {share}", f"t-{color}")
    figure.text((352, 66 + 44 * 3 + 16), "together 1", "t-muted")
    return figure


def lift() -> Drawing:
    """A flat piece under a curve, its corners' planes, and where the point goes."""
    figure = Drawing(
        600,
        240,
        "A point that is lifted",
        "A flat piece joins two corners of a curve. Each corner has a normal, and a dashed plane at right angles to it."
        " The point on the flat piece lies below both planes. It is lifted onto each along its normal, and the blend"
        " of both lies a little above the curve.",
    )
    center, radius = (300.0, 420.0), 340.0
    figure.arc(center, radius, 50, 130, "muted dash")
    left, right = polar(center, 125, radius), polar(center, 55, radius)
    figure.line(left, right, "ink thick")
    for degrees, corner, color in ((125, left, "blue"), (55, right, "red")):
        figure.arrow(corner, polar(center, degrees, radius + 55), color)
        along = math.radians(degrees)
        side = (math.sin(along), math.cos(along))
        turn = 1 if degrees > 90 else -1
        figure.line(corner, (corner[0] + turn * 225 * side[0], corner[1] + turn * 225 * side[1]), f"{color} thin dash")
        figure.dot(corner, color)
    share = 0.42
    p = (left[0] + share * (right[0] - left[0]), left[1] + share * (right[1] - left[1]))
    lifted = [_onto_plane(p, left, 125), _onto_plane(p, right, 55)]
    for end, color in zip(lifted, ("blue", "red"), strict=True):
        figure.arrow(p, end, f"{color} thin")
    blend = tuple((1 - share) * lifted[0][i] + share * lifted[1][i] for i in range(2))
    figure.dot(p)
    figure.dot((blend[0], blend[1]), "green", 5)
    figure.text((p[0] - 4, p[1] + 22), "p", "math", "middle")
    figure.text((blend[0] + 12, blend[1] - 8), "p'", "math t-green")
    figure.text((24, 226), "dark line: the flat triangle; dashed grey: the surface that it stands for", "small t-muted")
    return figure


def _onto_plane(p: Point, corner: Point, degrees: float) -> Point:
    angle = math.radians(degrees)
    normal = (math.cos(angle), -math.sin(angle))
    height = (p[0] - corner[0]) * normal[0] + (p[1] - corner[1]) * normal[1]
    return p[0] - height * normal[0], p[1] - height * normal[1]


def texels() -> Drawing:
    """Four texels, and a place between their middles."""
    figure = Drawing(
        640,
        250,
        "A place between four texels",
        "Four square texels with a dot in the middle of each. The place lies between these four dots, a quarter of the "
        "way from the left ones to the right ones and three quarters of the way down.",
    )
    side, left, top = 100.0, 40.0, 25.0
    for row in range(2):
        for column in range(2):
            kind = ("w-blue", "w-red", "w-green", "w-grey")[2 * row + column]
            corner = (left + column * side, top + row * side)
            figure.rect(corner, side, side, kind)
            figure.rect(corner, side, side, "l muted thin")
            figure.dot((corner[0] + side / 2, corner[1] + side / 2), "muted")
    x, y = left + side / 2 + 0.25 * side, top + side / 2 + 0.75 * side
    for at in (top + side / 2, top + 3 * side / 2):
        figure.line((left + side / 2, at), (left + 3 * side / 2, at), "muted thin dash")
        figure.dot((x, at), "ink", 2.5)
    figure.line((x, top + side / 2), (x, top + 3 * side / 2), "ink thin")
    figure.dot((x, y), "ink", 5)
    figure.text((280, 70), "upper row: 0.75 of the left, 0.25 of the right")
    figure.text((280, 100), "lower row: the same")
    figure.text((280, 140), "0.25 of the upper, 0.75 of the lower")
    figure.text((280, 180), "dots: where a texel has its own colour", "small t-muted")
    return figure


def levels() -> Drawing:
    """A chessboard-like texture of 8 x 8 and what becomes of it."""
    figure = Drawing(
        600,
        210,
        "Levels of a texture",
        "Four squares of one size, from left to right with 8 by 8, 4 by 4, 2 by 2 and 1 texel. Each texel is the mean"
        " of four of the level before it. The last one is grey.",
    )
    size, gap = 126.0, 18.0
    grid = [[1.0 if (x // 2 + y // 3) % 2 or x == y else 0.15 for x in range(8)] for y in range(8)]
    for level in range(4):
        cells = len(grid)
        cell = size / cells
        left = 20 + level * (size + gap)
        for y, row in enumerate(grid):
            for x, value in enumerate(row):
                _square(figure, (left + x * cell, 24 + y * cell), cell, value)
        figure.rect((left, 24), size, size)
        figure.text((left + size / 2, 172), f"level {level}", "", "middle")
        figure.text((left + size / 2, 191), f"{cells} x {cells}", "small t-muted", "middle")
        half = range(cells // 2)
        grid = [[sum(grid[2 * y + j][2 * x + i] for i in range(2) for j in range(2)) / 4 for x in half] for y in half]
    return figure


def _square(figure: Drawing, corner: Point, side: float, value: float) -> None:
    """Darker for lower values, by hatching with dots of that size: the same on light and dark plates."""
    radius = 0.5 * side * math.sqrt(1.0 - value)
    if radius > 0.3:
        figure.dot((corner[0] + side / 2, corner[1] + side / 2), "blue", radius)
