"""Cases of step 06: its functions, and scenes of which a tree is built."""

from raysteps.common.vectors import add
from raysteps.judge.cases.octree_boxes import BOUNDS_OF, CLIP, SPLIT
from raysteps.judge.cases.octree_overlaps import SPHERE_OVERLAPS, TRIANGLE_OVERLAPS
from raysteps.judge.cases.octree_searches import CLOSEST_HIT_IN_OCTREE, OCCLUDED_IN_OCTREE
from raysteps.judge.cases.tree_scenes import built, large_and_small, small_scene, small_sphere
from raysteps.judge.functions import Function, Group
from raysteps.judge.octrees import TREE
from raysteps.judge.protocol import Inputs
from raysteps.judge.random_source import RandomSource
from raysteps.judge.surfaces import Sphere, Surface, Triangle


def _in_one_place(draw: RandomSource) -> Inputs:
    sphere = small_sphere(draw, 0.5, 2)
    return built((sphere,) * draw.whole(9, 12))


def _in_one_plane(draw: RandomSource) -> Inputs:
    height = draw.eighths(-2, 2)
    row: list[Surface] = []
    for i in range(30):
        x, y = float(i % 6), float(i // 6)
        row.append(Triangle((x, y, height), (x + 0.75, y, height), (x, y + 0.75, height)))
    return built(tuple(row))


def _far_away(draw: RandomSource) -> Inputs:
    """All on one side of the centre of the world."""
    sign = draw.sign()
    away = (sign * 64.0, sign * 80.0, sign * 100.0)
    moved = [Sphere(add(s.center, away), s.radius) for s in (small_sphere(draw, 0.1, 0.6) for _ in range(25))]
    return built(tuple(moved))


def _on_walls(draw: RandomSource) -> Inputs:
    """A grid of balls whose middle ones are cut by the walls between the boxes; the box of all is a cube."""
    radius = draw.whole(8, 40) / 64
    row = (-3.0, -1.5, 0.0, 1.5, 3.0)
    column = row[:: draw.whole(1, 2)]
    return built(tuple(Sphere((x, y, z), radius) for x in row for y in row for z in column))


BUILD_OCTREE = Function(
    "build_octree",
    TREE,
    (
        Group("spheres and triangles", lambda d: built(small_scene(d, 30, 8))),
        Group("many small spheres", lambda d: built(small_scene(d, 110, 0, largest=0.3)), saves=True),
        Group("large ones among small ones", lambda d: built(large_and_small(d))),
        Group("all in one place", _in_one_place),
        Group("all in one plane", _in_one_plane),
        Group("far from the centre of the world", _far_away),
        Group("on the walls between the boxes", _on_walls),
        Group("a single surface", lambda d: built(small_scene(d, 1, 0) if d.chance(0.5) else small_scene(d, 0, 1))),
        Group("no surfaces", lambda d: built(())),
    ),
)


FUNCTIONS = (
    CLIP,
    SPHERE_OVERLAPS,
    TRIANGLE_OVERLAPS,
    BOUNDS_OF,
    SPLIT,
    BUILD_OCTREE,
    CLOSEST_HIT_IN_OCTREE,
    OCCLUDED_IN_OCTREE,
)
