"""Steps 03 to 05, 07 and 08: Phong's formula, the shadow ray and why it needs a threshold, mirrors in mirrors, how
light becomes brightness, and glass."""

import math

from tools.bench.charts import Axis, Chart, Series, linear_axis, log_axis, svg_text
from tools.figures.drawing import Drawing, Point, polar
from tools.figures.measuring import Measurement

_WIDE = 560.0


def phong() -> Drawing:
    """The four unit vectors at a hit."""
    figure = Drawing(
        640,
        320,
        "The directions at a hit",
        "Four arrows of length 1 start at the hit: l to the light, the normal n, r where the light would be "
        "mirrored to, and v to the eye. l and r make the same angle with n. The highlight is bright where v is "
        "close to r.",
    )
    hit: Point = (320, 255)
    figure.rect((60, 255), 520, 22, "w-grey")
    figure.line((60, 255), (580, 255), "ink")
    size = 165.0
    slant = math.degrees(math.asin(0.6))
    angles = {"l": 90 + slant, "n": 90.0, "r": 90 - slant, "v": 28.0}
    colors = {"l": "red", "n": "ink", "r": "blue", "v": "green"}
    for degrees in (60, 90 - slant):
        figure.arc(hit, 60, 90, 90 + slant if degrees == 60 else 90 - slant, "muted")
    figure.text(polar(hit, 90 + slant / 2, 74), "θ", "math", "middle")
    figure.text(polar(hit, 90 - slant / 2, 74), "θ", "math", "middle")
    figure.arc(hit, 96, angles["v"], angles["r"], "green")
    figure.text((446, 236), "v near r: bright", "small t-green")
    figure.line(polar(hit, angles["l"], size), polar(hit, angles["l"], size + 50), "red dash")
    figure.circle(polar(hit, angles["l"], size + 62), 11, "l w-red red")
    figure.text((polar(hit, angles["l"], size + 62)[0] - 20, 45), "light", "t-red", "end")
    figure.line(polar(hit, angles["v"], size), polar(hit, angles["v"], size + 60), "green dash")
    figure.dot(polar(hit, angles["v"], size + 72), "green", 6)
    figure.text((polar(hit, angles["v"], size + 72)[0], 124), "eye", "t-green", "middle")
    for name, degrees in angles.items():
        figure.arrow(hit, polar(hit, degrees, size), f"{colors[name]} thick")
        place = polar(hit, degrees + (8 if degrees > 90 else -7), size - 8)
        figure.text(place, name, f"math t-{colors[name]}" if colors[name] != "ink" else "math", "middle")
    figure.dot(hit, "ink", 5)
    figure.text((320, 304), "All four have length 1 and start at the hit.", "", "middle")
    return figure


def cosine() -> Drawing:
    """The same light on more ground."""
    figure = Drawing(
        640,
        210,
        "Flat light is thin light",
        "Left: a beam from straight above lights one unit of ground. Right: a beam of the same width at 60 degrees "
        "from the normal lights two units, so each gets half.",
    )
    ground = 150.0
    for left, slant, words in ((70.0, 0.0, "cos 0° = 1"), (390.0, 60.0, "cos 60° = 0.5")):
        width = 80 / math.cos(math.radians(slant))
        figure.rect((left - 40, ground), 260, 14, "w-grey")
        figure.line((left - 40, ground), (left + 220, ground), "ink")
        drift = math.tan(math.radians(slant)) * 60
        for i in range(5):
            x = left + 20 + width * i / 4
            figure.arrow((x - drift, ground - (120 if slant == 0 else 60)), (x, ground), "red thin")
        figure.line((left + 20, ground + 5), (left + 20 + width, ground + 5), "red thick")
        figure.text((left + 90, 192), words, "", "middle")
    return figure


def highlight() -> str:
    """The cosine to the power of shine."""
    series = []
    for shine in (1, 10, 50, 200):
        points = [(float(degrees), math.cos(math.radians(degrees)) ** shine) for degrees in range(91)]
        series.append(Series(f"shine {shine}", points, marked=False))
    x, y = Axis("angle between r and v, in degrees", 0.0, 90.0), Axis("share of ks", 0.0, 1.0)
    words = "All curves begin at 1 and fall to 0; with shine 1 slowly, at 90 degrees, with shine 200 within 15 degrees."
    return svg_text([Chart("the width of a highlight", x, y, series)], width=_WIDE, description=words, plate=True)


