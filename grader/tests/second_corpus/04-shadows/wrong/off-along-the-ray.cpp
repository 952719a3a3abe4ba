#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::vec3 direction = glm::normalize(light.position - hit.position);
    // a little way towards the light
    return Ray{hit.position + k_shadow_threshold * direction, direction};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Ray ray = shadow_ray(hit, light);
    return !scene.occluded(ray, glm::length(light.position - ray.origin));
}

}  // namespace raysteps
