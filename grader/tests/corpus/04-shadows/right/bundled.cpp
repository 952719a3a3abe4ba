#include "steps/04-shadows/shadows.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>
#include <utility>

namespace raysteps {

namespace {

/// The ray, and how far the light is along it.
std::pair<Ray, float> aim(const HitRecord& hit, const Light& light) {
    Ray ray;
    ray.origin = hit.normal * k_shadow_threshold + hit.position;
    const glm::vec3 way = light.position - ray.origin;
    const float distance = glm::length(way);
    ray.direction = way / distance;
    return {ray, distance};
}

}  // namespace

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    return aim(hit, light).first;
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const auto [ray, distance] = aim(hit, light);
    if (scene.occluded(ray, distance)) {
        return false;
    }
    return true;
}

}  // namespace raysteps
