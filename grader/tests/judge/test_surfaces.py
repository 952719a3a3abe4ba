"""Where a ray meets a surface, as far as the judge's cases must know it."""

import math

import pytest

from raysteps.judge.protocol import Ray
from raysteps.judge.surfaces import ScriptedSurface, Sphere, Surface, Triangle, distance_to, first_distance

pytestmark = pytest.mark.portable

_BALL = Sphere((0.0, 0.0, 0.0), 1.0)
_SHEET = Triangle((-1.0, -1.0, -3.0), (1.0, -1.0, -3.0), (0.0, 1.0, -3.0))
_DOWN = (0.0, 0.0, -1.0)


@pytest.mark.parametrize(
    ("surface", "ray", "distance"),
    [
        (_BALL, Ray((0.0, 0.0, 5.0), _DOWN), 4.0),
        (_BALL, Ray((0.0, 0.0, 0.0), _DOWN), 1.0),
        (_BALL, Ray((0.0, 0.0, -5.0), _DOWN), math.inf),
        (_BALL, Ray((1.5, 0.0, 5.0), _DOWN), math.inf),
        (_SHEET, Ray((0.0, 0.0, 5.0), _DOWN), 8.0),
        (_SHEET, Ray((0.9, 0.9, 5.0), _DOWN), math.inf),
        (_SHEET, Ray((0.0, 0.0, -5.0), _DOWN), math.inf),
        (_SHEET, Ray((0.0, 0.0, 5.0), (1.0, 0.0, 0.0)), math.inf),
        (ScriptedSurface(2.5), Ray((0.0, 0.0, 5.0), _DOWN), 2.5),
        (ScriptedSurface(None), Ray((0.0, 0.0, 5.0), _DOWN), math.inf),
    ],
)
def test_distances(surface: Surface, ray: Ray, distance: float) -> None:
    assert distance_to(surface, ray) == pytest.approx(distance)


def test_the_first_of_several() -> None:
    assert first_distance((_SHEET, _BALL), Ray((0.0, 0.0, 5.0), _DOWN)) == pytest.approx(4.0)
    assert first_distance((), Ray((0.0, 0.0, 5.0), _DOWN)) == math.inf
