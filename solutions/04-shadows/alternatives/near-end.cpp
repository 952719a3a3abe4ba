// The shadow ray starts as close to the surface as it may.
#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::vec3 origin = hit.position + 1e-4F * hit.normal;
    return {origin, glm::normalize(light.position - origin)};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Ray ray = shadow_ray(hit, light);
    return !scene.occluded(ray, glm::distance(ray.origin, light.position));
}

}  // namespace raysteps
