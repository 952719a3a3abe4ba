"""Cases of step 06 with whole scenes: searching a tree."""

from functools import partial

from raysteps.common.vectors import Vector, add, minus, unit
from raysteps.judge.cases.tree_cases import (
    AROUND_THE_FIRST,
    BALLS,
    SLOPE,
    Distance,
    MakeRays,
    RaysInScene,
    Scene,
    along_axis,
    among_few,
    among_many,
    between,
    closest,
    fixed,
    from_far,
    from_inside,
    in_a_large_world,
    looking_away,
    many_rays,
    no_surfaces,
    occluded,
    one_ray,
    over_a_ground,
    search,
    slope_and_balls,
    small_scene,
)
from raysteps.judge.functions import Function, Group, InputGenerator
from raysteps.judge.protocol import Ray, f32, rounded
from raysteps.judge.random_source import RandomSource
from raysteps.judge.searches import OCCLUSIONS, SEARCHES, TreeSource
from raysteps.judge.surfaces import Triangle

# The closest hit.

_EDGE = 6.75  # of the box around the balls


def _from_above(draw: RandomSource) -> Vector:
    return rounded(unit((draw.real(-0.6, 0.6), draw.real(-0.6, 0.6), -1.0)))


def _ball_before_the_slope(draw: RandomSource) -> RaysInScene:
    """A ray that comes down from above meets one of the balls there, and the slope behind it."""

    def make() -> tuple[Vector, Vector]:
        ball = BALLS[draw.whole(0, 63)]
        return ball.center, _from_above(draw)

    def is_above(found: tuple[Vector, Vector]) -> bool:
        x, y, z = add(*found, 3.0)
        return z > (x + y) / 2

    center, direction = draw.until(is_above, make)
    return (SLOPE, *BALLS), (Ray(rounded(add(center, direction, -25)), direction),)


def _eighth(point: Vector) -> int:
    """Of the space around 0, numbered as split does it."""
    return sum(1 << axis for axis, x in enumerate(point) if x > 0)


def _balls_in_a_row(draw: RandomSource) -> RaysInScene:
    """Through two of the balls, in any direction. The boxes along the ray come in another order than their numbers: who
    searches by number and stops at the first box behind a hit never comes to the near ball."""

    def make() -> tuple[Vector, Vector, Vector, Vector]:
        far, near = (BALLS[draw.whole(0, 63)].center for _ in range(2))
        direction = draw.slanted() if far == near else rounded(unit(add(minus(far, near), draw.point(0.3))))
        return far, near, direction, add(far, direction, draw.real(1, 5))

    def costs_a_hasty_search(found: tuple[Vector, Vector, Vector, Vector]) -> bool:
        far, near, _, beyond = found
        inside = max(abs(x) for x in beyond) < _EDGE
        return inside and _eighth(far) < _eighth(beyond) < _eighth(near)

    _, near, direction, _ = draw.until(costs_a_hasty_search, make)
    return BALLS, (Ray(rounded(add(near, direction, -25)), direction),)


def _at_one_distance(draw: RandomSource) -> RaysInScene:
    """A floor and a tile in it, in the plane z = 0 and with exact numbers: both are met at once, and the first in the
    scene counts. The floor is in boxes that the ray goes through before it comes to the tile's."""
    legs = float(2 ** draw.whole(0, 2))
    corner = (draw.eighths(-5, 1), draw.eighths(-5, 1), 0.0)
    tile = Triangle(corner, add(corner, (legs, 0.0, 0.0)), add(corner, (0.0, legs, 0.0)))
    floor = Triangle((-8.0, -8.0, 0.0), (24.0, -8.0, 0.0), (-8.0, 24.0, 0.0))
    flat = draw.until(lambda found: 0.02 < -found[2] < 0.15, draw.direction)
    target = add(corner, (legs / 4, legs / 4, 0.0))
    surfaces = [tile, floor] if draw.chance(0.7) else [floor, tile]
    balls = [ball for ball in BALLS if ball.center[2] < 0]
    return (*balls, *surfaces), (Ray(rounded(add(target, flat, -30)), flat),)


def _in_crowded_boxes(draw: RandomSource) -> RaysInScene:
    """Many surfaces in each list."""
    return many_rays(draw, small_scene(draw, 250, 50, largest=1.0))


_closest = partial(search, TreeSource, closest)

