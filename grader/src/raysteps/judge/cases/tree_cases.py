"""What the cases of both trees share, the octree of step 06 and the BVH of step 09: scenes, rays in them, what is asked
of these rays, and in whose tree. Scene and rays are drawn first, then a distance, then whose tree it is."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from raysteps.common.vectors import Vector, add, minus, times, unit
from raysteps.judge.functions import InputGenerator
from raysteps.judge.protocol import Inputs, Ray, Real, f32, rounded
from raysteps.judge.random_source import RandomSource
from raysteps.judge.searches import Rays, RaySegment, RaySegments, TreeSource
from raysteps.judge.surfaces import ScriptedSurface, Sphere, Surface, Surfaces, Triangle, first_distance

# Scenes that trees are built of: small and large surfaces, balls in a grid, many close together.

Scene: TypeAlias = tuple[Surface, ...]

_REACH = 5.0
_FINE = 64  # coordinates are multiples of 1 / 64


def _neat(v: Vector) -> Vector:
    """Short to write, and exact."""
    return round(v[0] * _FINE) / _FINE, round(v[1] * _FINE) / _FINE, round(v[2] * _FINE) / _FINE


def ball(draw: RandomSource, place: Vector, reach: float, radius: tuple[int, int]) -> Sphere:
    """Near a place; the radius in 64ths."""
    return Sphere(_neat(add(place, draw.point(reach))), draw.whole(*radius) / _FINE)


def small_sphere(draw: RandomSource, low: float, high: float) -> Sphere:
    return ball(draw, (0.0, 0.0, 0.0), _REACH, (round(low * _FINE), round(high * _FINE)))


def _triangle(draw: RandomSource, reach: float) -> Triangle:
    shape, place = draw.triangle(reach), draw.point(_REACH - reach)
    return Triangle(_neat(add(place, shape.a)), _neat(add(place, shape.b)), _neat(add(place, shape.c)))


def small_scene(draw: RandomSource, spheres: int, triangles: int, *, largest: float = 0.6) -> Scene:
    """Small spheres, and triangles of all sizes."""
    surfaces: list[Surface] = [small_sphere(draw, 0.1, largest) for _ in range(spheres)]
    surfaces += [_triangle(draw, draw.real(0.5, 4.0)) for _ in range(triangles)]
    return tuple(surfaces)


def any_scene(draw: RandomSource) -> Scene:
    """Some dozens of surfaces, spheres for the most part."""
    return small_scene(draw, draw.whole(25, 40), draw.whole(4, 10))


def large_and_small(draw: RandomSource) -> Scene:
    """A shell around everything, a ground, and little things."""
    ground = Triangle((-20.0, -4.0, 20.0), (20.0, -4.0, 20.0), (0.0, -4.0, -30.0))
    return (Sphere((0.0, 0.0, 0.0), 12.0), ground, *small_scene(draw, 25, 2))


def dense_scene(draw: RandomSource) -> Scene:
    """Few rays get far in it."""
    return tuple(Sphere(draw.simple_point(5), draw.eighths(0.25, 0.75)) for _ in range(200))


SLOPE = Triangle((-8.0, -8.0, -8.0), (24.0, -8.0, 8.0), (-8.0, 24.0, 8.0))
BALLS = tuple(Sphere((4.0 * (i % 4) - 6, 4.0 * (i // 4 % 4) - 6, 4.0 * (i // 16) - 6), 0.75) for i in range(64))


def built(surfaces: Scene) -> Inputs:
    """What a function that builds a tree is given."""
    return {"surfaces": Surfaces(surfaces)}


# One ray in a scene.


def point_within(draw: RandomSource, surface: Surface) -> Vector:
    """A point well within the surface's outline."""
    if isinstance(surface, Sphere):
        return add(surface.center, draw.direction(), 0.7 * surface.radius * draw.real(0, 1))
    assert not isinstance(surface, ScriptedSurface)
    return times(1 / 3, add(add(surface.a, surface.b), surface.c))


def aimed(draw: RandomSource, surfaces: Scene, distance: float) -> Ray:
    """At one of the surfaces; something else may stand before it."""
    return draw.ray_towards(point_within(draw, surfaces[draw.whole(0, len(surfaces) - 1)]), distance)


def aimed_from_inside(draw: RandomSource, surfaces: Scene) -> Ray:
    """At one of the surfaces, from among them."""
    origin = draw.point(4)
    way = minus(point_within(draw, surfaces[draw.whole(0, len(surfaces) - 1)]), origin)
    return Ray(origin, rounded(unit(way)))


# Scenes and the rays through them.

RaysInScene: TypeAlias = tuple[Scene, tuple[Ray, ...]]
MakeRays: TypeAlias = Callable[[RandomSource], RaysInScene]


def one_ray(draw: RandomSource) -> RaysInScene:
    """Mostly aimed at something."""
    surfaces = any_scene(draw)
    return surfaces, (aimed(draw, surfaces, 15) if draw.chance(0.8) else draw.ray_towards(draw.point(9), 20),)


def aimed_ray(draw: RandomSource) -> RaysInScene:
    surfaces = any_scene(draw)
    return surfaces, (aimed(draw, surfaces, 15),)


def from_inside(draw: RandomSource) -> RaysInScene:
    surfaces = small_scene(draw, 35, 8)
    return surfaces, (aimed_from_inside(draw, surfaces),)


