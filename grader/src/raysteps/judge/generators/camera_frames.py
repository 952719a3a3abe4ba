"""Cases of step 01: cameras of all kinds, and the view frame of each."""

import math
from dataclasses import replace

from raysteps.judge.answers import Answer, first, read_frame, words_of_frame
from raysteps.judge.comparing import direction, real
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.numbers import add, cross, length, minus, rounded, times, unit
from raysteps.judge.values import Camera, Frame, Inputs

_FRESH = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0))  # view and up of a ViewFrame that nobody filled in


def any_camera(draw: Draw) -> Camera:
    origin, view = draw.point(10), draw.direction()
    up = draw.until(lambda found: length(cross(found, view)) >= 0.25, draw.direction)
    return Camera(
        origin,
        rounded(add(origin, view, draw.real(0.5, 20))),
        rounded(times(draw.real(0.3, 4), up)),
        draw.real(20, 110),
        draw.whole(20, 200),
        draw.whole(20, 200),
    )


def _upright(draw: Draw, camera: Camera) -> Camera:
    """With an up vector of length 1 at a right angle to the view."""
    view = minus(camera.at, camera.origin)
    return replace(camera, up=rounded(unit(cross(draw.across(unit(view)), view))))


def simple_camera(draw: Draw) -> Camera:
    """Looks along an axis, another axis is up, and the picture is square; never as a fresh ViewFrame does."""
    origin = draw.simple_point(5)
    view, up = draw.until(lambda axes: length(cross(*axes)) > 0 and axes != _FRESH, lambda: (draw.axis(), draw.axis()))
    size = 2 * draw.whole(2, 100)
    at = add(origin, view, float(draw.whole(1, 8)))
    angle = (45.0, 60.0, 90.0)[draw.whole(0, 2)]
    return Camera(origin, at, times(float(draw.whole(1, 3)), up), angle, size, size)


def _slanted_camera(draw: Draw) -> Camera:
    """Up leans by 20 to 70 degrees from a right angle."""
    camera = _upright(draw, any_camera(draw))
    view = unit(minus(camera.at, camera.origin))
    lean = draw.sign() * math.tan(math.radians(draw.real(20, 70)))
    return replace(camera, up=rounded(add(camera.up, view, lean)))


def long_camera(draw: Draw) -> Camera:
    camera = _upright(draw, any_camera(draw))
    long, short = draw.whole(150, 400), draw.whole(10, 60)
    width, height = (long, short) if draw.chance(0.5) else (short, long)
    return replace(camera, width=width, height=height)


def _angled_camera(draw: Draw) -> Camera:
    angle = draw.real(3, 20) if draw.chance(0.5) else draw.real(100, 150)
    return replace(_upright(draw, any_camera(draw)), angle=angle, width=100, height=100)


def _extreme_camera(draw: Draw) -> Camera:
    """Looks at something very near or far, with an up vector that is very short or long."""
    camera = any_camera(draw)
    view, up = unit(minus(camera.at, camera.origin)), unit(camera.up)
    origin = draw.simple_point(0.5)
    distance = draw.real(0.01, 0.05) if draw.chance(0.5) else draw.real(1e3, 1e4)
    size = draw.real(0.001, 0.01) if draw.chance(0.5) else draw.real(100, 1000)
    return replace(camera, origin=origin, at=rounded(add(origin, view, distance)), up=rounded(times(size, up)))


def _frame_problem(_inputs: Inputs, expected: Frame, actual: Frame) -> str:
    return first(
        direction("forward", expected.forward, actual.forward),
        direction("right", expected.right, actual.right),
        direction("up", expected.up, actual.up),
        real("half_height", expected.half_height, actual.half_height),
        real("half_width", expected.half_width, actual.half_width),
    )


VIEW_FRAME = Function(
    "view_frame",
    Answer(read_frame, words_of_frame, _frame_problem),
    (
        Group("any camera", lambda d: {"camera": any_camera(d)}),
        Group("simple numbers", lambda d: {"camera": simple_camera(d)}),
        Group("up leans", lambda d: {"camera": _slanted_camera(d)}),
        Group("wide and tall pictures", lambda d: {"camera": long_camera(d)}),
        Group("narrow and wide angles", lambda d: {"camera": _angled_camera(d)}),
        Group("very short and very long vectors", lambda d: {"camera": _extreme_camera(d)}),
    ),
)
