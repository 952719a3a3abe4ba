"""Cases of step 12. Points that are chosen by chance are compared with nobody's: they lie where they may, all places
are as likely as they ought to be, and their density is the one that goes with that."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from raysteps.common.vectors import Vector, add, cross, dot, length, minus, times, unit
from raysteps.judge.answers import (
    Answer,
    Tolerance,
    channels,
    first,
    itself,
    numeric_problem,
    read_vector,
    real,
    share_right,
    vector,
    words_of_number,
    words_of_vector,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import (
    Fill,
    Frame,
    Hit,
    Inputs,
    Ray,
    Real,
    TokenReader,
    Vec,
    Whole,
    f32,
    real_of,
    rounded,
    text,
    vec_of,
    whole_of,
)
from raysteps.judge.random_source import RandomSource, next_axis
from raysteps.judge.statistics import (
    DEVIATIONS,
    SIGNIFICANCE,
    Numbers,
    has_mean,
    is_uniform,
    ratio_problem,
    uneven_problem,
)

# Many answers to one question: rows of numbers, and what the first u gave once more.

_FEW, _MANY, _VERY_MANY = 8, 2048, 16_384
_CORNERS = 16  # without a seed: the corners of the unit square and places between them
_MAX_ROWS = 100_000


@dataclass(frozen=True)
class _Draws:
    rows: Numbers
    again: Numbers


def _reader(width: int) -> Callable[[TokenReader], _Draws]:
    def read(tokens: TokenReader) -> _Draws:
        found = tokens.rows(width, _MAX_ROWS)
        return _Draws(found[:-1], found[-1:].ravel())

    return read


def _words_of_draws(draws: _Draws) -> str:
    shown = ", ".join("(" + ", ".join(text(f32(number)) for number in row) + ")" for row in draws.rows[:4])
    return f"{len(draws.rows)} answers, first {shown}"


def _draws(draw: RandomSource, size: int) -> Inputs:
    return {"seed": Whole(draw.whole(1, 1_000_000_000)), "times": Whole(size)}


def _corners() -> Inputs:
    return {"seed": Whole(0), "times": Whole(_CORNERS)}


def _broken(inputs: Inputs, actual: _Draws, what: str) -> str:
    """What is wrong whatever was asked."""
    if len(actual.rows) != whole_of(inputs, "times"):
        return "no proper answer came"
    if not np.isfinite(actual.rows).all():
        return f"{what} is infinite or NaN"
    if not np.array_equal(actual.rows[0], actual.again):
        return "the same u gave another answer"
    return ""


def _where(problem: str, points: Numbers) -> str:
    """A place that no point may have. One that all points have comes of no formula at all, as in a function that is
    not written."""
    alike = len(points) > 1 and bool((points == points[0]).all())
    return f"{problem}, the same for every u" if alike else problem


@dataclass(frozen=True)
class _Places:
    """How a shape is measured: of each point two numbers that are even from 0 to 1 where all of the shape is equally
    likely, such as the square of the radius and the angle. What is said where they are not."""

    low: str  # too many have a small first number
    high: str
    uneven: str
    around: str  # the second number is uneven
    way: str  # what the first number is
    way_around: str


_DISK = _Places(
    "too many points lie near the middle",
    "too many points lie near the rim",
    "some rings get more points than others of the same area",
    "some sides get more points than others",
    "points from the middle to the rim, in rings of equal area",
    "points around the middle, side by side",
)
_CAP = _Places(
    "too many points lie near the middle of what can be seen",
    "too many points lie near the rim of what can be seen",
    "some rings get more points than others of the same solid angle",
    "some sides get more points than others",
    "points from the middle of what can be seen to its rim, in rings of equal solid angle",
    "points around the middle, side by side",
)
_TRIANGLE = _Places(
    "too many points lie near the first corner",
    "too many points lie away from the first corner",
    "points are not spread evenly from the first corner to the side opposite to it",
    "points are not spread evenly between the second and the third corner",
    "points from the first corner to the side opposite to it, in strips of equal area",
    "points from the side of the second corner to that of the third",
)


def _evenness(inputs: Inputs, places: _Places, shares: Numbers) -> str:
    """The corners of the unit square are even nowhere; of a few points no more can be told than that they differ."""
    if whole_of(inputs, "seed") == 0:
        return ""
    if len(shares) < _MANY:
        return "" if 2 * len(np.unique(shares, axis=0)) > len(shares) else "different u give the same point"
    is_found = bool(_uneven_problems(places, shares, DEVIATIONS, SIGNIFICANCE))
    problems = _uneven_problems(places, shares, *_TO_TELL) if is_found else []
    words = ", and ".join(problems)
    along, around = shares[:, 0], shares[:, 1]
    if {places.low, places.high, places.uneven} & {*problems}:
        return uneven_problem(words, places.way, along)
    goes_round = places is not _TRIANGLE
    return (
        uneven_problem(words, places.way_around, around, goes_round=goes_round) if places.around in problems else words
    )


_TO_TELL = 4.0, 1e-4  # where points are uneven for certain, less is enough to tell how: it hangs less on chance


def _uneven_problems(places: _Places, shares: Numbers, deviations: float, significance: float) -> list[str]:
    bins = 32 if len(shares) >= _VERY_MANY else 8
    along, around = shares[:, 0], shares[:, 1]

    def has_middle(numbers: Numbers) -> bool:
        return has_mean(numbers, 0.5, math.sqrt(1 / 12), deviations)

    problems = []
    if not has_middle(along):
        problems.append(places.low if float(along.mean()) < 0.5 else places.high)
    elif not is_uniform(along, 2 * bins, significance):
        problems.append(places.uneven)
    if not (has_middle(around) and is_uniform(around, 2 * bins, significance)):
        problems.append(places.around)
    if not is_uniform(_ranks(shares) if problems else shares, bins, significance):
        problems.append("the two random numbers have to do with each other")
    return problems


def _ranks(shares: Numbers) -> Numbers:
    """Each column made even: what is left tells whether one has to do with the other."""
    order = np.argsort(shares, axis=0, kind="stable")
    return np.asarray((np.argsort(order, axis=0) + 0.5) / len(shares))


def _turns(x: Numbers, y: Numbers) -> Numbers:
    """Angles as shares of a whole turn."""
    return np.asarray(np.arctan2(y, x) / (2 * math.pi) + 0.5)


def _shares(along: Numbers, around: Numbers) -> Numbers:
    return np.clip(np.stack([along, around], axis=1), 0.0, 1.0)


def _basis(normal: Vector) -> tuple[Numbers, Numbers, Numbers]:
    """Two directions across, and the normal itself, of length 1."""
    upright = unit(normal)
    side = unit(cross(upright, (1.0, 0.0, 0.0) if abs(upright[0]) < 0.5 else (0.0, 1.0, 0.0)))
    x, y, z = (np.array(v) for v in (side, cross(upright, side), upright))
    return x, y, z


# Turning z to a normal: what becomes of x, y and z has to be a frame, and the vector has to lie in it as before.

_FRAME = Tolerance(5e-4, 5e-4)


@dataclass(frozen=True)
class _Turned:
    vector: Vector
    axes: tuple[Vector, Vector, Vector]


def _read_turned(tokens: TokenReader) -> _Turned:
    return _Turned(tokens.vector(), (tokens.vector(), tokens.vector(), tokens.vector()))


def _turned_problem(inputs: Inputs, _expected: _Turned, actual: _Turned) -> str:
    if not np.isfinite(np.array([actual.vector, *actual.axes])).all():
        return "a number is infinite or NaN"
    x, y, z = actual.axes
    along = vector("what becomes of z", vec_of(inputs, "normal"), z, _FRAME)
    lengths = first(*(real("a length", 1.0, length(axis), _FRAME) for axis in (x, y)))
    angles = first(*(real("an angle", 0.0, dot(*pair), _FRAME) for pair in ((x, y), (y, z), (z, x))))
    given = vec_of(inputs, "vector")
    sum_ = add(add(times(given[0], x), y, given[1]), z, given[2])
    return first(along, lengths, angles, vector("the vector", sum_, actual.vector, Tolerance(1e-3, 1e-3)))


def _turn(normal: Vector, given: Vector) -> Inputs:
    return {"normal": Vec(normal), "vector": Vec(given)}


def _nearly_axis(draw: RandomSource) -> Vector:
    axis = draw.axis()
    return rounded(unit(add(axis, draw.direction(), draw.logarithmic(1e-6, 1e-2))))


_TURNED_TO = Function(
    "turned_to",
    Answer(_read_turned, lambda turned: words_of_vector(turned.vector), _turned_problem),
    (
        Group("any normal", lambda d: _turn(d.direction(), d.point(3))),
        Group("along an axis", lambda d: _turn(d.axis(), d.simple_point(3))),
        Group("nearly along an axis", lambda d: _turn(_nearly_axis(d), d.point(3))),
        Group("between the axes", lambda d: _turn(d.diagonal(), d.point(3))),
        Group("against z", lambda d: _turn((0.0, 0.0, -1.0), d.point(3))),
        Group("along z", lambda d: _turn(d.direction(), (0.0, 0.0, d.real(-3, 3)))),
    ),
)

# The unit disk, and caps of the unit sphere.

_OUT = 1e-4


def _disk_problem(inputs: Inputs, _expected: _Draws, actual: _Draws) -> str:
    broken = _broken(inputs, actual, "a point")
    if broken:
        return broken
    x, y = actual.rows.T
    squares = x * x + y * y
    if float(squares.max()) > 1 + _OUT:
        outside = "all points lie on a line, and some outside of the disk"
        return outside if _on_a_line(actual.rows) else "a point lies outside of the disk"
    return _evenness(inputs, _DISK, _shares(squares, _turns(x, y)))


def _on_a_line(points: Numbers) -> bool:
    """Through any place and in any direction; not all at one place."""
    wide, *narrow = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return float(wide) > 0 and float(max(narrow)) <= 1e-4 * float(wide)


_UNIT_DISK = Function(
    "unit_disk",
    Answer(_reader(2), _words_of_draws, _disk_problem, is_drawn=True),
    (
        Group("many points", lambda d: _draws(d, _MANY)),
        Group("very many points", lambda d: _draws(d, _VERY_MANY)),
        Group("corners of the square", lambda _: _corners(), exact=True),
    ),
)


def _heights(directions: Numbers) -> Numbers:
    """1 - z of unit vectors, from what they are long across, where 1 - z has no digits left."""
    x, y, z = directions.T
    squares = x * x + y * y
    return np.asarray(np.where(z > 0, squares / (1 + np.sqrt(np.maximum(0.0, 1 - squares))), 1 - z))


def _cap_problem(inputs: Inputs, _expected: _Draws, actual: _Draws) -> str:
    broken = _broken(inputs, actual, "a direction")
    if broken:
        return broken
    lengths = np.linalg.norm(actual.rows, axis=1)
    if float(np.abs(lengths - 1).max()) > 1e-3:
        return ratio_problem("a direction does not have length 1", lengths)
    height = real_of(inputs, "height")
    found = _heights(actual.rows)
    along = found / height if height else np.zeros(len(found))
    if float(found.max()) > height * (1 + 1e-3) + 1e-12 + (1e-6 if height > 0.01 else 0.0):
        return ratio_problem("a direction lies outside of the cap", along)
    return _evenness(inputs, _CAP, _shares(along, _turns(actual.rows[:, 0], actual.rows[:, 1])))


def _cap(draw: RandomSource, height: float, size: int) -> Inputs:
    return {"height": Real(height), **_draws(draw, size)}


_CAP_DIRECTION = Function(
    "cap_direction",
    Answer(_reader(3), _words_of_draws, _cap_problem, is_drawn=True),
    (
        Group("any height", lambda d: _cap(d, d.real(0.1, 2.0), _MANY)),
        Group("low caps", lambda d: _cap(d, d.logarithmic(1e-3, 0.1), _MANY)),
        Group("very low caps", lambda d: _cap(d, d.logarithmic(1e-10, 1e-6), _MANY)),
        Group("half of the sphere and all of it", lambda d: _cap(d, float(d.whole(1, 2)), _VERY_MANY)),
        Group("corners of the square", lambda d: {"height": Real(d.real(0.1, 2.0)), **_corners()}, exact=True),
    ),
)

# From area to solid angle.

_PDF = Answer(
    lambda tokens: tokens.real(),
    words_of_number,
    lambda _, expected, actual: real("the density", expected, actual, Tolerance(1e-6, 2e-3)),
)


def _seen(draw: RandomSource, distance: float, low: float, high: float) -> Inputs:
    """With that cosine at the lamp."""
    position, normal = draw.point(5), draw.direction()
    back = draw.above(normal, low, high)
    return {
        "area_pdf": Real(draw.logarithmic(0.05, 20)),
        "from": Vec(rounded(add(position, back, distance))),
        "position": Vec(position),
        "normal": Vec(normal),
    }


def _simple_seen(draw: RandomSource) -> Inputs:
    """Straight away from the lamp."""
    position, normal = draw.simple_point(3), draw.axis()
    from_ = add(position, normal, float(draw.whole(1, 4)))
    return {"area_pdf": Real(1.0), "from": Vec(from_), "position": Vec(position), "normal": Vec(normal)}


def _along(draw: RandomSource) -> Inputs:
    position, normal = draw.simple_point(3), draw.axis()
    from_ = add(position, next_axis(normal), draw.eighths(0.5, 3))
    return {"area_pdf": Real(1.0), "from": Vec(from_), "position": Vec(position), "normal": Vec(normal)}


_SOLID_ANGLE_PDF = Function(
    "solid_angle_pdf",
    _PDF,
    (
        Group("any lamp", lambda d: _seen(d, d.real(0.5, 8), 0.1, 0.99)),
        Group("simple numbers", _simple_seen),
        Group("straight before it", lambda d: _seen(d, d.real(0.5, 8), 0.999, 1.0)),
        Group("at a slant", lambda d: _seen(d, d.real(0.5, 8), 0.03, 0.2)),
        Group("near and far", lambda d: _seen(d, d.logarithmic(1, 1000), 0.2, 0.99)),
        Group("from behind", lambda d: _seen(d, d.real(0.5, 8), -0.99, -0.05)),
        Group("along the lamp", _along, exact=True),
    ),
)

# Samples of lamps: position, normal and pdf of each.

_POSITION, _NORMAL, _DENSITY = slice(0, 3), slice(3, 6), 6


def _normal_problem(expected: Numbers, actual: _Draws) -> str:
    gaps = np.linalg.norm(actual.rows[:, _NORMAL] - expected, axis=1)
    if float(gaps.max()) <= 5e-3:
        return ""
    opposite = np.linalg.norm(actual.rows[:, _NORMAL] + expected, axis=1)
    if float(opposite.max()) <= 5e-3:
        return "a normal points to the dark side"
    return ratio_problem("a normal is wrong", (actual.rows[:, _NORMAL] * expected).sum(axis=1))


def _density_problem(expected: Numbers, actual: _Draws) -> str:
    """Who is wrong by one factor everywhere has forgotten something else than who is not; so has who is wrong by
    another factor."""
    found = actual.rows[:, _DENSITY]
    if float(np.abs(found[expected == 0]).sum()) > 0:
        return "pdf is above 0 where no light is seen"
    bright = expected > 0
    ratios = found[bright] / expected[bright]
    if not len(ratios) or float(np.abs(ratios - 1).max()) <= 4e-3:
        return ""
    if float(np.abs(ratios).max()) == 0:
        return "pdf is 0 where light is seen"
    factor = float(ratios.mean())
    side = "large" if factor > 1 else "small"
    if float(ratios.std()) < 5e-3 * float(np.abs(ratios).mean()):
        kind = f"pdf is too {side}, by the same factor for all points"
        share = f"{factor:.2g}"
        tells = share != "1" and 0.01 <= abs(factor) < 99
        return numeric_problem(kind, f"it is {share} times what it should be") if tells else ratio_problem(kind, ratios)
    return ratio_problem(f"pdf is too {side}, and not by the same factor for all points", ratios)


def _area_density(inputs: Inputs, area: float, normal: Numbers, actual: _Draws) -> Numbers:
    back = np.array(vec_of(inputs, "from")) - actual.rows[:, _POSITION]
    distances = np.linalg.norm(back, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        cosines = back @ normal / distances
        return np.where(cosines > 0, distances**2 / (area * cosines), 0.0)


_Problems = Callable[[Inputs, _Draws], tuple[str, str, str]]


def _sample_answer(problems: _Problems, is_seen: Callable[[Inputs], bool] = lambda _: True) -> Answer[_Draws]:
    """`problems`: of positions, normals and densities. Without right positions nothing is right; where `is_seen` says
    that nothing of the lamp is, any will do, also one that is no number."""

    def told(inputs: Inputs, actual: _Draws) -> _Draws:
        return actual if is_seen(inputs) else _without_points(actual)

    def problem(inputs: Inputs, _expected: _Draws, actual: _Draws) -> str:
        draws = told(inputs, actual)
        return _broken(inputs, draws, "a sample") or first(*problems(inputs, draws))

    def credit(inputs: Inputs, _expected: _Draws, actual: _Draws) -> float:
        draws = told(inputs, actual)
        if _broken(inputs, draws, "a sample"):
            return 0.0
        position, *others = problems(inputs, draws)
        return 0.0 if position else share_right(position, *others)

    return Answer(_reader(7), _words_of_draws, problem, credit, is_drawn=True)


def _without_points(draws: _Draws) -> _Draws:
    """The densities alone, all else as 0."""
    rows, again = draws.rows.copy(), draws.again.copy()
    rows[:, :_DENSITY], again[:_DENSITY] = 0, 0
    return _Draws(rows, again)


def _beyond(of_b: Numbers, of_c: Numbers) -> str:
    """In words, of points of which some lie beside the triangle: what came of two numbers of which one was turned round
    lies in one of the two halves beyond the side opposite to the first corner."""
    beyond = of_b + of_c > 1
    halves = (of_c > of_b)[beyond]
    is_folded = len(halves) >= _SOME and len(np.unique(halves)) == 1
    if is_folded and min(float(of_b.min()), float(of_c.min())) > -1e-3:
        return "in the triangle's plane, but beyond one half of the side opposite to its first corner"
    return "in the triangle's plane, but beyond a side"


_SOME = 8  # so few points might lie in one half by chance, one time in a hundred


def _triangle_problems(inputs: Inputs, actual: _Draws) -> tuple[str, str, str]:
    a, b, c = (np.array(vec_of(inputs, name)) for name in "abc")
    across = np.cross(b - a, c - a)
    doubled = float(np.linalg.norm(across))
    normal = across / doubled
    spokes = actual.rows[:, _POSITION] - a
    of_b = np.cross(spokes, c - a) @ normal / doubled
    of_c = np.cross(b - a, spokes) @ normal / doubled
    size = math.sqrt(doubled)
    aside = float(np.abs(spokes @ normal).max()) > 1e-3 * size
    beyond = min(float(of_b.min()), float(of_c.min()), float((1 - of_b - of_c).min())) < -1e-3
    away = np.maximum(of_b + of_c, 1e-12)
    place = "above or below the triangle, not in its plane" if aside else _beyond(of_b, of_c)
    position = _where(f"a point lies {place}", spokes) if aside or beyond else ""
    position = position or _evenness(inputs, _TRIANGLE, _shares(away**2, of_c / away))
    density = _density_problem(_area_density(inputs, doubled / 2, normal, actual), actual)
    return position, _normal_problem(normal, actual), density


def _other_plane(spokes: Numbers, normal: Numbers) -> str:
    """In words, of points that lie in a plane other than the disk's: one in which the disk's normal lies."""
    *_, across = np.linalg.svd(spokes, full_matrices=False)[2]
    upright = float(np.abs(spokes @ across).max()) < 1e-3 and abs(float(across @ normal)) < 1e-3
    return ", in one that stands upright on it" if upright else ""


def _disk_light_problems(inputs: Inputs, actual: _Draws) -> tuple[str, str, str]:
    radius = real_of(inputs, "radius")
    x, y, z = _basis(vec_of(inputs, "normal"))
    spokes = (actual.rows[:, _POSITION] - np.array(vec_of(inputs, "center"))) / radius
    of_x, of_y = spokes @ x, spokes @ y
    squares = of_x**2 + of_y**2
    aside = float(np.abs(spokes @ z).max()) > 1e-3
    if aside and float((spokes**2).sum(axis=1).max()) <= 1 + 2e-3:
        position = f"the points lie around the disk's centre, but not in its plane{_other_plane(spokes, z)}"
    elif aside or float(squares.max()) > 1 + 2e-3:
        position = _where("a point lies off the disk" if aside else "a point lies beyond the disk's rim", spokes)
    else:
        position = ""
    position = position or _evenness(inputs, _DISK, _shares(squares, _turns(of_x, of_y)))
    density = _density_problem(_area_density(inputs, math.pi * radius * radius, z, actual), actual)
    return position, _normal_problem(z, actual), density


_FLOAT = 3e-7  # of coordinates, with what a few sums lose
_ROOT_OF_FLOAT = 7e-4  # of a distance: what a root of the difference of squares loses
_SEEN = 1.02  # of the cap's height, with what rounding adds


def _beside(heights: Numbers, local: Numbers) -> str:
    """Where points off a sphere lie for who looks at it. `heights`: of directions, in that of the cap that it fills.
    `local`: the directions, with the way to the centre as z."""
    if float(local[:, 2].max()) < 0:
        return "and all of them behind the place that is lit"
    if float(heights.max()) <= _SEEN:
        return "though in a direction in which the sphere is seen"
    return "in a direction in which the sphere is not seen" if float(heights.min()) <= _SEEN else "and so do all others"


def _is_outside(inputs: Inputs) -> bool:
    return length(minus(vec_of(inputs, "center"), vec_of(inputs, "from"))) > real_of(inputs, "radius")


def _sphere_problems(inputs: Inputs, actual: _Draws) -> tuple[str, str, str]:
    center, radius, from_ = vec_of(inputs, "center"), real_of(inputs, "radius"), vec_of(inputs, "from")
    distance = length(minus(center, from_))
    if not _is_outside(inputs):
        dark = np.zeros(len(actual.rows))
        return "", "", _density_problem(dark, actual)
    x, y, z = _basis(minus(center, from_))
    positions = actual.rows[:, _POSITION]
    rounding = _FLOAT * (distance + length(center) + length(from_))
    spokes = (positions - np.array(center)) / radius
    sizes = np.linalg.norm(spokes, axis=1)
    ways = positions - np.array(from_)
    directions = ways / np.maximum(np.linalg.norm(ways, axis=1), 1e-30)[:, None]
    local = np.stack([directions @ x, directions @ y, directions @ z], axis=1)
    sine = radius / distance
    height = sine * sine / (1 + math.sqrt(1 - sine * sine))
    heights = _heights(local) / height
    slack = 2e-3 + _ROOT_OF_FLOAT * distance / radius
    if float(np.abs(sizes - 1).max()) > slack:
        reach = np.linalg.norm(ways, axis=1)
        near = "points are all as near as the nearest one of the sphere, so most of them lie off it"
        is_near = float(np.abs(reach - (distance - radius)).max()) <= slack * radius
        position = near if is_near else _where(f"a point lies off the sphere, {_beside(heights, local)}", spokes)
    elif float((spokes @ z).max()) > -sine + 0.05 + slack:
        some = "all points lie" if float((spokes @ z).min()) > -sine else "a point lies"
        position = f"{some} on the side of the sphere that is not seen"
    else:
        position = _evenness(inputs, _CAP, _shares(heights, _turns(local[:, 0], local[:, 1])))
    normals = spokes / np.maximum(sizes, 1e-30)[:, None]
    normal = "" if rounding > 1e-4 * radius else _normal_problem(normals, actual)
    density = np.full(len(positions), 1 / (2 * math.pi * height))
    return position, normal, _density_problem(density, actual)


def _triangle(draw: RandomSource, low: float, high: float, size: int) -> Inputs:
    """Seen from a place with such a cosine at the middle; from before it, if the cosine is above 0."""
    triangle = draw.triangle()
    a, b, c = triangle.a, triangle.b, triangle.c
    normal = unit(cross(minus(b, a), minus(c, a)))
    middle = times(1 / 3, add(add(a, b), c))
    from_ = rounded(add(middle, draw.above(normal, low, high), draw.real(3, 9)))
    return {"a": Vec(a), "b": Vec(b), "c": Vec(c), "from": Vec(from_), **_draws(draw, size)}


def _disk(draw: RandomSource, low: float, high: float, size: int, *, axis: bool = False) -> Inputs:
    center, normal, radius = draw.point(4), draw.axis() if axis else draw.direction(), draw.real(0.2, 2)
    from_ = rounded(add(center, draw.above(normal, low, high), draw.real(1.5, 4) * radius))
    return {
        "center": Vec(center),
        "normal": Vec(normal),
        "radius": Real(radius),
        "from": Vec(from_),
        **_draws(draw, size),
    }


def _sphere(draw: RandomSource, reach: float, size: int) -> Inputs:
    """`reach`: the distance from the centre, in radii."""
    center, radius = draw.point(4), draw.real(0.2, 2)
    from_ = rounded(add(center, draw.direction(), reach * radius))
    return {"center": Vec(center), "radius": Real(radius), "from": Vec(from_), **_draws(draw, size)}


def _with_corners(inputs: Inputs) -> Inputs:
    return {**inputs, **_corners()}


_SAMPLE_TRIANGLE = Function(
    "sample_triangle",
    _sample_answer(_triangle_problems),
    (
        Group("a few samples", lambda d: _triangle(d, 0.35, 0.99, _FEW)),
        Group("many samples", lambda d: _triangle(d, 0.35, 0.99, _MANY)),
        Group("very many samples", lambda d: _triangle(d, 0.35, 0.99, _VERY_MANY)),
        Group("corners of the square", lambda d: _with_corners(_triangle(d, 0.5, 0.99, _FEW)), exact=True),
        Group("from behind", lambda d: _triangle(d, -0.99, -0.5, _FEW)),
    ),
)
_SAMPLE_DISK = Function(
    "sample_disk",
    _sample_answer(_disk_light_problems),
    (
        Group("a few samples", lambda d: _disk(d, 0.3, 0.99, _FEW)),
        Group("many samples", lambda d: _disk(d, 0.3, 0.99, _MANY)),
        Group("along an axis", lambda d: _disk(d, 0.3, 0.99, _FEW, axis=True)),
        Group("corners of the square", lambda d: _with_corners(_disk(d, 0.3, 0.99, _FEW)), exact=True),
        Group("from behind", lambda d: _disk(d, -0.99, -0.2, _FEW)),
    ),
)
_SAMPLE_SPHERE = Function(
    "sample_sphere",
    _sample_answer(_sphere_problems, _is_outside),
    (
        Group("a few samples", lambda d: _sphere(d, d.real(1.2, 6), _FEW)),
        Group("many samples", lambda d: _sphere(d, d.real(1.2, 6), _MANY)),
        Group("very near", lambda d: _sphere(d, d.real(1.02, 1.2), _MANY)),
        Group("small and far", lambda d: _sphere(d, d.logarithmic(200, 600), _FEW)),
        Group("corners of the square", lambda d: _with_corners(_sphere(d, d.real(1.2, 6), _FEW)), exact=True),
        Group("from inside", lambda d: _sphere(d, d.real(0.05, 0.95), _FEW)),
    ),
)

# What a sample brings.

_COLOR = Answer(
    read_vector,
    words_of_vector,
    lambda _, expected, actual: channels("the light", expected, actual, Tolerance(1e-5, 2e-3)),
    near=itself,
)


def _brought(draw: RandomSource, low: float, high: float, *, pdf: float | None = None) -> Inputs:
    """By a lamp with that cosine at the hit, which is on either side of its surface."""
    position, normal = draw.point(4), draw.direction()
    seen_along, distance = times(-1.0, draw.above(normal, 0.2, 0.95)), draw.real(1, 9)
    hit = Hit(position, normal, seen_along, distance, draw.fill(), draw.chance(0.6))
    way = draw.above(normal, low, high)
    place = rounded(add(position, way, draw.real(0.5, 8)))
    return {
        "hit": hit,
        "radiance": Vec(draw.color(0.5, 12)),
        "position": Vec(place),
        "normal": Vec(draw.above(times(-1.0, way), 0.1, 0.95)),  # what has a density shines this way
        "pdf": Real(draw.logarithmic(0.1, 10) if pdf is None else pdf),
    }


def _simple_brought(draw: RandomSource) -> Inputs:
    """A white wall, and a lamp straight above it."""
    position, normal = draw.simple_point(3), draw.axis()
    hit = Hit(position, normal, times(-1.0, normal), 1.0, Fill())
    place = add(position, normal, float(draw.whole(1, 4)))
    return {
        "hit": hit,
        "radiance": Vec((1.0, 2.0, 4.0)),
        "position": Vec(place),
        "normal": Vec(times(-1.0, normal)),
        "pdf": Real(1.0),
    }


def _dark_wall(draw: RandomSource) -> Inputs:
    """Which is a mirror: light and mirror have nothing to do with each other."""
    inputs = _brought(draw, 0.2, 0.99)
    hit = inputs["hit"]
    assert isinstance(hit, Hit)
    return {**inputs, "hit": replace(hit, fill=replace(hit.fill, kd=draw.real(0.0, 0.1), ks=1.0, shine=3.0))}


_SAMPLED_LIGHT = Function(
    "sampled_light",
    _COLOR,
    (
        Group("any sample", lambda d: _brought(d, 0.05, 0.99)),
        Group("simple numbers", _simple_brought),
        Group("at a slant", lambda d: _brought(d, 0.02, 0.15)),
        Group("a dark mirror", _dark_wall),
        Group("a low density", lambda d: _brought(d, 0.2, 0.99, pdf=d.logarithmic(1e-3, 0.05))),
        Group("below the surface", lambda d: _brought(d, -0.99, -0.05)),
        Group("no density", lambda d: _brought(d, 0.2, 0.99, pdf=0.0), exact=True),
    ),
)

# The lens.


def _reach_of_lens(spokes: Numbers, radius: float) -> str:
    is_near = float(np.linalg.norm(spokes, axis=1).max()) <= radius
    return "though no farther from its middle than its rim" if is_near else "and farther from its middle than its rim"


_ONE_WAY = 1e-4
_MISSED = 5e-3  # of the way to the plane of focus


def _where_rays_meet(origins: Numbers, directions: Numbers, ray: Ray, way: float) -> str:
    """In words, of rays that do not meet where they should: on `ray`, that far along it."""
    middle = np.array(ray.direction)
    if float((directions @ middle).max()) < 0:
        return "rays run away from the plane of focus"
    if (origins == origins[0]).all():  # as those of a lens without a size
        return "rays miss their point of the plane of focus"
    if float(np.abs(directions - directions[0]).max()) < _ONE_WAY:
        return "all rays have one direction"
    # The place from which the squares of the distances to all rays are least.
    across = np.eye(3) - directions[:, :, None] * directions[:, None, :]
    place, *_ = np.linalg.lstsq(across.sum(axis=0), (across @ origins[:, :, None]).sum(axis=0).ravel(), rcond=None)
    missed = np.linalg.norm((across @ (place - origins)[:, :, None])[..., 0], axis=1)
    if float(missed.max()) > _MISSED * way:
        return "rays do not meet in one point"
    to_place = place - np.array(ray.origin)
    along = float(to_place @ middle)
    if along < 0:
        return "rays spread, as if they came from one point behind the lens"
    if float(np.linalg.norm(to_place - along * middle)) > abs(along - way):
        return "rays meet in a point that lies beside the ray through the middle of the lens"
    side = "before" if along < way else "behind"
    return ratio_problem(f"rays meet {side} the plane of focus", np.array([along / way]))


def _lens_problems(inputs: Inputs, actual: _Draws) -> tuple[str, str]:
    frame, ray = inputs["frame"], inputs["ray"]
    assert isinstance(frame, Frame)
    assert isinstance(ray, Ray)
    radius, focus = real_of(inputs, "lens_radius"), real_of(inputs, "focal_distance")
    origins, directions = actual.rows[:, :3], actual.rows[:, 3:]
    spokes = origins - np.array(ray.origin)
    of_x, of_y = spokes @ np.array(frame.right), spokes @ np.array(frame.up)
    squares = of_x**2 + of_y**2
    slack = 1e-5 + 2e-3 * radius
    lifted = float(np.abs(spokes @ np.array(frame.forward)).max())
    apart = origins if radius else origins[:1]  # a lens without a size is one point, and no fault
    if lifted > slack:
        across = radius and float(np.abs(spokes @ np.array(ray.direction)).max()) <= slack
        plane = "the lens lies across the ray, and not across the view"
        turned = f"a ray starts outside of the lens's plane, {_reach_of_lens(spokes, radius + slack)}"
        origin = plane if across else _where(turned, apart)
    elif math.sqrt(float(squares.max())) > radius + slack:
        far = "far " if float(squares.max()) > 2.1 * radius * radius else ""  # no square around the lens is so wide
        origin = _where(f"a ray starts {far}beyond the rim of the lens", apart)
    elif radius:
        origin = _evenness(inputs, _DISK, _shares(squares / radius**2, _turns(of_x, of_y)))
    else:
        origin = ""
    lengths = np.linalg.norm(directions, axis=1)
    if float(np.abs(lengths - 1).max()) > 1e-3:
        return origin, ratio_problem("a direction does not have length 1", lengths)
    way = focus / dot(ray.direction, frame.forward)
    ways = np.array(add(ray.origin, ray.direction, way)) - origins
    wanted = ways / np.linalg.norm(ways, axis=1)[:, None]
    gap = float(np.linalg.norm(directions - wanted, axis=1).max())
    return origin, "" if gap < 2e-3 else _where_rays_meet(origins, directions, ray, way)


def _lens_problem(inputs: Inputs, _expected: _Draws, actual: _Draws) -> str:
    return _broken(inputs, actual, "a ray") or first(*_lens_problems(inputs, actual))


def _lens_credit(inputs: Inputs, _expected: _Draws, actual: _Draws) -> float:
    """Half for rays from the right places, or to the right one; a lens without a size has one place only, and who gives
    back the ray that came has no lens."""
    if _broken(inputs, actual, "a ray") or not real_of(inputs, "lens_radius"):
        return 0.0
    if (actual.rows[:, :3] == actual.rows[0, :3]).all():
        return 0.0
    return share_right(*_lens_problems(inputs, actual))


def _lens(draw: RandomSource, low: float, high: float, size: int, *, radius: float | None = None) -> Inputs:
    """The ray has that cosine with the view."""
    forward = draw.direction()
    right = unit(cross(forward, draw.across(forward)))
    frame = Frame(rounded(right), rounded(cross(right, forward)), forward, draw.real(0.3, 1), draw.real(0.3, 1))
    ray = Ray(draw.point(4), draw.above(forward, low, high))
    lens = draw.real(0.05, 0.8) if radius is None else radius
    numbers = {"lens_radius": Real(lens), "focal_distance": Real(draw.real(1.5, 15))}
    return {"frame": frame, "ray": ray, **numbers, **_draws(draw, size)}


_LENS_RAY = Function(
    "lens_ray",
    Answer(_reader(6), _words_of_draws, _lens_problem, _lens_credit, is_drawn=True),
    (
        Group("a few rays", lambda d: _lens(d, 0.6, 0.98, _FEW)),
        Group("many rays", lambda d: _lens(d, 0.6, 0.98, _MANY)),
        Group("through the middle of the picture", lambda d: _lens(d, 0.9999, 1.0, _FEW)),
        Group("at a slant", lambda d: _lens(d, 0.3, 0.6, _FEW)),
        Group("corners of the square", lambda d: _with_corners(_lens(d, 0.6, 0.98, _FEW)), exact=True),
        Group("a lens without a size", lambda d: _lens(d, 0.6, 0.98, _FEW, radius=0.0)),
    ),
)

FUNCTIONS = (
    _TURNED_TO,
    _UNIT_DISK,
    _CAP_DIRECTION,
    _SOLID_ANGLE_PDF,
    _SAMPLE_TRIANGLE,
    _SAMPLE_DISK,
    _SAMPLE_SPHERE,
    _SAMPLED_LIGHT,
    _LENS_RAY,
)
