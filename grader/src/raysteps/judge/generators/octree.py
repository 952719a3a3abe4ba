"""Cases of step 06."""

from raysteps.judge.generators.octree_any_hit import ANY_HIT_IN
from raysteps.judge.generators.octree_bounds import BOUNDS_OF, SPLIT
from raysteps.judge.generators.octree_clip import CLIP
from raysteps.judge.generators.octree_scenes import BUILD_OCTREE
from raysteps.judge.generators.octree_searches import CLOSEST_HIT_IN
from raysteps.judge.generators.octree_sphere_overlaps import SPHERE_OVERLAPS
from raysteps.judge.generators.octree_triangle_overlaps import TRIANGLE_OVERLAPS

FUNCTIONS = (CLIP, SPHERE_OVERLAPS, TRIANGLE_OVERLAPS, BOUNDS_OF, SPLIT, BUILD_OCTREE, CLOSEST_HIT_IN, ANY_HIT_IN)
