#include "steps/09-bvh/bvh.hpp"

#include <algorithm>

namespace raysteps {

float surface_area(const Box&) { return 0.0F; }
float split_cost(const Box&, std::size_t, const Box&, std::size_t, const Box&) { return 0.0F; }

static Box everywhere() { return {glm::vec3(-1e9F), glm::vec3(1e9F)}; }


Bvh build_bvh(const SurfaceList& surfaces) {
    return {std::vector<BvhNode>(10'000'000, BvhNode{everywhere(), 0, 1'000'000'000}), surfaces};
}

@BVH_LIST_SEARCH@
