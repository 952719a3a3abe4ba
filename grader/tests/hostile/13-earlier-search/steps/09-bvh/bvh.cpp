#include "steps/09-bvh/bvh.hpp"

#include "steps/06-octree/octree.hpp"

static std::optional<raysteps::HitRecord> (*const find)(const raysteps::Node&,
                                                        const raysteps::Ray&) = &raysteps::closest_hit_in_octree;
@BVH_BOX_BY_BOX@
