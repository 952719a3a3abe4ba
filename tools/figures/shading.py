"""Steps 03 and 04: the directions of Phong's formula, the shadow ray, and why it needs a threshold."""

import math

from tools.figures.drawing import Drawing, Point, polar


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
