"""Steps 10 and 12 to 14: where samples lie, in a pixel and on lamps, what they are worth, what a screen is sent, and
where paths go."""

import math

import numpy as np
from numpy.typing import NDArray

from tools.bench.charts import Axis, Chart, Series, log_axis, svg_text
from tools.figures.drawing import Drawing, polar, toward

_WIDE = 560.0
_SEED = 10
_Points = NDArray[np.float64]


def _inverse(base: int, index: int) -> float:
    answer, place = 0.0, 1.0
    while index > 0:
        place /= base
        answer += place * (index % base)
        index //= base
    return answer


def _random(draw: np.random.Generator, side: int) -> _Points:
    return draw.random((side * side, 2))


def _stratified(draw: np.random.Generator, side: int) -> _Points:
    corners = np.array([(column, row) for row in range(side) for column in range(side)])
    return np.asarray((corners + draw.random((side * side, 2))) / side)


def _halton(draw: np.random.Generator, side: int) -> _Points:
    """Moved by a random shift, as in each pixel."""
    points = np.array([(_inverse(2, i), _inverse(3, i)) for i in range(side * side)])
    return np.asarray((points + draw.random(2)) % 1.0)


_WAYS = {"anywhere": _random, "stratified": _stratified, "Halton": _halton}


def points() -> Drawing:
    """64 of each kind."""
    figure = Drawing(
        640,
        245,
        "64 samples in a pixel",
        "Three squares with 64 points each. Points that lie anywhere come in heaps and leave holes. Stratified ones "
        "lie one in each of 8 by 8 squares. Halton's points are spread evenly, with no point close to another.",
    )
    draw = np.random.default_rng(_SEED)
    side, size = 8, 184.0
    for number, (name, make) in enumerate(_WAYS.items()):
        left, top = 22 + number * 206, 22
        if name == "stratified":
            for line in range(1, side):
                at = size * line / side
                figure.line((left + at, top), (left + at, top + size), "muted thin")
                figure.line((left, top + at), (left + size, top + at), "muted thin")
        figure.rect((left, top), size, size)
        for x, y in make(draw, side):
            figure.dot((left + size * x, top + size * y), "blue", 2.6)
        figure.text((left + size / 2, 230), name, "small", "middle")
    return figure


def _error(name: str, side: int) -> float:
    """Of the share of a pixel that lies beyond an edge: root mean square over many edges."""
    draw = np.random.default_rng(_SEED)
    errors = []
    for _ in range(400):
        angle, off = draw.uniform(0, 2 * math.pi), draw.uniform(-0.3, 0.3)
        normal = np.array((math.cos(angle), math.sin(angle)))
        grid = (np.arange(256) + 0.5) / 256 - 0.5
        right = float((grid[:, None] * normal[0] + grid[None, :] * normal[1] < off).mean())
        found = float(((_WAYS[name](draw, side) - 0.5) @ normal < off).mean())
        errors.append(found - right)
    return float(np.sqrt(np.mean(np.square(errors))))


def errors() -> str:
    """How they shrink with the number of samples."""
    sides = (1, 2, 3, 4, 6, 8, 12, 16)
    lines = {name: [(float(side * side), _error(name, side)) for side in sides] for name in _WAYS}
    x = log_axis("samples in the pixel", [at for line in lines.values() for at, _ in line])
    y = log_axis("error at an edge, 1 is white", [value for line in lines.values() for _, value in line])
    words = (
        "Both axes are logarithmic. All begin at a half. With 256 samples the error is 0.03 where they lie anywhere, "
        "and less than a third of that where they are stratified or Halton's."
    )
    chart = Chart("more samples, less error", x, y, [Series(name, line) for name, line in lines.items()])
    return svg_text([chart], width=_WIDE, description=words, plate=True)


def _tent(x: float) -> float:
    return max(0.0, 1 - abs(x))


def _mitchell(x: float) -> float:
    x = abs(x)
    if x < 1:
        return (7 * x**3 - 12 * x**2 + 16 / 3) / 6
    return (-7 / 3 * x**3 + 12 * x**2 - 20 * x + 32 / 3) / 6 if x < 2 else 0.0


