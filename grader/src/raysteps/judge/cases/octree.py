"""Cases of step 06."""

from raysteps.judge.cases.octree_boxes import BOUNDS_OF, CLIP, SPLIT
from raysteps.judge.cases.octree_builds import BUILD_OCTREE
from raysteps.judge.cases.octree_overlaps import SPHERE_OVERLAPS, TRIANGLE_OVERLAPS
from raysteps.judge.cases.octree_searches import CLOSEST_HIT_IN_OCTREE, OCCLUDED_IN_OCTREE

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
