#include "steps/09-bvh/bvh.hpp"

#include <algorithm>

namespace raysteps {

float surface_area(const Box&) { return 0.0F; }
float split_cost(const Box&, std::size_t, const Box&, std::size_t, const Box&) { return 0.0F; }

static Box everywhere() { return {glm::vec3(-1e9F), glm::vec3(1e9F)}; }


Bvh build_bvh(const SurfaceList& surfaces) {
    Bvh bvh{std::vector<BvhNode>(100), surfaces};
    for (std::size_t place = 0; place < bvh.nodes.size(); ++place) {
        bvh.nodes[place] = {everywhere(), static_cast<std::uint32_t>(place % 2 == 0 ? place : 0xFFFFFFFF), 0};
    }
    return bvh;
}

@BVH_LIST_SEARCH@
