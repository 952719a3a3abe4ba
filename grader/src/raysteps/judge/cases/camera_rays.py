"""Cases of step 01: points on rays, what a camera sees, and the rays through its pixels."""

import math
from dataclasses import replace

from raysteps.common.vectors import Vector, add, cross, length, minus, times, unit
from raysteps.judge.answers import (
    LENGTHS,
    Answer,
    direction,
    first,
    read_frame,
    read_vector,
    real,
    share_right,
    vector,
    words_of_frame,
    words_of_vector,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.hits import ray_answer
from raysteps.judge.protocol import Camera, Frame, Inputs, Ray, Real, Whole, f32, rounded
from raysteps.judge.random_source import RandomSource

# Cases of step 01: cameras of all kinds, and the view frame of each.

_FRESH = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0))  # view and up of a ViewFrame that nobody filled in


def any_camera(draw: RandomSource) -> Camera:
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


def _upright(draw: RandomSource, camera: Camera) -> Camera:
    """With an up vector of length 1 at a right angle to the view."""
    view = minus(camera.at, camera.origin)
    return replace(camera, up=rounded(unit(cross(draw.across(unit(view)), view))))


def simple_camera(draw: RandomSource) -> Camera:
    """Looks along an axis, another axis is up, and the picture is square; never as a fresh ViewFrame does."""
    origin = draw.simple_point(5)
    view, up = draw.until(lambda axes: length(cross(*axes)) > 0 and axes != _FRESH, lambda: (draw.axis(), draw.axis()))
    size = 2 * draw.whole(2, 100)
    at = add(origin, view, float(draw.whole(1, 8)))
    angle = (45.0, 60.0, 90.0)[draw.whole(0, 2)]
    return Camera(origin, at, times(float(draw.whole(1, 3)), up), angle, size, size)


def _slanted_camera(draw: RandomSource) -> Camera:
    """Up leans by 20 to 70 degrees from a right angle."""
    camera = _upright(draw, any_camera(draw))
    view = unit(minus(camera.at, camera.origin))
    lean = draw.sign() * math.tan(math.radians(draw.real(20, 70)))
    return replace(camera, up=rounded(add(camera.up, view, lean)))


def long_camera(draw: RandomSource) -> Camera:
    camera = _upright(draw, any_camera(draw))
    long, short = draw.whole(150, 400), draw.whole(10, 60)
    width, height = (long, short) if draw.chance(0.5) else (short, long)
    return replace(camera, width=width, height=height)


def _angled_camera(draw: RandomSource) -> Camera:
    angle = draw.real(3, 20) if draw.chance(0.5) else draw.real(100, 150)
    return replace(_upright(draw, any_camera(draw)), angle=angle, width=100, height=100)


def _extreme_camera(draw: RandomSource) -> Camera:
    """Looks at something very near or far, with an up vector that is very short or long."""
    camera = any_camera(draw)
    view, up = unit(minus(camera.at, camera.origin)), unit(camera.up)
    origin = draw.simple_point(0.5)
    distance = draw.real(0.01, 0.05) if draw.chance(0.5) else draw.real(1e3, 1e4)
    size = draw.real(0.001, 0.01) if draw.chance(0.5) else draw.real(100, 1000)
    return replace(camera, origin=origin, at=rounded(add(origin, view, distance)), up=rounded(times(size, up)))


def with_lens(draw: RandomSource) -> Camera:
    """Its window is at distance 1 all the same, and not where it is sharp or begins to see."""
    lens = f32(draw.real(0.1, 0.9)), f32(draw.real(0.05, 0.5)), f32(draw.real(2, 9))
    return replace(any_camera(draw), lens=lens)


def _frame_problems(expected: Frame, actual: Frame) -> tuple[str, ...]:
    return (
        direction("forward", expected.forward, actual.forward),
        direction("right", expected.right, actual.right),
        direction("up", expected.up, actual.up),
        real("half_height", expected.half_height, actual.half_height),
        real("half_width", expected.half_width, actual.half_width),
    )


def _frame_credit(forward: str, *others: str) -> float:
    """All else follows from the direction of the view."""
    return 0.0 if forward else share_right(forward, *others)


