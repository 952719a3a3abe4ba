"""Cases of step 01: points on rays; cameras and pixels have modules of their own."""

from raysteps.judge.answers import Answer, read_vector, words_of_vector
from raysteps.judge.comparing import LENGTHS, vector
from raysteps.judge.drawing import Draw
from raysteps.judge.functions import Function, Group
from raysteps.judge.generators.camera_frames import VIEW_FRAME
from raysteps.judge.generators.camera_pixels import PRIMARY_RAY
from raysteps.judge.numbers import Vector
from raysteps.judge.values import Inputs, Ray, Real

_POINT = Answer(read_vector, words_of_vector, lambda _, e, a: vector("the point", e, a, LENGTHS))
_AT_ORIGIN: Vector = (0.0, 0.0, 0.0)


def _simple_ray(draw: Draw) -> Ray:
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
        Group("far away", lambda d: _along(Ray(d.point(10), d.direction()), d.real(1e3, 1e5))),
        Group("distance 0", lambda d: _along(Ray(d.point(10), d.direction()), 0.0), telling=False),
    ),
)

FUNCTIONS = (_POINT_AT, VIEW_FRAME, PRIMARY_RAY)
