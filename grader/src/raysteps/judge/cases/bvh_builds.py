"""Cases of step 09 with whole scenes: building a tree."""

from raysteps.judge.bvhs import BVH
from raysteps.judge.cases.tree_scenes import ball, built, large_and_small, small_scene
from raysteps.judge.functions import Function, Group
from raysteps.judge.protocol import Inputs
from raysteps.judge.random_source import RandomSource
from raysteps.judge.surfaces import Sphere, Triangle


def _clusters(draw: RandomSource) -> Inputs:
    """Three heaps far from one another, of very different size."""
    sizes = (draw.whole(3, 8), draw.whole(15, 20), draw.whole(35, 45))
    places = ((-20.0, -4.0, 0.0), (2.0, 3.0, 8.0), (9.0, -3.0, -6.0))
    return built(
        tuple(ball(draw, place, 1.5, (4, 12)) for place, n in zip(places, sizes, strict=True) for _ in range(n))
    )


def _long_row(draw: RandomSource) -> Inputs:
    """Along a diagonal, in mixed order."""
    step = (draw.whole(4, 8) / 8, draw.whole(2, 8) / 8, draw.whole(1, 4) / 8)
    places = sorted(range(100), key=lambda _: draw.fine(0, 1))
    return built(tuple(Sphere((i * step[0], i * step[1], i * step[2]), 0.25) for i in places))


def _in_one_place(draw: RandomSource) -> Inputs:
    thing = Sphere(draw.simple_point(4), draw.eighths(0.5, 2)) if draw.chance(0.5) else draw.triangle()
    return built((thing,) * draw.whole(20, 60))


def _one_middle(draw: RandomSource) -> Inputs:
    """Shells around one point: their middles are the same, their boxes are not."""
    center = draw.simple_point(4)
    return built(tuple(Sphere(center, (i + 1) / 4) for i in range(draw.whole(12, 30))))


def _in_one_plane(draw: RandomSource) -> Inputs:
    height, axis = draw.eighths(-2, 2), draw.whole(0, 2)

    def at(x: float, y: float) -> tuple[float, float, float]:
        corner = [x, y]
        corner.insert(axis, height)
        return corner[0], corner[1], corner[2]

    grid = [(float(i % 6), float(i // 6)) for i in range(30)]
    return built(tuple(Triangle(at(x, y), at(x + 0.75, y), at(x, y + 0.75)) for x, y in grid))


def _growing(draw: RandomSource) -> Inputs:
    """Each twice as far and as large as the one before: all middles but a few are in the first bin."""
    sign, count = draw.sign(), draw.whole(14, 20)
    axis = draw.whole(0, 2)
    places = [tuple(sign * 2.0**i if a == axis else 0.0 for a in range(3)) for i in range(-4, count - 4)]
    return built(tuple(Sphere((p[0], p[1], p[2]), max(map(abs, p)) / 4) for p in places))


def _far_away(draw: RandomSource) -> Inputs:
    sign = draw.sign()
    away = (sign * 64.0, sign * 80.0, sign * 100.0)
    return built(tuple(ball(draw, away, 5, (6, 40)) for _ in range(25)))


BUILD_BVH = Function(
    "build_bvh",
    BVH,
    (
        Group("spheres and triangles", lambda d: built(small_scene(d, 30, 8))),
        Group("many small spheres", lambda d: built(small_scene(d, 110, 0, largest=0.3)), saves=True),
        Group("heaps of different size", _clusters),
        Group("a long row", _long_row),
        Group("large ones among small ones", lambda d: built(large_and_small(d))),
        Group("all in one place", _in_one_place),
        Group("one within the other", _one_middle),
        Group("all in one plane", _in_one_plane),
        Group("each twice as large", _growing),
        Group("far from the centre of the world", _far_away),
        Group("two surfaces", lambda d: built(small_scene(d, 1, 1))),
        Group("a single surface", lambda d: built(small_scene(d, 1, 0) if d.chance(0.5) else small_scene(d, 0, 1))),
        Group("no surfaces", lambda d: built(())),
    ),
)
