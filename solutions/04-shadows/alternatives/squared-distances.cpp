// Half the threshold, and squared distances: the hit blocks when its position is nearer to the ray's origin than the
// light is. The direction is taken from the hit itself, and the ray runs beside that line.
#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {
namespace {

constexpr float k_lift = 0.5F * k_shadow_threshold;

float distance_squared(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 gap = b - a;
    return glm::dot(gap, gap);
}

}  // namespace

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    Ray ray;
    ray.origin = hit.position + hit.normal * k_lift;
    ray.direction = glm::normalize(light.position - hit.position);
    return ray;
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Ray ray = shadow_ray(hit, light);
    const std::optional<HitRecord> blocker = scene.closest_hit(ray);
    if (!blocker) {
        return true;
    }
    const float to_blocker = distance_squared(ray.origin, blocker->position);
    const float to_light = distance_squared(ray.origin, light.position);
    return to_light <= to_blocker;
}

}  // namespace raysteps
