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

std::optional<HitRecord> closest_hit_in_bvh(const Bvh& bvh, const Ray& ray) {
    std::optional<HitRecord> nearest;
    for (const Surface* surface : bvh.surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && (!nearest || hit->distance < nearest->distance)) {
            nearest = hit;
        }
    }
    return nearest;
}

bool occluded_in_bvh(const Bvh& bvh, const Ray& ray, float distance) {
    const std::optional<HitRecord> hit = closest_hit_in_bvh(bvh, ray);
    return hit && hit->distance < distance;
}

}  // namespace raysteps
