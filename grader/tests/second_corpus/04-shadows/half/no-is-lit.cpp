#include "steps/04-shadows/shadows.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::vec3 start = hit.position + k_shadow_threshold * hit.normal;
    return Ray{start, glm::normalize(light.position - start)};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    // TODO: Cast the shadow ray and ask whether it meets anything before it reaches the light.
    RAYSTEPS_TODO("04-shadows", "is_lit");
    return false;
}

}  // namespace raysteps
