"""Cases of step 12. Points that are chosen by chance are compared with nobody's: they lie where they may, all places
are as likely as they ought to be, and their density is the one that goes with that."""

import math
from dataclasses import dataclass, replace

import numpy as np

from raysteps.common.vectors import Vector, add, cross, dot, length, times, unit
from raysteps.judge.answers import (
    Answer,
    Tolerance,
    channels,
    first,
    itself,
    read_vector,
    real,
    share_right,
    vector,
    words_of_number,
    words_of_vector,
)
from raysteps.judge.cases.lamp_samples import SAMPLE_DISK, SAMPLE_SPHERE, SAMPLE_TRIANGLE
from raysteps.judge.draws import (
    CAP,
    DISK,
    FEW,
    MANY,
    VERY_MANY,
    Draws,
    as_shares,
    broken_draws,
    corners,
    draws_reader,
    evenness,
    heights_of_directions,
    place_problem,
    seed_and_times,
    turns_around,
    words_of_draws,
)
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Fill, Frame, Hit, Inputs, Ray, Real, TokenReader, Vec, real_of, rounded, vec_of
from raysteps.judge.random_source import RandomSource, next_axis
from raysteps.judge.statistics import Numbers, ratio_problem

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


def _disk_problem(inputs: Inputs, _expected: Draws, actual: Draws) -> str:
    broken = broken_draws(inputs, actual, "a point")
    if broken:
        return broken
    x, y = actual.rows.T
    squares = x * x + y * y
    if float(squares.max()) > 1 + _OUT:
        outside = "all points lie on a line, and some outside of the disk"
        return outside if _on_a_line(actual.rows) else "a point lies outside of the disk"
    return evenness(inputs, DISK, as_shares(squares, turns_around(x, y)))


def _on_a_line(points: Numbers) -> bool:
    """Through any place and in any direction; not all at one place."""
    wide, *narrow = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return float(wide) > 0 and float(max(narrow)) <= 1e-4 * float(wide)


_UNIT_DISK = Function(
    "unit_disk",
    Answer(draws_reader(2), words_of_draws, _disk_problem, is_drawn=True),
    (
        Group("many points", lambda d: seed_and_times(d, MANY)),
        Group("very many points", lambda d: seed_and_times(d, VERY_MANY)),
        Group("corners of the square", lambda _: corners(), exact=True),
    ),
)


def _cap_problem(inputs: Inputs, _expected: Draws, actual: Draws) -> str:
    broken = broken_draws(inputs, actual, "a direction")
    if broken:
        return broken
    lengths = np.linalg.norm(actual.rows, axis=1)
    if float(np.abs(lengths - 1).max()) > 1e-3:
        return ratio_problem("a direction does not have length 1", lengths)
    height = real_of(inputs, "height")
    found = heights_of_directions(actual.rows)
    along = found / height if height else np.zeros(len(found))
    if float(found.max()) > height * (1 + 1e-3) + 1e-12 + (1e-6 if height > 0.01 else 0.0):
        return ratio_problem("a direction lies outside of the cap", along)
    return evenness(inputs, CAP, as_shares(along, turns_around(actual.rows[:, 0], actual.rows[:, 1])))


def _cap(draw: RandomSource, height: float, size: int) -> Inputs:
    return {"height": Real(height), **seed_and_times(draw, size)}


_CAP_DIRECTION = Function(
    "cap_direction",
    Answer(draws_reader(3), words_of_draws, _cap_problem, is_drawn=True),
    (
        Group("any height", lambda d: _cap(d, d.real(0.1, 2.0), MANY)),
        Group("low caps", lambda d: _cap(d, d.logarithmic(1e-3, 0.1), MANY)),
        Group("very low caps", lambda d: _cap(d, d.logarithmic(1e-10, 1e-6), MANY)),
        Group("half of the sphere and all of it", lambda d: _cap(d, float(d.whole(1, 2)), VERY_MANY)),
        Group("corners of the square", lambda d: {"height": Real(d.real(0.1, 2.0)), **corners()}, exact=True),
    ),
)

# From area to solid angle.

_PDF = Answer(
    lambda tokens: tokens.real(),
    words_of_number,
    lambda _, expected, actual: real("the density", expected, actual, Tolerance(1e-6, 2e-3)),
)


def _seen(draw: RandomSource, distance: float, low: float, high: float, reach: float = 5.0) -> Inputs:
    """With that cosine at the lamp."""
    position, normal = draw.point(reach), draw.direction()
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


_LEVEL = (2e-4, 8e-4)  # height over a surface, of a way of about 1: a cosine that a threshold of 0.001 takes for 0


def _level_way(draw: RandomSource, normal: Vector) -> Vector:
    """From a place at the centre of the world, whose surface has an axis for its normal: nothing loses digits."""
    along = times(draw.sign() * draw.real(0.5, 2), next_axis(normal))
    return rounded(add(along, normal, draw.logarithmic(*_LEVEL)))


