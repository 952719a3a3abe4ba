"""Cases of step 06."""

from raysteps.judge.generators.octree_boxes import BOUNDS_OF, CLIP, SPLIT
from raysteps.judge.generators.octree_overlaps import SPHERE_OVERLAPS, TRIANGLE_OVERLAPS
from raysteps.judge.generators.octree_scenes import BUILD_OCTREE
from raysteps.judge.generators.octree_searches import CLOSEST_HIT_IN

FUNCTIONS = (CLIP, SPHERE_OVERLAPS, TRIANGLE_OVERLAPS, BOUNDS_OF, SPLIT, BUILD_OCTREE, CLOSEST_HIT_IN)
