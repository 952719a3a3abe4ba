#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    Ray ray;
    ray.origin = hit.position;
    ray.direction = light.position - hit.position;
    ray.direction /= glm::length(ray.direction);
    return ray;
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    Ray ray = shadow_ray(hit, light);
    float dist = glm::length(light.position - hit.position);
    auto blocker = scene.closest_hit(ray);
    if (!blocker) return true;
    // behind the light?
    return blocker->distance > dist;
}

}  // namespace raysteps
