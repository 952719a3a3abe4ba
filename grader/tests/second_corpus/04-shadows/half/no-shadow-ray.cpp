#include "steps/04-shadows/shadows.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    // TODO: Start a little off the surface and aim at the light.
    RAYSTEPS_TODO("04-shadows", "shadow_ray");
    return Ray{hit.position, hit.normal};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    // Did it all in one place, shadow_ray can be filled in later.
    const glm::vec3 start = hit.position + hit.normal * k_shadow_threshold;
    const glm::vec3 way = light.position - start;
    const float distance = glm::length(way);
    const Ray ray{start, way / distance};
    return !scene.occluded(ray, distance);
}

}  // namespace raysteps
