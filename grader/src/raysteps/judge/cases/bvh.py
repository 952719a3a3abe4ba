"""Cases of step 09."""

from raysteps.judge.cases.bvh_builds import BUILD_BVH
from raysteps.judge.cases.bvh_costs import SPLIT_COST, SURFACE_AREA
from raysteps.judge.cases.bvh_searches import CLOSEST_HIT_IN_BVH, OCCLUDED_IN_BVH

FUNCTIONS = (SURFACE_AREA, SPLIT_COST, BUILD_BVH, CLOSEST_HIT_IN_BVH, OCCLUDED_IN_BVH)
