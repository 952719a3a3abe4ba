#include "steps/04-shadows/shadows.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    // BEGIN SOLUTION shadow_ray
    // TODO: Start a little off the surface and aim at the light.
    // RETURN Ray{hit.position, hit.normal}
    const glm::vec3 origin = hit.position + k_shadow_threshold * hit.normal;
    return {origin, glm::normalize(light.position - origin)};
    // END SOLUTION
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    // BEGIN SOLUTION is_lit
    // TODO: Cast the shadow ray and ask whether it meets anything before it reaches the light.
    // RETURN false
    const Ray ray = shadow_ray(hit, light);
    return !scene.occluded(ray, glm::distance(ray.origin, light.position));
    // END SOLUTION
}

}  // namespace raysteps
