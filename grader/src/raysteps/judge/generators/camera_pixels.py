"""Cases of step 01: the primary rays of pixels."""

import math
from dataclasses import replace

from raysteps.judge.answers import Answer, first, read_ray, words_of_ray
from raysteps.judge.comparing import direction, vector
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.camera_frames import any_camera, long_camera, simple_camera
from raysteps.judge.numbers import cross, f32, minus, rounded, unit
from raysteps.judge.values import Camera, Frame, Inputs, Ray, Whole


def _ray_problem(_inputs: Inputs, expected: Ray, actual: Ray) -> str:
    return first(
        vector("the origin", expected.origin, actual.origin),
        direction("the direction", expected.direction, actual.direction, degrees=0.05),
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


def _any_pixel(draw: Draw, camera: Camera) -> Inputs:
    return _pixel(camera, draw.whole(0, camera.width - 1), draw.whole(0, camera.height - 1))


def _corner(draw: Draw) -> Inputs:
    camera = any_camera(draw)
    return _pixel(camera, (camera.width - 1) * draw.whole(0, 1), (camera.height - 1) * draw.whole(0, 1))


def _middle(draw: Draw) -> Inputs:
    camera = replace(any_camera(draw), width=2 * draw.whole(1, 80) + 1, height=2 * draw.whole(1, 80) + 1)
    return _pixel(camera, camera.width // 2, camera.height // 2)


def _few_pixels(draw: Draw) -> Inputs:
    """Where half a pixel is a lot."""
    camera = replace(simple_camera(draw), width=draw.whole(2, 5), height=draw.whole(2, 5))
    return _any_pixel(draw, camera)


def _one_pixel_wide(draw: Draw) -> Inputs:
    """Or high, or both: who divides by the size less 1 divides by 0."""
    long = draw.whole(1, 60)
    width, height = ((1, long), (long, 1), (1, 1))[draw.whole(0, 2)]
    return _any_pixel(draw, replace(any_camera(draw), width=width, height=height))


PRIMARY_RAY = Function(
    "primary_ray",
    Answer(read_ray, words_of_ray, _ray_problem),
    (
        Group("any pixel", lambda d: _any_pixel(d, any_camera(d))),
        Group("few pixels", _few_pixels, telling=False),
        Group("corners of the picture", _corner),
        Group("wide and tall pictures", lambda d: _any_pixel(d, long_camera(d))),
        Group("the middle pixel", _middle, telling=False),
        Group("one pixel wide or high", _one_pixel_wide, telling=False),
    ),
)
