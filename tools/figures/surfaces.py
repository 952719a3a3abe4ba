"""Step 02: where a ray meets a sphere, and when a point is inside a triangle."""

import math

from tools.figures.drawing import Drawing, Point


def sphere() -> Drawing:
    """Two distances, the half chord between them, and an eye inside."""
    figure = Drawing(
        640,
        320,
        "A ray and a sphere",
        "Left: the ray enters the sphere at the near distance and leaves it at the far one; half way between them "
        "lies the point that is closest to the centre. Right: from inside, near is negative and far is the hit.",
    )
    center, radius, height = (270.0, 165.0), 92.0, 110.0
    half = math.sqrt(radius**2 - (center[1] - height) ** 2)
    near, far, closest = (center[0] - half, height), (center[0] + half, height), (center[0], height)
    origin: Point = (40, height)
    figure.circle(center, radius, "l w-blue blue")
    figure.line(center, origin, "muted dash")
    figure.text((96, 158), "m = origin - centre", "small t-muted", "middle")
    figure.line(center, closest, "green")
    figure.line(center, far, "muted thin")
    figure.text((318, 152), "radius", "small t-muted")
    figure.arrow(origin, (425, height), "ink")
    figure.line(closest, far, "red thick")
    figure.text((306, height + 17), "half chord", "small t-red", "middle")
    for place, word in ((near, "near"), (far, "far")):
        figure.dot(place, "red", 4.5)
        figure.text((place[0] + (-26 if word == "near" else 22), height - 12), word, "t-red", "middle")
    figure.text((266, height - 12), "closest", "small t-green", "middle")
    figure.dot(closest, "green", 3.5)
    figure.dot(origin, "ink", 5)
    figure.text((40, height - 14), "origin", "strong", "middle")
    figure.dot(center, "blue", 4)
    figure.text((center[0], center[1] + 20), "centre", "t-blue", "middle")
    figure.text((230, 300), "outside: 0 < near < far, near counts", "", "middle")
    inner: Point = (540, 165)
    figure.circle(inner, 62, "l w-blue blue")
    figure.line((440, 148), (522, 148), "muted dash")
    figure.arrow((522, 148), (628, 148), "ink")
    figure.dot((522, 148), "ink", 5)
    for x, word, color in ((480.3, "near < 0", "muted"), (599.7, "far", "red")):
        figure.dot((x, 148), color, 4.5)
        figure.text(
            (x - 4 if color == "muted" else x, 136), word, f"small t-{color}", "end" if color == "muted" else "start"
        )
    figure.text((522, 172), "origin", "small strong", "middle")
    figure.text((540, 300), "inside: far counts", "", "middle")
    return figure


def triangle() -> Drawing:
    """The plane first, then the three edges."""
    figure = Drawing(
        640,
        330,
        "Same side of all three edges",
        "The ray meets the plane of the triangle at a point. Left: the point is on the inner side of ab, bc and ca: "
        "a hit. Right: the point is on the outer side of bc: a miss.",
    )
    for left, point, inside in ((40.0, (155.0, 190.0), True), (350.0, (255.0 - 10, 140.0), False)):
        a, b, c = (left + 10, 250.0), (left + 225, 225.0), (left + 120, 60.0)
        figure.polygon([a, b, c], "l w-blue blue")
        for start, end in ((a, b), (b, c), (c, a)):
            middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
            way = math.dist(start, end)
            inwards = ((end[1] - start[1]) / way, (start[0] - end[0]) / way)
            tip = (middle[0] + 30 * inwards[0], middle[1] + 30 * inwards[1])
            bad = not inside and (start, end) == (b, c)
            figure.arrow(middle, tip, "red" if bad else "green")
            if bad:
                figure.line(start, end, "red thick")
        for place, word, dx, dy in ((a, "a", -14, 10), (b, "b", 14, 10), (c, "c", 0, -10)):
            figure.text((place[0] + dx, place[1] + dy), word, "strong", "middle")
        place = (left + point[0] - 40, point[1])
        figure.dot(place, "green" if inside else "red", 5)
        figure.text((place[0] + 12, place[1] + 5), "p", "strong")
        words = "inner side of all three: a hit" if inside else "outer side of bc: a miss"
        figure.text((left + 120, 295), words, "t-green" if inside else "t-red", "middle")
    figure.text((320, 318), "a, b, c run counter-clockwise as seen from the front", "small t-muted", "middle")
    return figure


def normal() -> Drawing:
    """The normal is turned to the side that the ray came from."""
    figure = Drawing(
        640,
        200,
        "The normal faces the ray",
        "Left: the ray comes from outside; the normal points away from the centre, front_face is true. Right: the "
        "ray comes from inside; the normal is turned round and points to the centre, front_face is false.",
    )
    for x, inside in ((165.0, False), (475.0, True)):
        center: Point = (x, 190)
        hit: Point = (x, 90)
        figure.arc(center, 100, 25, 155, "blue")
        start: Point = (x - 62, 162) if inside else (x - 85, 26)
        figure.arrow(start, hit, "ink")
        figure.arrow(hit, (x, 145 if inside else 35), "red thick")
        figure.text((x + 10, 136 if inside else 42), "normal", "t-red")
        figure.text((start[0] + 4, start[1] + (18 if inside else -6)), "ray", "small")
        figure.dot(hit, "blue", 4)
        figure.text((x + 24, 78), "front_face: " + ("false" if inside else "true"), "small")
    return figure
