"""Cases of step 09."""

from raysteps.judge.generators.bvh_any_hits import ANY_HIT_IN_BVH
from raysteps.judge.generators.bvh_costs import SPLIT_COST, SURFACE_AREA
from raysteps.judge.generators.bvh_scenes import BUILD_BVH
from raysteps.judge.generators.bvh_searches import CLOSEST_HIT_IN_BVH

FUNCTIONS = (SURFACE_AREA, SPLIT_COST, BUILD_BVH, CLOSEST_HIT_IN_BVH, ANY_HIT_IN_BVH)
