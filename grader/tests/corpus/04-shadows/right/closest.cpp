#include "steps/04-shadows/shadows.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    Ray ray;
    ray.origin = hit.position;
    ray.origin += hit.normal * 0.0001F;  // a tenth of the handout's
    ray.direction = glm::normalize(light.position - ray.origin);
    return ray;
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Ray ray = shadow_ray(hit, light);
    const std::optional<HitRecord> blocker = scene.closest_hit(ray);
    if (!blocker) {
        return true;
    }
    if (blocker->distance < glm::distance(ray.origin, light.position)) {
        return false;
    }
    return true;  // it stands behind the light
}

}  // namespace raysteps
