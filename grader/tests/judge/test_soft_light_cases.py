"""The judge of step 12: right points pass whatever the mapping, wrong ones are told in words."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from raysteps.common.vectors import cross, unit
from raysteps.judge.counterexamples import is_same_kind
from raysteps.judge.functions import Function, functions_of
from raysteps.judge.protocol import Frame, Inputs, Ray, real_of, vec_of
from raysteps.judge.random_source import RandomSource
from raysteps.judge.statistics import Numbers, UnevenProblem

pytestmark = pytest.mark.portable

_FUNCTIONS = functions_of("12")


def _problem(function: Function, inputs: Inputs, rows: Numbers) -> str:
    """What the judge says of these answers; the first comes once more at the end."""
    line = " ".join(repr(float(np.float32(number))) for number in np.vstack([rows, rows[:1]]).ravel())
    answer = function.answer.parse(line)
    return function.answer.problem(inputs, answer, answer)


def _inputs(name: str, group: str, seed: int = 1) -> Inputs:
    return _FUNCTIONS[name].by_name[group].make(RandomSource(f"{name}/{group}/{seed}"))


def _disk(radius: Numbers, turn: Numbers) -> Numbers:
    return np.stack([radius * np.cos(2 * math.pi * turn), radius * np.sin(2 * math.pi * turn)], axis=1)


_Mapping = Callable[[Numbers, Numbers], Numbers]
_DISKS: dict[str, tuple[_Mapping, str]] = {
    "polar": (lambda x, y: _disk(np.sqrt(x), y), ""),
    "the other number first": (lambda x, y: _disk(np.sqrt(1 - y), x + 0.25), ""),
    "plain radius": (lambda x, y: _disk(x, y), "too many points lie near the middle"),
    "cube root": (lambda x, y: _disk(np.cbrt(x), y), "too many points lie near the rim"),
    "half a turn": (lambda x, y: _disk(np.sqrt(x), y / 2), "some sides get more points than others"),
    "columns": (
        lambda x, y: np.stack([2 * x - 1, (2 * y - 1) * np.sqrt(1 - (2 * x - 1) ** 2)], axis=1),
        "too many points lie near the rim, and some sides get more points than others",
    ),
    "a spiral": (lambda x, _: _disk(np.sqrt(x), x), "the two random numbers have to do with each other"),
    "a square": (lambda x, y: np.stack([2 * x - 1, 2 * y - 1], axis=1), "a point lies outside of the disk"),
    "no number": (lambda x, y: np.stack([x / 0, y], axis=1), "a point is infinite or NaN"),
}


@pytest.mark.parametrize("name", _DISKS)
@pytest.mark.filterwarnings("ignore:divide by zero")
def test_points_of_a_disk_are_told_by_where_they_crowd(name: str) -> None:
    mapping, said = _DISKS[name]
    numbers = np.random.default_rng(12).random((2, 2048))
    assert _problem(_FUNCTIONS["unit_disk"], _inputs("unit_disk", "many points"), mapping(*numbers)) == said


def test_where_points_crowd_is_told_alike_whatever_the_numbers() -> None:
    """A disk that is a little too small is found for certain, and hardly more by its mean than by its rings."""
    inputs, draw = _inputs("unit_disk", "many points"), np.random.default_rng(5)
    numbers = [draw.random((2, 2048)) for _ in range(10)]
    problems = {
        _problem(_FUNCTIONS["unit_disk"], inputs, _disk(0.95 * np.sqrt(radius), y))
        for x, y in numbers
        for radius in (x, 1 - x)
    }
    assert problems == {"too many points lie near the middle"}


def test_the_histogram_of_a_disk_has_its_rings_from_the_middle_to_the_rim() -> None:
    x, y = np.random.default_rng(12).random((2, 2048))
    problem = _problem(_FUNCTIONS["unit_disk"], _inputs("unit_disk", "many points"), _disk(x, y))
    assert isinstance(problem, UnevenProblem)
    counts = problem.histogram.counts
    assert sum(counts) == 2048
    assert counts[0] > 3 * 2048 / 16 > 3 * counts[-1]  # a quarter of all within a sixteenth of the area


def test_right_points_pass_whatever_the_numbers() -> None:
    draw = np.random.default_rng(7)
    inputs = _inputs("unit_disk", "many points")
    for _ in range(300):
        x, y = draw.random((2, 2048))
        assert not _problem(_FUNCTIONS["unit_disk"], inputs, _disk(np.sqrt(x), y))


def test_the_same_u_gives_the_same_answer() -> None:
    inputs = _inputs("unit_disk", "corners of the square")
    line = " ".join(["0.1 0.2"] * 16 + ["0.2 0.1"])
    answer = _FUNCTIONS["unit_disk"].answer.parse(line)
    assert _FUNCTIONS["unit_disk"].answer.problem(inputs, answer, answer) == "the same u gave another answer"


def _triangle_samples(inputs: Inputs, u: Numbers, **wrong: float) -> Numbers:
    a, b, c, eye = (np.array(inputs[name].numbers()) for name in ("a", "b", "c", "from"))
    root = np.sqrt(u[:, :1])
    positions = (1 - root) * a + root * (1 - u[:, 1:]) * b + root * u[:, 1:] * c
    across = np.cross(b - a, c - a)
    normal = across / np.linalg.norm(across) * wrong.get("turned", 1.0)
    back = eye - positions
    distances = np.linalg.norm(back, axis=1)
    cosines = back @ (across / np.linalg.norm(across)) / distances
    pdf = wrong.get("factor", 1.0) * distances ** wrong.get("power", 2.0) * 2 / np.linalg.norm(across) / cosines
    return np.hstack([positions, np.tile(normal, (len(u), 1)), np.maximum(pdf, 0)[:, None]])


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({}, ""),
        ({"turned": -1.0}, "a normal points to the dark side"),
        ({"factor": 0.5}, "pdf is too small, by the same factor for all points: it is 0.5 times what it should be"),
        ({"factor": 0.0}, "pdf is 0 where light is seen"),
        ({"power": 1.0}, "pdf is too small, and not by the same factor for all points"),
    ],
)
def test_densities_are_told_by_how_they_are_wrong(wrong: dict[str, float], said: str) -> None:
    inputs = _inputs("sample_triangle", "a few samples")
    u = np.random.default_rng(3).random((8, 2))
    function = _FUNCTIONS["sample_triangle"]
    assert _problem(function, inputs, _triangle_samples(inputs, u, **wrong)) == said


def test_one_point_for_all_is_no_sample() -> None:
    inputs = _inputs("sample_triangle", "a few samples")
    rows = _triangle_samples(inputs, np.full((8, 2), 0.5))
    assert _problem(_FUNCTIONS["sample_triangle"], inputs, rows) == "different u give the same point"
    off = "a point lies above or below the triangle, not in its plane, the same for every u"
    assert _problem(_FUNCTIONS["sample_triangle"], inputs, rows + 9.0) == off


def _of_a_triangle(x: Numbers, y: Numbers) -> str:
    """What is said of points with these shares of the two sides at the first corner."""
    inputs = _inputs("sample_triangle", "many samples")
    a, b, c = (np.array(inputs[name].numbers()) for name in ("a", "b", "c"))
    rows = _triangle_samples(inputs, np.full((len(x), 2), 0.5))
    rows[:, :3] = a + x[:, None] * (b - a) + y[:, None] * (c - a)
    return _problem(_FUNCTIONS["sample_triangle"], inputs, rows)


def test_points_beyond_a_triangle_are_told_by_where_they_lie() -> None:
    x, y = np.random.default_rng(12).random((2, 2048))
    outside = x + y > 1
    in_its_plane = "a point lies in the triangle's plane, but beyond "
    assert "beyond" not in _of_a_triangle(np.where(outside, 1 - x, x), np.where(outside, 1 - y, y))
    assert _of_a_triangle(x, y) == in_its_plane + "a side"
    folded = in_its_plane + "one half of the side opposite to its first corner"
    assert _of_a_triangle(np.where(outside, 1 - x, x), y) == folded
    assert _of_a_triangle(x, np.where(outside, 1 - y, y)) == folded


def test_a_disk_that_stands_upright_on_its_place_is_told() -> None:
    inputs = _inputs("sample_disk", "many samples")
    center, normal = (np.array(inputs[name].numbers()) for name in ("center", "normal"))
    side = np.array(unit(cross(tuple(normal), (0.6, 0.0, 0.8))))
    points = real_of(inputs, "radius") * _disk(np.sqrt(np.linspace(0.001, 0.99, 2048)), np.arange(2048) / 10)
    off = "the points lie around the disk's centre, but not in its plane"
    slanting = 0.8 * np.cross(normal, side) + 0.6 * normal
    for second, said in ((normal, f"{off}, in one that stands upright on it"), (slanting, off)):
        places = center + points[:, :1] * side + points[:, 1:] * second
        rows = np.hstack([places, np.tile(normal, (2048, 1)), np.ones((2048, 1))])
        assert _problem(_FUNCTIONS["sample_disk"], inputs, rows) == said


def test_a_wrong_density_leaves_right_points_a_part_of_their_credit() -> None:
    inputs = _inputs("sample_triangle", "a few samples")
    rows = _triangle_samples(inputs, np.random.default_rng(3).random((8, 2)), factor=0.5)
    answer = _FUNCTIONS["sample_triangle"].answer
    found = answer.parse(" ".join(repr(float(n)) for n in np.vstack([rows, rows[:1]]).ravel()))
    assert answer.credit(inputs, found, found) == pytest.approx(2 / 3)
    moved = answer.parse(" ".join(repr(float(n)) for n in (np.vstack([rows, rows[:1]]) + 9.0).ravel()))
    assert answer.credit(inputs, moved, moved) == 0


def test_a_wrong_factor_may_be_another_in_a_smaller_case() -> None:
    function, inputs = _FUNCTIONS["sample_triangle"], _inputs("sample_triangle", "a few samples")
    u = np.random.default_rng(4).random((8, 2))
    half, quarter, tiny, hardly = (
        _problem(function, inputs, _triangle_samples(inputs, u, factor=factor)) for factor in (0.5, 0.25, 1e-6, 1.005)
    )
    assert half != quarter
    assert is_same_kind(half, quarter)
    assert not is_same_kind(half, hardly)
    assert tiny == "pdf is too small, by the same factor for all points"
    assert hardly == "pdf is too large, by the same factor for all points"


def _lens_rays(inputs: Inputs, spokes: Numbers) -> Numbers:
    """From there on, beside the middle of the lens, to what is sharp."""
    frame, ray = inputs["frame"], inputs["ray"]
    assert isinstance(frame, Frame)
    assert isinstance(ray, Ray)
    forward, way, middle = (np.array(v) for v in (frame.forward, ray.direction, ray.origin))
    ways = middle + way * (real_of(inputs, "focal_distance") / (way @ forward)) - (middle + spokes)
    return np.hstack([middle + spokes, ways / np.linalg.norm(ways, axis=1)[:, None]])


@pytest.mark.parametrize(
    ("radius", "across_the_ray", "said"),
    [
        (0.99, False, ""),
        (1.3, False, "a ray starts beyond the rim of the lens"),
        (2.0, False, "a ray starts far beyond the rim of the lens"),
        (0.99, True, "the lens lies across the ray, and not across the view"),
    ],
)
def test_lenses_are_told_by_how_they_are_wrong(radius: float, *, across_the_ray: bool, said: str) -> None:
    inputs = _inputs("lens_ray", "a few rays")
    frame, ray = inputs["frame"], inputs["ray"]
    assert isinstance(frame, Frame)
    assert isinstance(ray, Ray)
    right, up = np.array(frame.right), np.array(frame.up)
    if across_the_ray:
        side = unit(cross(ray.direction, frame.up))
        right, up = np.array(side), np.array(cross(ray.direction, side))
    turns = np.arange(8)[:, None] * math.pi / 4
    spokes = real_of(inputs, "lens_radius") * radius * (np.cos(turns) * right + np.sin(turns) * up)
    assert _problem(_FUNCTIONS["lens_ray"], inputs, _lens_rays(inputs, spokes)) == said


@pytest.mark.parametrize(
    ("share", "aside", "said"),
    [
        (1.0, 0.0, ""),
        (0.7, 0.0, "rays meet before the plane of focus"),
        (1.5, 0.0, "rays meet behind the plane of focus"),
        (1.0, 0.2, "rays meet in a point that lies beside the ray through the middle of the lens"),
        (1.001, 0.004, "rays meet in a point that lies beside the ray through the middle of the lens"),
        (-1.0, 0.0, "rays run away from the plane of focus"),
        (math.inf, 0.0, "all rays have one direction"),
        (-math.inf, 0.0, "rays spread, as if they came from one point behind the lens"),
    ],
)
def test_rays_of_a_lens_are_told_by_where_they_meet(share: float, aside: float, said: str) -> None:
    """`share`: of the way to the plane of focus; `aside`: of that way, across the ray. Without an end all rays have
    the direction of the middle, and below 0 the place on the lens is added to it, not taken away."""
    inputs = _inputs("lens_ray", "a few rays")
    frame, ray = inputs["frame"], inputs["ray"]
    assert isinstance(frame, Frame)
    assert isinstance(ray, Ray)
    right, up, middle = np.array(frame.right), np.array(frame.up), np.array(ray.direction)
    turns = np.arange(8)[:, None] * math.pi / 4
    spokes = 0.9 * real_of(inputs, "lens_radius") * (np.cos(turns) * right + np.sin(turns) * up)
    way = real_of(inputs, "focal_distance") / float(middle @ np.array(frame.forward))
    across = np.array(unit(cross(ray.direction, frame.up)))
    if math.isinf(share):
        ways = middle + 0 * spokes if share > 0 else way * middle + spokes
    else:
        ways = share * way * middle + aside * way * across - spokes
    directions = ways / np.linalg.norm(ways, axis=1)[:, None]
    rows = np.hstack([np.array(ray.origin) + spokes, directions])
    assert _problem(_FUNCTIONS["lens_ray"], inputs, rows) == said


@pytest.mark.parametrize(
    ("reach", "beside", "said"),
    [
        (0.5, False, "a point lies off the sphere, though in a direction in which the sphere is seen"),
        (0.5, True, "a point lies off the sphere, and all of them behind the place that is lit"),
        (-1.0, False, "all points lie on the side of the sphere that is not seen"),
    ],
)
def test_points_off_a_sphere_are_told_by_how_they_are_seen(reach: float, *, beside: bool, said: str) -> None:
    """`reach`: towards the viewer from the sphere's centre, in radii."""
    inputs = _inputs("sample_sphere", "a few samples")
    center, from_ = (np.array(vec_of(inputs, name)) for name in ("center", "from"))
    back = np.array(unit(tuple(from_ - center)))
    across = np.array(unit(cross(tuple(back), (0.6, 0.8, 0.0))))
    lean = 1e-3 * np.arange(8)[:, None] * across
    ways = reach * back + lean if reach > 0 else np.array([unit(tuple(way)) for way in reach * back + lean])
    positions = center + real_of(inputs, "radius") * ways
    positions = from_ + (from_ - positions) if beside else positions
    rows = np.hstack([positions, np.broadcast_to(back, (8, 3)), np.ones((8, 1))])
    assert _problem(_FUNCTIONS["sample_sphere"], inputs, rows) == said


@pytest.mark.parametrize(
    ("group", "density", "said"),
    [
        ("from inside", 0.0, ""),
        ("from inside", math.nan, "a sample is infinite or NaN"),
        ("a few samples", 0.0, "a sample is infinite or NaN"),
    ],
)
def test_from_inside_a_sphere_its_points_need_not_be_numbers(group: str, density: float, said: str) -> None:
    rows = np.full((8, 7), math.nan)
    rows[:, 6] = density
    function, inputs = _FUNCTIONS["sample_sphere"], _inputs("sample_sphere", group)
    assert _problem(function, inputs, rows) == said
    assert _problem(function, inputs, rows[:0]) == "no proper answer came"


def test_points_on_a_line_do_not_fill_a_square() -> None:
    numbers = np.random.default_rng(12).random(2048)
    line = np.stack([2 * numbers - 1, 2 * numbers - 1], axis=1)
    said = "all points lie on a line, and some outside of the disk"
    assert _problem(_FUNCTIONS["unit_disk"], _inputs("unit_disk", "many points"), line) == said