def _nearly_along(draw: RandomSource) -> Inputs:
    normal = draw.axis()
    from_, area_pdf = _level_way(draw, normal), Real(draw.logarithmic(0.05, 20))
    return {"area_pdf": area_pdf, "from": Vec(from_), "position": Vec((0.0, 0.0, 0.0)), "normal": Vec(normal)}


_SOLID_ANGLE_PDF = Function(
    "solid_angle_pdf",
    _PDF,
    (
        Group("any lamp", lambda d: _seen(d, d.real(0.5, 8), 0.1, 0.99)),
        Group("simple numbers", _simple_seen),
        Group("straight before it", lambda d: _seen(d, d.real(0.5, 8), 0.999, 1.0)),
        Group("at a slant", lambda d: _seen(d, d.real(0.5, 8), 0.03, 0.2)),
        Group("near and far", lambda d: _seen(d, d.logarithmic(1, 1000), 0.2, 0.99)),
        Group("very near", lambda d: _seen(d, d.logarithmic(0.003, 0.02), 0.2, 0.99, reach=1.0)),
        Group("nearly along the lamp", _nearly_along),
        Group("from behind", lambda d: _seen(d, d.real(0.5, 8), -0.99, -0.05)),
        Group("along the lamp", _along, exact=True),
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


def _brought_from_level(draw: RandomSource) -> Inputs:
    """By a lamp that lies nearly in the plane of the surface."""
    normal = draw.axis()
    hit = Hit((0.0, 0.0, 0.0), normal, times(-1.0, draw.above(normal, 0.2, 0.95)), 2.0, draw.fill())
    way = _level_way(draw, normal)
    return {
        "hit": hit,
        "radiance": Vec(draw.color(10, 100)),
        "position": Vec(way),
        "normal": Vec(rounded(unit(times(-1.0, way)))),
        "pdf": Real(draw.logarithmic(0.05, 0.2)),
    }


_SAMPLED_LIGHT = Function(
    "sampled_light",
    _COLOR,
    (
        Group("any sample", lambda d: _brought(d, 0.05, 0.99)),
        Group("simple numbers", _simple_brought),
        Group("at a slant", lambda d: _brought(d, 0.02, 0.15)),
        Group("nearly along the surface", _brought_from_level),
        Group("a dark mirror", _dark_wall),
        Group("a low density", lambda d: _brought(d, 0.2, 0.99, pdf=d.logarithmic(1e-5, 0.05))),
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


def _lens_problems(inputs: Inputs, actual: Draws) -> tuple[str, str]:
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
        origin = plane if across else place_problem(turned, apart)
    elif math.sqrt(float(squares.max())) > radius + slack:
        far = "far " if float(squares.max()) > 2.1 * radius * radius else ""  # no square around the lens is so wide
        origin = place_problem(f"a ray starts {far}beyond the rim of the lens", apart)
    elif radius:
        origin = evenness(inputs, DISK, as_shares(squares / radius**2, turns_around(of_x, of_y)))
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


def _lens_problem(inputs: Inputs, _expected: Draws, actual: Draws) -> str:
    return broken_draws(inputs, actual, "a ray") or first(*_lens_problems(inputs, actual))


def _lens_credit(inputs: Inputs, _expected: Draws, actual: Draws) -> float:
    """Half for rays from the right places, or to the right one; a lens without a size has one place only, and who gives
    back the ray that came has no lens."""
    if broken_draws(inputs, actual, "a ray") or not real_of(inputs, "lens_radius"):
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
    return {"frame": frame, "ray": ray, **numbers, **seed_and_times(draw, size)}


_LENS_RAY = Function(
    "lens_ray",
    Answer(draws_reader(6), words_of_draws, _lens_problem, _lens_credit, is_drawn=True),
    (
        Group("a few rays", lambda d: _lens(d, 0.6, 0.98, FEW)),
        Group("many rays", lambda d: _lens(d, 0.6, 0.98, MANY)),
        Group("through the middle of the picture", lambda d: _lens(d, 0.9999, 1.0, FEW)),
        Group("at a slant", lambda d: _lens(d, 0.3, 0.6, FEW)),
        Group("corners of the square", lambda d: {**_lens(d, 0.6, 0.98, FEW), **corners()}, exact=True),
        Group("a lens without a size", lambda d: _lens(d, 0.6, 0.98, FEW, radius=0.0)),
    ),
)

FUNCTIONS = (
    _TURNED_TO,
    _UNIT_DISK,
    _CAP_DIRECTION,
    _SOLID_ANGLE_PDF,
    SAMPLE_TRIANGLE,
    SAMPLE_DISK,
    SAMPLE_SPHERE,
    _SAMPLED_LIGHT,
    _LENS_RAY,
)