def shadow() -> Drawing:
    """What is in the way, and what is not."""
    figure = Drawing(
        640,
        330,
        "The shadow ray",
        "From a hit on the floor one ray goes to the light and reaches it: lit. From another hit the ray meets a "
        "ball before the light: in shadow. A wall behind the light does not matter, nor does a ball beside the way.",
    )
    light: Point = (330, 60)
    figure.rect((40, 270), 560, 20, "w-grey")
    figure.line((40, 270), (600, 270), "ink")
    figure.rect((300, 16), 130, 10, "w-grey l muted")
    figure.text((440, 26), "behind the light: no matter", "small t-muted")
    ball: Point = (400, 165)
    figure.circle(ball, 36, "l w-blue blue")
    figure.text((446, 160), "in the way", "t-blue")
    figure.circle((150, 130), 26, "l w-blue blue")
    figure.text((108, 92), "beside the way: no matter", "small t-muted", "middle")
    lit, dark = (200.0, 270.0), (452.0, 270.0)
    figure.arrow(lit, light, "green thick")
    way = math.dist(dark, light)
    along = ((light[0] - dark[0]) / way, (light[1] - dark[1]) / way)
    middle = (ball[0] - dark[0]) * along[0] + (ball[1] - dark[1]) * along[1]
    miss = math.dist(ball, (dark[0] + along[0] * middle, dark[1] + along[1] * middle))
    meets = middle - math.sqrt(36**2 - miss**2)
    stop = (dark[0] + along[0] * meets, dark[1] + along[1] * meets)
    figure.arrow(dark, stop, "red thick")
    figure.line(stop, light, "red thin dash")
    figure.circle(light, 10, "l w-red red")
    figure.text((346, 66), "light", "t-red")
    for place, color, words in ((lit, "green", "lit"), (dark, "red", "in shadow")):
        figure.dot(place, color, 5)
        figure.text((place[0], 312), words, f"t-{color}", "middle")
    return figure


def acne() -> Drawing:
    """The surface under a lens: where floats can lie, and where the ray starts."""
    figure = Drawing(
        640,
        330,
        "Acne, seen under a lens",
        "A slanted surface and the points that floats can tell apart, about a hundred-thousandth apart. Left: the "
        "nearest such point to the hit lies below the surface, and the shadow ray meets the surface at once. Right: "
        "moved along the normal by the threshold, the ray starts outside.",
    )
    slope = -0.18
    for left, good in ((20.0, False), (335.0, True)):
        base = 215.0

        def height(x: float, left: float = left, base: float = base) -> float:
            return base + slope * (x - left)

        figure.polygon(
            [(left, height(left)), (left + 285, height(left + 285)), (left + 285, 270), (left, 270)], "w-grey"
        )
        figure.line((left, height(left)), (left + 285, height(left + 285)), "ink thick")
        for column in range(10):
            for row in range(8):
                figure.dot((left + 15 + 28.0 * column, 60 + 28.0 * row), "muted", 1.5)
        rounded: Point = (left + 15 + 28.0 * 3, 60 + 28.0 * 5)
        exact: Point = (rounded[0] + 9, height(rounded[0] + 9))
        figure.dot(exact, "blue", 4)
        if good:
            start = (rounded[0] + 14, rounded[1] - 84)
            figure.arrow(rounded, start, "green thick")
            figure.arrow(start, (start[0] + 100, start[1] - 50), "ink")
            figure.dot(start, "green", 5)
            figure.text((start[0] - 12, start[1] + 22), "threshold,", "small t-green", "end")
            figure.text((start[0] - 12, start[1] + 38), "along the normal", "small t-green", "end")
        else:
            meets = (rounded[0] + 22.0, height(rounded[0] + 22.0))
            figure.arrow(rounded, (rounded[0] + 130, rounded[1] - 88), "ink dash")
            figure.line(rounded, meets, "red thick")
            figure.text((rounded[0] + 30, 222), "meets its own surface", "small t-red")
        figure.dot(rounded, "red", 5)
        figure.text((rounded[0] + 12, rounded[1] + 22), "hit, rounded", "small t-red", "end")
        figure.text((exact[0] - 12, exact[1] - 12), "exact hit" if not good else "", "small t-blue", "end")
    figure.text((160, 300), "start at the hit: dark for no reason", "t-red", "middle")
    figure.text((478, 300), "start off the surface: lit", "t-green", "middle")
    figure.text((320, 34), "dots: the places that a float can hold", "small t-muted", "middle")
    return figure