def filters() -> str:
    """Weights against the distance from the middle of the pixel."""
    at = [i / 50 for i in range(-125, 126)]
    series = [
        Series("box", [(x, 1.0 if abs(x) <= 0.5 else 0.0) for x in at], marked=False),
        Series("tent", [(x, _tent(x)) for x in at], marked=False),
        Series("Mitchell", [(x, _mitchell(x)) for x in at], marked=False),
    ]
    x, y = Axis("distance from the middle, in pixels", -2.5, 2.5), Axis("weight", -0.2, 1.0)
    words = (
        "The box is 1 up to half a pixel to either side. The tent falls evenly from 1 to 0 at a distance of 1. "
        "Mitchell's filter is 8/9 in the middle, passes 0 a little after 1, is slightly negative, and ends at 2."
    )
    return svg_text([Chart("what a sample is worth", x, y, series)], width=_WIDE, description=words, plate=True)


def _srgb(c: float) -> float:
    return 12.92 * c if c <= 0.0031308 else 1.055 * float(c ** (1 / 2.4)) - 0.055


def screen() -> str:
    """From light to what a screen is sent."""
    light = [i / 200 for i in range(201)]
    series = [
        Series("sRGB", [(c, _srgb(c)) for c in light], marked=False),
        Series("as it is", [(c, c) for c in light], marked=False),
    ]
    x, y = Axis("linear light", 0.0, 1.0), Axis("what the screen is sent", 0.0, 1.0)
    words = "The curve rises steeply from 0: a light of 0.2 is sent as 0.48 and one of 0.5 as 0.74. It ends at 1."
    return svg_text([Chart("the curve of a screen", x, y, series)], width=_WIDE, description=words, plate=True)


# Step 12.


def disk() -> Drawing:
    """Random points of a disk, with the radius as it is drawn, and with its root."""
    figure = Drawing(
        640,
        250,
        "300 points of a disk",
        "Two disks with 300 points each, and a dashed circle at half of the radius. Where the radius is a random"
        " number, half of the points crowd within that circle. Where it is the root of one, a quarter of them do, and"
        " points lie evenly.",
    )
    draw = np.random.default_rng(_SEED)
    numbers = draw.random((300, 2))
    for number, name in enumerate(("radius = u.x", "radius = sqrt(u.x)")):
        center, size = (170.0 + 300 * number, 116.0), 96.0
        figure.circle(center, size)
        figure.circle(center, size / 2, "l muted dash")
        for share, turn in numbers:
            radius = share if number == 0 else math.sqrt(share)
            figure.dot(polar(center, 360 * turn, size * radius), "blue", 2.2)
        figure.text((center[0], 238), name, "small", "middle")
    return figure


def penumbra() -> Drawing:
    """A lamp, what stands before it, and three places on the floor."""
    figure = Drawing(
        640,
        270,
        "A soft edge of shadow",
        "A lamp above, a plate below it, and the floor. From the left all of the lamp is seen, and it is light there."
        " From the right nothing of it is seen. From the place between them one half of the lamp is seen.",
    )
    left, right, edge, floor = (200.0, 30.0), (320.0, 30.0), (300.0, 130.0), 225.0
    figure.line((30, floor), (610, floor), "muted")
    figure.line(edge, (470, 130), "ink thick")
    ends = [_on_floor(end, edge, floor) for end in (right, left)]
    figure.polygon([(ends[0], floor), (ends[1], floor), edge], "w-grey")
    figure.line(left, right, "red thick")
    for end, place in zip((right, left), ends, strict=True):
        figure.line(end, (place, floor), "muted thin dash")
    middle = (left[0] + right[0]) / 2
    half = _on_floor((middle, 30.0), edge, floor)
    for at, color in ((110.0, "green"), (half, "blue"), (500.0, "ink")):
        figure.dot((at, floor), color, 5)
    for end in (left, (middle, 30.0)):
        figure.line((half, floor), end, "blue thin")
    for end in (left, right):
        figure.line((110, floor), end, "green thin")
    figure.text((110, 252), "all of the lamp", "small t-green", "middle")
    figure.text((half, 252), "half of it", "small t-blue", "middle")
    figure.text((500, 252), "nothing", "small", "middle")
    figure.text((330, 35), "lamp", "small t-red")
    return figure


def _on_floor(lamp: tuple[float, float], edge: tuple[float, float], floor: float) -> float:
    """Where the line from the lamp over the edge meets the floor."""
    return lamp[0] + (edge[0] - lamp[0]) * (floor - lamp[1]) / (edge[1] - lamp[1])


