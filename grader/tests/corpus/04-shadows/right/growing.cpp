// The threshold follows the size of the numbers, as Waechter and Binder advise, between 0.0001 and 0.009.
#include "steps/04-shadows/shadows.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

float threshold(const glm::vec3& p) {
    const float largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return std::clamp(5e-6F * largest, 1e-4F, 9e-3F);
}

}  // namespace

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::vec3 origin = hit.position + threshold(hit.position) * hit.normal;
    const glm::vec3 way = light.position - origin;
    return {origin, way / glm::length(way)};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const auto ray = shadow_ray(hit, light);
    // direction has length 1, so this is the distance
    const float to_light = glm::dot(light.position - ray.origin, ray.direction);
    return !scene.occluded(ray, to_light);
}

}  // namespace raysteps