VIEW_FRAME = Function(
    "view_frame",
    Answer(
        read_frame,
        words_of_frame,
        lambda _, expected, actual: first(*_frame_problems(expected, actual)),
        lambda _, expected, actual: _frame_credit(*_frame_problems(expected, actual)),
    ),
    (
        Group("any camera", lambda d: {"camera": any_camera(d)}),
        Group("simple numbers", lambda d: {"camera": simple_camera(d)}),
        Group("up leans", lambda d: {"camera": _slanted_camera(d)}),
        Group("wide and tall pictures", lambda d: {"camera": long_camera(d)}),
        Group("narrow and wide angles", lambda d: {"camera": _angled_camera(d)}),
        Group("very short and very long vectors", lambda d: {"camera": _extreme_camera(d)}),
        Group("a lens and a near plane", lambda d: {"camera": with_lens(d)}),
    ),
)


# Cases of step 01: the primary rays of pixels.


def _ray_problems(_inputs: Inputs, expected: Ray, actual: Ray) -> tuple[str, str]:
    return (
        direction("the direction", expected.direction, actual.direction, degrees=0.05),
        vector("the origin", expected.origin, actual.origin),
    )


def _frame_of(camera: Camera) -> Frame:
    forward = unit(minus(camera.at, camera.origin))
    right = unit(cross(forward, camera.up))
    half_height = math.tan(math.radians(camera.angle) / 2)
    return Frame(
        rounded(right),
        rounded(cross(right, forward)),
        rounded(forward),
        f32(half_height * camera.width / camera.height),
        f32(half_height),
    )


def _pixel(camera: Camera, x: int, y: int) -> Inputs:
    return {"camera": camera, "frame": _frame_of(camera), "x": Whole(x), "y": Whole(y)}


def _any_pixel(draw: RandomSource, camera: Camera) -> Inputs:
    return _pixel(camera, draw.whole(0, camera.width - 1), draw.whole(0, camera.height - 1))


def _corner(draw: RandomSource) -> Inputs:
    camera = any_camera(draw)
    return _pixel(camera, (camera.width - 1) * draw.whole(0, 1), (camera.height - 1) * draw.whole(0, 1))


def _middle(draw: RandomSource) -> Inputs:
    camera = replace(any_camera(draw), width=2 * draw.whole(1, 80) + 1, height=2 * draw.whole(1, 80) + 1)
    return _pixel(camera, camera.width // 2, camera.height // 2)


def _few_pixels(draw: RandomSource) -> Inputs:
    """Where half a pixel is a lot."""
    camera = replace(simple_camera(draw), width=draw.whole(2, 5), height=draw.whole(2, 5))
    return _any_pixel(draw, camera)


def _one_pixel_wide(draw: RandomSource) -> Inputs:
    """Or high, or both: who divides by the size less 1 divides by 0."""
    long = draw.whole(1, 60)
    width, height = ((1, long), (long, 1), (1, 1))[draw.whole(0, 2)]
    return _any_pixel(draw, replace(any_camera(draw), width=width, height=height))


PRIMARY_RAY = Function(
    "primary_ray",
    ray_answer(_ray_problems),
    (
        Group("any pixel", lambda d: _any_pixel(d, any_camera(d))),
        Group("few pixels", _few_pixels),
        Group("corners of the picture", _corner),
        Group("wide and tall pictures", lambda d: _any_pixel(d, long_camera(d))),
        Group("the middle pixel", _middle),
        Group("one pixel wide or high", _one_pixel_wide),
        Group("a lens and a near plane", lambda d: _any_pixel(d, with_lens(d))),
    ),
)


_POINT = Answer(read_vector, words_of_vector, lambda _, e, a: vector("the point", e, a, LENGTHS))
_AT_ORIGIN: Vector = (0.0, 0.0, 0.0)


def _simple_ray(draw: RandomSource) -> Ray:
    return Ray(draw.simple_point(5), draw.axis())


def _along(ray: Ray, distance: float) -> Inputs:
    return {"ray": ray, "distance": Real(distance)}


_POINT_AT = Function(
    "point_at",
    _POINT,
    (
        Group("any ray", lambda d: _along(Ray(d.point(10), d.direction()), d.real(0.5, 20))),
        Group("simple numbers", lambda d: _along(_simple_ray(d), d.eighths(1, 10))),
        Group("behind the origin", lambda d: _along(Ray(d.point(10), d.direction()), d.real(-20, -0.5))),
        Group("from the centre of the world", lambda d: _along(Ray(_AT_ORIGIN, d.direction()), d.real(0.5, 20))),
        Group("far away", lambda d: _along(Ray(d.point(10), d.direction()), d.logarithmic(1e3, 1e5))),
        Group("distance 0", lambda d: _along(Ray(d.point(10), d.direction()), 0.0)),
    ),
)

FUNCTIONS = (_POINT_AT, VIEW_FRAME, PRIMARY_RAY)