def cone() -> Drawing:
    """What is seen of a sphere, and the cap of directions."""
    figure = Drawing(
        640,
        300,
        "The cone of a sphere",
        "From a place on the left two lines touch a sphere with the centre c on the right. The radius to where a line"
        " touches is at right angles to it. Around the place a part of a unit circle lies in the cone: its cap, of the"
        " height h = 1 - cos.",
    )
    place, center, radius = (60.0, 140.0), (470.0, 140.0), 122.0
    distance = center[0] - place[0]
    half = math.degrees(math.asin(radius / distance))
    figure.circle(center, radius, "w-red")
    figure.circle(center, radius)
    for sign in (1, -1):
        touch = polar(center, sign * (90 + half), radius)
        figure.line(place, toward(place, touch, 430), "muted thin dash")
    touch = polar(center, 90 + half, radius)
    figure.line(center, touch, "red")
    figure.line(place, center, "muted")
    unit = 240.0
    figure.arc(place, unit, -half, half, "blue thick")
    foot = place[0] + unit * math.cos(math.radians(half))
    figure.line((foot, place[1]), (place[0] + unit, place[1]), "blue thick")
    figure.line(polar(place, half, unit), polar(place, -half, unit), "blue thin dash")
    figure.dot(place)
    figure.dot(center, "red")
    figure.text((place[0] + unit + 8, place[1] - 8), "h", "math t-blue")
    figure.text((center[0] + 10, place[1] + 20), "c", "math t-red")
    figure.text((touch[0] + 24, touch[1] + 46), "r", "math t-red")
    figure.text((170, 132), "d", "math")
    figure.text((56, 130), "x", "math", "end")
    figure.text((320, 286), "sin = r / d; of all directions in the cone each is as likely", "small t-muted", "middle")
    return figure


def lens() -> Drawing:
    """Rays of one pixel through a lens."""
    figure = Drawing(
        640,
        250,
        "Rays through a lens",
        "Three rays start at three points of a lens on the left. They meet in the plane of focus, where a point is"
        " sharp. Behind it they part again: what lies there is seen at several places, and becomes blurred.",
    )
    middle, sharp = (90.0, 130.0), (390.0, 95.0)
    figure.line((90, 60), (90, 200), "ink thick")
    figure.line((390, 25), (390, 215), "muted dash")
    for shift, color in ((0, "ink"), (-62, "blue"), (62, "blue")):
        start = (middle[0], middle[1] + shift)
        figure.arrow(start, toward(start, sharp, 1.78 * math.dist(start, sharp)), f"{color} thin")
        figure.dot(start, color)
    figure.dot(sharp, "red", 5)
    figure.line((90, 226), (390, 226), "muted thin")
    figure.text((240, 243), "focal_distance, along the view", "small t-muted", "middle")
    figure.text((90, 46), "lens", "small", "middle")
    figure.text((398, 40), "plane of focus", "small t-muted")
    return figure


# Step 13: where a path goes on, and what it finds.


def lifted() -> Drawing:
    """Points of a disk, lifted to the half sphere above it; seen from the side."""
    figure = Drawing(
        640,
        300,
        "A disk lifted to a half sphere",
        "Points that lie evenly in a flat disk on the surface are lifted straight up to the half sphere above it. The "
        "arrows from the middle to the lifted points are the directions: many are steep, few are level.",
    )
    middle, radius = (320.0, 250.0), 200.0
    figure.rect((90, 250), 460, 16, "w-grey")
    figure.arc(middle, radius, 0, 180, "muted")
    figure.line((90, 250), (550, 250), "ink")
    for place in range(-9, 10, 2):
        x = place / 10
        foot = (middle[0] + radius * x, middle[1])
        tip = (foot[0], middle[1] - radius * math.sqrt(1 - x * x))
        figure.line(foot, tip, "muted thin dash")
        figure.arrow(middle, tip, "blue")
        figure.dot(foot, "red")
    figure.arrow(middle, (middle[0], middle[1] - radius - 34), "ink thick")
    figure.text((middle[0] + 10, middle[1] - radius - 22), "n", "math")
    figure.text((112, 288), "points of the disk, evenly spread", "small t-red")
    figure.text((430, 288), "directions", "small t-blue")
    return figure


