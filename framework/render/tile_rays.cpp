#include "render/tile_rays.hpp"

#include <algorithm>

namespace raysteps {

constexpr std::size_t k_rays = 8;  // of a pixel with hints of their own; the last of them is for all others, too

TileRays::TileRays(const Accelerator& accelerator, const Scene& scene)
    : RayCounter(accelerator),
      lights_(scene.lights.size() + scene.area_lights.size()),
      queries_(k_rays * lights_, HintedQuery(accelerator)) {}

const SceneQuery& TileRays::shadow_query(RayNumber ray, std::size_t light) {
    return queries_[std::min(ray, k_rays - 1) * lights_ + light];
}

std::optional<HitRecord> TileRays::HintedQuery::closest_hit(const Ray& ray) const {
    ++thread_stats().shadow;
    return scene_.closest_hit(ray);
}

bool TileRays::HintedQuery::occluded(const Ray& ray, float distance) const {
    ++thread_stats().shadow;
    return scene_.occluded_with_hint(ray, distance, hint_);
}

}  // namespace raysteps
