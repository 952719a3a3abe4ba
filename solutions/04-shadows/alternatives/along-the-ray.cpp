// The origin is moved along the ray to the light and not along the normal. A light below the surface is ruled out
// before a ray is cast: there the surface itself is in the way.
#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::vec3 to_light = glm::normalize(light.position - hit.position);
    // On the side of the normal, even where the light is on the other one.
    const float side = glm::dot(to_light, hit.normal) > 0.0F ? 1.0F : -1.0F;
    return {hit.position + side * k_shadow_threshold * to_light, to_light};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const bool light_is_above = glm::dot(light.position - hit.position, hit.normal) > 0.0F;
    if (!light_is_above) {
        return false;
    }
    const Ray ray = shadow_ray(hit, light);
    const std::optional<HitRecord> blocker = scene.closest_hit(ray);
    if (blocker.has_value() && blocker->distance < glm::length(light.position - ray.origin)) {
        return false;
    }
    return true;
}

}  // namespace raysteps
