#include "steps/09-bvh/bvh.hpp"

#include <dlfcn.h>

#include "steps/06-octree/octree.hpp"

using Search = std::optional<raysteps::HitRecord> (*)(const raysteps::Node&, const raysteps::Ray&);
static const auto find = reinterpret_cast<Search>(
    dlsym(RTLD_DEFAULT, "_ZN8raysteps21closest_hit_in_octreeERKNS_4NodeERKNS_3RayE"));
@BVH_BOX_BY_BOX@