def path() -> Drawing:
    """A path of three hits, with a light sample at each."""
    figure = Drawing(
        640,
        310,
        "What a path finds",
        "A room with a lamp in the ceiling. A path runs from the eye to the floor, to the left and the right wall, "
        "and then meets the lamp by chance. From each of the three hits a dashed line runs to a point of the lamp: the "
        "light samples. The last piece of the path, into the lamp, is crossed out: that light has come already.",
    )
    left, right, top, bottom = 70.0, 450.0, 30.0, 290.0
    figure.line((left, top), (left, bottom), "red thick")
    figure.line((right, top), (right, bottom), "green thick")
    figure.line((left, top), (right, top), "ink")
    figure.line((left, bottom), (right, bottom), "ink")
    figure.rect((230, top - 8), 90, 10, "w-red")
    figure.text((275, 18), "lamp", "small t-red", "middle")
    hits = [(310.0, bottom), (left, 170.0), (right, 120.0)]
    eye = (415.0, 225.0)
    figure.dot(eye, "green", 6)
    figure.text((408, 210), "eye", "small t-green")
    for start, end in zip([eye, *hits[:-1]], hits, strict=True):
        figure.arrow(start, end, "blue thick")
    figure.line(hits[2], (240.0, top + 3), "blue thick")
    cross = (345.0, 76.5)
    figure.line((cross[0] - 8, cross[1] - 8), (cross[0] + 8, cross[1] + 8), "ink thick")
    figure.line((cross[0] - 8, cross[1] + 8), (cross[0] + 8, cross[1] - 8), "ink thick")
    for hit, lamp in zip(hits, (285.0, 262.0, 312.0), strict=True):
        figure.line(hit, (lamp, top + 3), "red dash")
        figure.dot(hit)
    words = (
        ("the path", "t-blue"),
        ("light samples, each", "t-red"),
        ("times the weight there", "t-red"),
        ("crossed out: counted", ""),
        ("by the sample of the", ""),
        ("hit before it", ""),
    )
    for number, (line, color) in enumerate(words):
        figure.text((466, 78 + 26 * number + (12 if number > 2 else 0)), line, f"small {color}".strip())
    return figure


# Step 14: what a view sees of a rough surface.


def visible() -> Drawing:
    """The surface squeezed and stretched; seen from the side."""
    figure = Drawing(
        640,
        320,
        "Visible normals",
        "On the left half an ellipse: the bumps of a rough surface, seen from a flat angle. On the right the same, "
        "stretched until it is half a circle, seen from its stretched view. Across the view lies a disk, whose upper "
        "half is full and whose lower half is squeezed, as the ground cuts it off. Points of the disk are lifted along "
        "the view to the circle; arrows from the middle to the lifted points are the normals that are seen.",
    )
    radius, ground, alpha = 120.0, 226.0, 0.45
    flat, round_ = (150.0, ground), (470.0, ground)
    lean = math.radians(62.0)  # of the view, from straight up; stretched it is steeper
    stretched = math.atan(alpha * math.tan(lean))
    for middle, height, angle in ((flat, alpha, lean), (round_, 1.0, stretched)):
        figure.rect((middle[0] - 140, ground), 280, 14, "w-grey")
        outline = [
            (polar(middle, 3 * i, radius)[0], ground - radius * height * math.sin(math.radians(3 * i)))
            for i in range(61)
        ]
        figure.curve(outline)
        figure.line((middle[0] - 140, ground), (middle[0] + 140, ground), "muted")
        figure.arrow(middle, polar(middle, 90 - math.degrees(angle), 185.0 if height < 1 else 215.0), "green thick")
    sine, cosine = math.sin(stretched), math.cos(stretched)
    for place in (-0.9, -0.7, -0.5, -0.3, -0.1, 0.1, 0.3, 0.5, 0.7, 0.9):
        at = place if place > 0 else place * cosine
        up = math.sqrt(1 - at * at)
        foot = (round_[0] - radius * at * cosine, ground - radius * at * sine)
        tip = (foot[0] + radius * up * sine, foot[1] - radius * up * cosine)
        figure.line(foot, tip, "muted thin dash")
        figure.dot(foot, "red", 2.5)
        figure.arrow(round_, tip, "blue thin")
        x, z = alpha * (tip[0] - round_[0]) / radius, (ground - tip[1]) / radius
        size = math.hypot(x, z)
        start = (flat[0] + tip[0] - round_[0], ground - alpha * (ground - tip[1]))
        figure.arrow(start, (start[0] + 34 * x / size, start[1] - 34 * z / size), "blue thin")
    figure.line(
        (round_[0] - radius * cosine, ground - radius * sine),
        (round_[0] + radius * cosine * cosine, ground + radius * sine * cosine),
        "red",
    )
    figure.text((28, 34), "the surface's bumps, and their normals", "small t-blue")
    figure.text((340, 34), "stretched: a half sphere", "small t-blue")
    figure.text((272, 136), "view", "small t-green")
    figure.text((590, 46), "view", "small t-green")
    figure.text((556, 306), "seen of it: half a disk, and half a disk that is squeezed", "small t-red", "end")
    return figure
