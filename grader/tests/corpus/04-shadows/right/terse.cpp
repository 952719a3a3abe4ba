#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const auto o = hit.position + hit.normal * 5e-4f;
    return {o, glm::normalize(light.position - o)};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const auto ray = shadow_ray(hit, light);
    const auto blocker = scene.closest_hit(ray);
    return !blocker || blocker->distance >= glm::length(ray.origin - light.position);
}

}  // namespace raysteps
