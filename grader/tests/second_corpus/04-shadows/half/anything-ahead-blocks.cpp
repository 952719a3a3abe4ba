#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light)
{
    const auto origin = hit.position + hit.normal * k_shadow_threshold;
    const auto direction = glm::normalize(light.position - origin);
    return {origin, direction};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light)
{
    return !scene.closest_hit(shadow_ray(hit, light)).has_value();
}

}  // namespace raysteps