def along_axis(draw: RandomSource) -> RaysInScene:
    surfaces = small_scene(draw, 35, 6)
    direction = draw.axis()
    target = point_within(draw, surfaces[draw.whole(0, 34)])
    return surfaces, (Ray(rounded(add(target, direction, -16)), direction),)


def from_far(draw: RandomSource) -> RaysInScene:
    surfaces = small_scene(draw, 25, 6)
    return surfaces, (aimed(draw, surfaces, 100),)


def in_a_large_world(draw: RandomSource) -> RaysInScene:
    """Everything is so many times as large as elsewhere that no hit is nearer than 1000. It is a power of two, so that
    nothing is rounded in another way."""
    surfaces, (ray,) = aimed_ray(draw)
    size = 2.0 ** draw.whole(8, 14)

    def enlarged(surface: Surface) -> Surface:
        if isinstance(surface, Sphere):
            return replace(surface, center=times(size, surface.center), radius=size * surface.radius)
        assert isinstance(surface, Triangle)
        return Triangle(times(size, surface.a), times(size, surface.b), times(size, surface.c))

    return tuple(map(enlarged, surfaces)), (Ray(times(size, ray.origin), ray.direction),)


def looking_away(draw: RandomSource, nearest: float = 10) -> RaysInScene:
    """Everything is behind the ray."""
    surfaces = small_scene(draw, 25, 6)
    direction = draw.direction()
    return surfaces, (Ray(rounded(times(draw.real(nearest, 20), direction)), direction),)


def slope_and_balls(draw: RandomSource) -> RaysInScene:
    """A slanted triangle runs through near boxes and far ones; balls stand before and behind it."""
    return (SLOPE, *BALLS), (draw.ray_towards(draw.point(6), 25),)


def over_a_ground(draw: RandomSource) -> RaysInScene:
    """Something large and many little things: rays that meet the one or the others."""
    surfaces = large_and_small(draw)
    return surfaces, (Ray(draw.point(4), draw.slanted()) if draw.chance(0.5) else aimed(draw, surfaces[2:], 7),)


def many_rays(draw: RandomSource, surfaces: Scene) -> RaysInScene:
    return surfaces, tuple(aimed(draw, surfaces, 16) for _ in range(24))


def among_many(draw: RandomSource) -> RaysInScene:
    """Many rays among many small spheres."""
    return many_rays(draw, small_scene(draw, 200, 0, largest=0.3))


def among_few(draw: RandomSource) -> RaysInScene:
    """So few that they are all in one box, and there is no other."""
    surfaces = small_scene(draw, 1, 1)
    return surfaces, (aimed(draw, surfaces, 15),)


def no_surfaces(draw: RandomSource) -> RaysInScene:
    return (), (draw.ray_towards((0.0, 0.0, 0.0), 5),)


# What is asked: the closest hit, or whether anything occludes the rays before a distance.

Question: TypeAlias = Callable[[RandomSource, Scene, tuple[Ray, ...]], Inputs]
Distance: TypeAlias = Callable[[RandomSource, Scene, Ray], float]

_FAR = 60.0  # the distance where nothing is met


def closest(_draw: RandomSource, _surfaces: Scene, rays: tuple[Ray, ...]) -> Inputs:
    """The closest hit of each ray."""
    return {"rays": Rays(rays)}


def occluded(distance: Distance) -> Question:
    """Whether each ray meets anything before the distance, which is the same for all and that of the first."""

    def ask(draw: RandomSource, surfaces: Scene, rays: tuple[Ray, ...]) -> Inputs:
        return {"rays": Rays(rays), "distance": Real(distance(draw, surfaces, rays[0]))}

    return ask


def occluded_each(distance: Distance) -> Question:
    """Whether each ray meets anything before a distance of its own."""

    def ask(draw: RandomSource, surfaces: Scene, rays: tuple[Ray, ...]) -> Inputs:
        return {"rays": RaySegments(tuple(RaySegment(ray, distance(draw, surfaces, ray)) for ray in rays))}

    return ask


def fixed(distance: float) -> Distance:
    return lambda _draw, _surfaces, _ray: distance


def between(low: float, high: float) -> Distance:
    return lambda draw, _surfaces, _ray: draw.real(low, high)


def times_first(factor: Callable[[RandomSource], float]) -> Distance:
    """So many times as far as the first hit."""
    return lambda draw, surfaces, ray: f32(min(first_distance(surfaces, ray), _FAR) * factor(draw))


def _beyond(draw: RandomSource) -> float:
    return draw.real(1.1, 2)


def _before(draw: RandomSource) -> float:
    return draw.real(0.3, 0.9)


BEYOND_THE_FIRST = times_first(_beyond)
BEFORE_THE_FIRST = times_first(_before)
AROUND_THE_FIRST = times_first(lambda draw: _beyond(draw) if draw.chance(0.6) else _before(draw))


# In whose tree.


def _is_own(draw: RandomSource, share: float) -> bool:
    """Nothing is drawn where it is certain."""
    return share == 1 or (share > 0 and draw.chance(share))


def search(tree: type[TreeSource], question: Question, rays: MakeRays, own: float = 0.5) -> InputGenerator:
    """`own`: the share of the cases in which the submission builds the tree itself."""

    def make(draw: RandomSource) -> Inputs:
        surfaces, sent = rays(draw)
        asked = question(draw, surfaces, sent)
        return {"tree": tree(_is_own(draw, own)), "surfaces": Surfaces(surfaces), **asked}

    return make
