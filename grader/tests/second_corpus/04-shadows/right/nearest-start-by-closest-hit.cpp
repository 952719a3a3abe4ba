// Starts near the lower end of what is allowed, aims from the hit itself, and asks closest_hit.
#include "steps/04-shadows/shadows.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

constexpr float k_off = 0.00015F;

}  // namespace

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::vec3 way = light.position - hit.position;
    return Ray{hit.position + k_off * hit.normal, way / std::sqrt(glm::dot(way, way))};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Ray ray = shadow_ray(hit, light);
    const float to_light = glm::length(light.position - ray.origin);
    if (const auto first = scene.closest_hit(ray)) {
        return first->distance >= to_light;
    }
    return true;
}

}  // namespace raysteps