CLOSEST_HIT_IN_OCTREE = Function(
    "closest_hit_in_octree",
    SEARCHES,
    (
        Group("in three levels of boxes", _closest(one_ray, own=0)),
        Group("in the tree of build_octree", _closest(one_ray, own=1)),
        Group("from inside", _closest(from_inside)),
        Group("along an axis", _closest(along_axis)),
        Group("a nearer hit in a later box", _closest(slope_and_balls)),
        Group("from far away", _closest(from_far)),
        Group("in a large world", _closest(in_a_large_world)),
        Group("everything behind the ray", _closest(looking_away)),
        Group("several at one distance", _closest(_at_one_distance), exact=True),
        Group("crowded boxes", _closest(_in_crowded_boxes, own=0)),
        Group("a ball before a slope", _closest(_ball_before_the_slope, own=0)),
        Group("one ball behind another", _closest(_balls_in_a_row)),
        Group("large ones among small ones", _closest(over_a_ground, own=1)),
        Group("few surfaces are asked", _closest(among_many, own=1), saves=True),
        Group("a single box", _closest(among_few, own=0)),
        Group("no surfaces", _closest(no_surfaces, own=1)),
    ),
)


# Is anything hit before a distance?

# Over all the balls; its edges are powers of 2, so that a ray straight down meets it at an exact distance.
_LID = Triangle((-16.0, -16.0, 8.0), (48.0, -16.0, 8.0), (-16.0, 48.0, 8.0))


def _in_a_later_box(draw: RandomSource) -> RaysInScene:
    """At the end of a way through boxes whose balls the ray passes by."""
    ball = BALLS[draw.whole(0, len(BALLS) - 1)]
    return BALLS, (draw.ray_towards(ball.center, 25),)


def _under_the_lid(draw: RandomSource) -> RaysInScene:
    """A ray from above; the balls lie below the lid."""
    direction = _from_above(draw)
    ball = BALLS[draw.whole(0, len(BALLS) - 1)]
    return (_LID, *BALLS), (Ray(rounded(add(ball.center, direction, -30)), direction),)


def _straight_down(draw: RandomSource) -> RaysInScene:
    """An exact distance from the lid."""
    height = float(draw.whole(1, 8))
    ray = Ray((draw.eighths(-6, 6), draw.eighths(-6, 6), 8.0 + height), (0.0, 0.0, -1.0))
    return (_LID, *BALLS), (ray,)


def _to_the_lid(ray: Ray) -> float:
    return (8 - ray.origin[2]) / ray.direction[2]


def _too_early(draw: RandomSource, _surfaces: Scene, ray: Ray) -> float:
    """The ray meets the lid, but too late."""
    return f32(_to_the_lid(ray) * draw.real(0.1, 0.9))


def _close_to_the_lid(draw: RandomSource, _surfaces: Scene, ray: Ray) -> float:
    """The distance ends closely before the lid, or closely behind it."""
    return f32(_to_the_lid(ray) * (1 + draw.logarithmic(3e-4, 2e-3) * draw.sign()))


def _exactly_there(draw: RandomSource, _surfaces: Scene, ray: Ray) -> float:
    """The lid at the very distance, where it is not nearer, or an eighth before it."""
    return _to_the_lid(ray) + (0.125 if draw.chance(0.5) else 0.0)


def _occluded(rays: MakeRays, distance: Distance, own: float = 0.5) -> InputGenerator:
    return search(TreeSource, occluded(distance), rays, own)


OCCLUDED_IN_OCTREE = Function(
    "occluded_in_octree",
    OCCLUSIONS,
    (
        Group("in three levels of boxes", _occluded(one_ray, AROUND_THE_FIRST, own=0)),
        Group("in the tree of build_octree", _occluded(one_ray, AROUND_THE_FIRST, own=1)),
        Group("from inside", _occluded(from_inside, between(0.5, 6))),
        Group("along an axis", _occluded(along_axis, between(9, 18), own=0)),
        Group("in a later box", _occluded(_in_a_later_box, between(30, 60))),
        Group("everything beyond the distance", _occluded(_under_the_lid, _too_early)),
        Group("close before or behind a hit", _occluded(_under_the_lid, _close_to_the_lid)),
        Group("exactly at the distance", _occluded(_straight_down, _exactly_there), exact=True),
        Group("from far away", _occluded(from_far, between(93, 102))),
        Group("everything behind the ray", _occluded(looking_away, between(10, 50))),
        Group("large ones among small ones", _occluded(over_a_ground, between(2, 9), own=1)),
        Group("crowded boxes", _occluded(_in_crowded_boxes, between(7, 17), own=0)),
        Group("few surfaces are asked", _occluded(among_many, between(13, 15), own=1)),
        Group("a single box", _occluded(among_few, AROUND_THE_FIRST, own=0)),
        Group("no surfaces", _occluded(no_surfaces, fixed(9.0), own=1)),
    ),
    yes_or_no=True,
)