def thresholds(measured: Measurement) -> str:
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


def tree() -> Drawing:
    """The calls of trace, one below the other."""
    figure = Drawing(
        640,
        330,
        "A chain of rays",
        "The eye ray at depth 1 meets a mirror. Its reflected ray at depth 2 meets a second mirror, and the next "
        "one at depth 3 a third. Depth 4 is above the limit of 3 and gives black. Each hit also sends shadow rays "
        "to the lights. On the way back each colour is weighed with ks and added.",
    )
    figure.dot((50, 75), "ink", 6)
    figure.text((50, 108), "eye", "strong", "middle")
    places: list[Point] = [(190, 75), (340, 75), (490, 75)]
    previous: Point = (58, 75)
    for number, place in enumerate(places, 1):
        figure.arrow(previous, (place[0] - 28, 75), "ink thick")
        figure.text(((previous[0] + place[0] - 28) / 2, 62), f"depth {number}", "small", "middle")
        figure.rect((place[0] - 26, 52), 52, 46, "w-blue l blue")
        figure.text((place[0], 80), f"hit {number}", "small", "middle")
        figure.arrow((place[0] - 8, 98), (place[0] - 24, 140), "green thin")
        figure.arrow((place[0] + 8, 98), (place[0] + 24, 140), "green thin")
        figure.text((place[0], 158), "shadow rays", "small t-green", "middle")
        previous = (place[0] + 26, 75)
    figure.line(previous, (572, 75), "red dash")
    figure.text((545, 62), "depth 4", "small t-red", "middle")
    figure.text((604, 80), "black", "t-red", "middle")
    figure.text((604, 98), "(limit 3)", "small t-red", "middle")
    figure.text((40, 205), "on the way back (ks = 0.5, own light 1)", "small t-muted")
    sums = ["1 + 0.5 · 1.5 = 1.75", "1 + 0.5 · 1 = 1.5", "1 + 0.5 · 0 = 1"]
    for place, words in zip(places, sums, strict=True):
        figure.rect((place[0] - 70, 232), 140, 36, "w-red")
        figure.text((place[0], 255), words, "small", "middle")
    for left, right in ((places[0], places[1]), (places[1], places[2])):
        figure.arrow((right[0] - 70, 285), (left[0] + 10, 285), "red")
        figure.text(((left[0] + right[0]) / 2 - 30, 304), "times ks", "small t-red", "middle")
    figure.arrow((120, 250), (62, 250), "red")
    figure.text((50, 240), "pixel", "small t-red", "middle")
    return figure


def mirrored() -> Drawing:
    """Angle in is angle out."""
    figure = Drawing(
        640,
        250,
        "A mirrored direction",
        "The direction d comes down onto the surface. Its part along the surface stays; its part along the normal is "
        "turned round. The mirrored ray leaves at the same angle, and starts a little off the surface.",
    )
    hit: Point = (320, 190)
    figure.rect((60, 190), 520, 18, "w-grey")
    figure.line((60, 190), (580, 190), "ink")
    start, end = polar(hit, 143.1, 200), polar(hit, 36.9, 200)
    figure.arrow(start, hit, "red thick")
    figure.arrow(hit, end, "blue thick")
    figure.arrow(hit, (320, 50), "ink")
    figure.text((330, 58), "n", "math")
    figure.text((start[0] + 50, start[1] + 16), "d", "math t-red")
    figure.text((end[0] - 58, end[1] + 16), "mirrored", "t-blue", "end")
    figure.arc(hit, 60, 90, 143.1, "muted")
    figure.arc(hit, 60, 36.9, 90, "muted")
    figure.text(polar(hit, 116, 76), "θ", "math", "middle")
    figure.text(polar(hit, 64, 76), "θ", "math", "middle")
    figure.line((end[0], end[1]), (end[0], 190), "green dash")
    figure.text((end[0] + 8, 135), "turned round: 0.8", "small t-green")
    figure.arrow((322, 203), (end[0], 203), "green")
    figure.text((400, 230), "stays: 0.6", "small t-green", "middle")
    return figure


