"""Steps 01 and 02: the window before the eye, where a ray meets a sphere, and when a point is inside a triangle."""

import math

from tools.figures.drawing import Drawing, Point, polar, toward


def window() -> Drawing:
    """A slanted view of eye, window and one ray."""
    figure = Drawing(
        640,
        330,
        "The window before the eye",
        "A window of 4 by 2 pixels stands one unit before the eye. A ray runs from the eye through the centre of "
        "pixel (3, 0) into the scene. Arrows in the middle of the window show forward, right and up.",
    )
    eye: Point = (120, 268)
    low, high, right_low, right_high = (250.0, 195.0), (250.0, 45.0), (450.0, 255.0), (450.0, 105.0)

    def at(across: float, down: float) -> Point:
        """Shares of the window from its upper left corner."""
        left = (high[0], high[1] + (low[1] - high[1]) * down)
        right = (right_high[0], right_high[1] + (right_low[1] - right_high[1]) * down)
        return left[0] + (right[0] - left[0]) * across, left[1] + (right[1] - left[1]) * across

    for corner in (high, low, right_low, right_high):
        figure.line(eye, corner, "muted thin dash")
    figure.polygon([high, right_high, right_low, low], "l w-blue muted")
    for i in range(1, 4):
        figure.line(at(i / 4, 0), at(i / 4, 1), "muted thin")
    figure.line(at(0, 0.5), at(1, 0.5), "muted thin")
    figure.polygon([at(0.75, 0), at(1, 0), at(1, 0.5), at(0.75, 0.5)], "w-red l red thin")
    for row in (0.25, 0.75):
        for i in range(4):
            figure.dot(at((i + 0.5) / 4, row), "muted", 2.5)
    middle, target = at(0.5, 0.5), at(0.875, 0.25)
    figure.arrow(eye, toward(eye, middle, math.dist(eye, middle) + 75), "ink")
    figure.text((404, 104), "forward", "small", "end")
    figure.arrow(middle, at(0.72, 0.5), "blue thick")
    figure.text((384, 192), "right", "small t-blue", "end")
    figure.arrow(middle, at(0.5, 0.2), "green thick")
    figure.text((344, 98), "up", "small t-green", "end")
    figure.line(eye, target, "red thick")
    figure.arrow(target, toward(eye, target, math.dist(eye, target) + 100), "red thick")
    figure.dot(target, "red", 4)
    figure.text((524, 80), "ray of (3, 0)", "t-red", "middle")
    figure.dot(eye, "ink", 6)
    figure.text((80, 266), "eye", "strong")
    figure.text((72, 284), "(from)", "small t-muted")
    figure.text((350, 32), "the window, 1 unit before the eye", "small t-muted", "middle")
    figure.text((320, 312), "Through the centre of each pixel goes one ray, from the eye into the scene.", "", "middle")
    return figure


def from_the_side() -> Drawing:
    """The right-angled triangle of half_height, and the grid of 4 x 2 pixels with its two axes."""
    figure = Drawing(
        640,
        280,
        "Half height, and where the pixels lie",
        "Left: from the side, half the angle, the distance 1 and half_height form a right-angled triangle. Right: 4 "
        "by 2 pixels; across runs from -1 to 1, upwards from 1 down to -1; the centre of pixel (3, 0) is at (0.75, "
        "0.5).",
    )
    eye: Point = (40, 140)
    wall = 210.0
    figure.polygon([eye, (wall, 140), (wall, 45)], "w-blue")
    figure.line(eye, (wall + 25, 140), "muted dash")
    figure.line(eye, (wall + 14, 37.2), "ink")
    figure.line(eye, (wall + 14, 242.8), "ink")
    figure.line((wall, 45), (wall, 235), "blue thick")
    figure.arc(eye, 46, 0, 29.2, "red")
    figure.text((96, 130), "angle / 2", "small t-red")
    figure.dot(eye, "ink", 5)
    figure.text((24, 166), "eye", "strong")
    figure.text((140, 158), "1", "", "middle")
    figure.text((wall + 8, 98), "half_height", "t-blue")
    figure.text((130, 270), "from the side", "small t-muted", "middle")
    left, top, side = 392.0, 70.0, 56.0
    figure.rect((left + 3 * side, top), side, side, "w-red")
    for i in range(5):
        figure.line((left + i * side, top), (left + i * side, top + 2 * side), "muted")
    for i in range(3):
        figure.line((left, top + i * side), (left + 4 * side, top + i * side), "muted")
    for x in range(4):
        for y in range(2):
            place = (left + (x + 0.5) * side, top + (y + 0.5) * side)
            figure.dot(place, "red" if (x, y) == (3, 0) else "muted", 4 if (x, y) == (3, 0) else 3)
            figure.text((place[0], place[1] + 20), f"({x}, {y})", "small t-muted", "middle")
    for share, word in ((0, "-1"), (0.5, "0"), (1, "1")):
        figure.text((left + 4 * side * share, top - 12), word, "small t-blue", "middle")
        figure.text((left - 12, top + 2 * side * (1 - share) + 4), word, "small t-blue", "end")
    figure.text((left + 2 * side, top - 34), "across", "t-blue", "middle")
    figure.text((left - 40, top + side + 4), "upwards", "t-blue", "end")
    figure.text((left + 2 * side, 212), "pixel (3, 0): across 0.75, upwards 0.5", "t-red", "middle")
    figure.text((left + 2 * side, 270), "from the eye", "small t-muted", "middle")
    return figure


def ray_points() -> Drawing:
    """A ray as a ruler."""
    figure = Drawing(
        640,
        150,
        "A ray is a ruler in space",
        "A ray starts at its origin and has a direction of length 1. The number on the ruler is the distance: 0 at "
        "the origin, 1 at the end of the direction, negative numbers behind the origin.",
    )
    origin: Point = (170, 100)

    def at(distance: float) -> Point:
        return polar(origin, 9, 105 * distance)

    figure.line(at(-1.25), origin, "muted dash")
    figure.arrow(origin, at(4.1), "ink")
    for distance in (-1, 1, 2, 3):
        figure.dot(at(distance), "muted")
        figure.text((at(distance)[0], at(distance)[1] + 22), str(distance), "small t-muted", "middle")
    figure.arrow(origin, at(1), "red thick")
    figure.dot(origin, "ink", 5)
    figure.text((origin[0], origin[1] + 24), "0", "small t-muted", "middle")
    figure.text((origin[0], origin[1] - 14), "origin", "strong", "middle")
    figure.text((at(0.62)[0], at(0.62)[1] - 16), "direction", "t-red")
    figure.text((at(3)[0] - 4, at(3)[1] - 14), "point_at(ray, 3)", "", "middle")
    return figure


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