def bounces(measured: Measurement) -> str:
    """Rays per pixel against the ray depth."""
    found = measured["bounces"]
    y = linear_axis("rays per pixel", [value for rows in found.values() for _, value in rows])
    series = [Series(name, [(float(depth), float(value)) for depth, value in rows]) for name, rows in found.items()]
    chart = Chart("facing mirrors: what a deeper limit costs", Axis("greatest depth", 1.0, 10.0), y, series)
    words = "Rays per pixel grow with each level, less and less: only chains that stay between the mirrors go on."
    return svg_text([chart], width=_WIDE, description=words, plate=True)


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


def snell() -> Drawing:
    """Into glass, out of glass, and not out of it."""
    figure = Drawing(
        660,
        300,
        "Snell's law",
        "Left: into glass at 45 degrees, the ray goes on at 28.1 degrees from the normal. Middle: out of glass at "
        "30 degrees, it goes on at 48.6. Right: at 45 degrees inside it cannot leave and is mirrored: total "
        "internal reflection.",
    )
    for x, angle, out, words in (
        (115.0, 45.0, 28.13, "into glass: towards n"),
        (330.0, 30.0, 48.59, "out of it: away from n"),
        (545.0, 45.0, None, "45° > 41.8°: mirrored"),
    ):
        into = x < 200
        hit: Point = (x, 145)
        figure.rect((x - 100, 145 if into else 40), 200, 105, "w-blue")
        figure.line((x - 100, 145), (x + 100, 145), "blue")
        figure.line((x, 45), (x, 245), "muted dash thin")
        start = polar(hit, 90 + angle, 105)
        figure.arrow(start, hit, "red thick")
        figure.arc(hit, 42, 90, 90 + angle, "red")
        figure.text(polar(hit, 90 + angle / 2, 58), f"{angle:.0f}°", "small t-red", "middle")
        if out is None:
            figure.arrow(hit, polar(hit, 90 - angle, 105), "green thick")
            figure.arc(hit, 42, 45, 90, "green")
            figure.text(polar(hit, 67, 58), "45°", "small t-green", "middle")
        else:
            figure.arrow(hit, polar(hit, -90 + out, 105), "green thick")
            figure.arc(hit, 42, -90, -90 + out, "green")
            spot = polar(hit, -90 + out / 2, 62)
            left = (x - 8, spot[1]) if into else (spot[0] + 3, spot[1] + 6)
            figure.text(left, f"{out:.1f}°", "small t-green", "end" if into else "middle")
        figure.text((x + 96, 138 if into else 240), "air, 1", "small t-muted", "end")
        glass = (x - 94, 240) if into else (x + 96, 58)
        figure.text(glass, "glass, 1.5", "small t-muted", "start" if into else "end")
        figure.text((x, 278), words, "", "middle")
    return figure


def glass_ball() -> Drawing:
    """Two rays through a ball cross: the world behind it stands on its head."""
    figure = Drawing(
        640,
        280,
        "Why a glass ball turns the world upside down",
        "Two parallel rays enter a ball of glass, one above and one below the middle. Each bends towards the normal "
        "on the way in and away from it on the way out; behind the ball they cross, so top and bottom change "
        "places.",
    )
    center, radius, index = (250.0, 140.0), 90.0, 1.5
    figure.circle(center, radius, "l w-blue blue")
    figure.line((40, 140), (600, 140), "muted dash thin")
    for offset, color in ((55.0, "red"), (-55.0, "green")):
        first = math.asin(offset / radius)
        second = math.asin(math.sin(first) / index)
        enter = 180 - math.degrees(first)
        leave = enter - 180 + 2 * math.degrees(second)
        one, two = polar(center, enter, radius), polar(center, leave, radius)
        away = -2 * (math.degrees(first) - math.degrees(second))
        figure.arrow((40, one[1]), one, f"{color} thick")
        figure.arrow(one, two, f"{color} thick")
        figure.arrow(two, polar(two, away, 270), f"{color} thick")
    figure.text((250, 262), "index 1.5", "small t-blue", "middle")
    figure.text((60, 30), "seen above", "small t-red")
    figure.text((60, 254), "seen below", "small t-green")
    figure.text((512, 44), "is above", "small t-green", "end")
    figure.text((512, 246), "is below", "small t-red", "end")
    return figure
