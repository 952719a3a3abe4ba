// Distances are compared as squares of lengths, from the light's side of the ray.
#include "steps/04-shadows/shadows.hpp"

#include <glm/glm.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    Ray ray;
    ray.origin = hit.position;
    ray.origin += hit.normal * k_shadow_threshold;
    const glm::vec3 way = light.position - ray.origin;
    ray.direction = way / glm::length(way);
    return ray;
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Ray ray = shadow_ray(hit, light);
    auto block = scene.closest_hit(ray);
    if (!block) return true;
    const glm::vec3 a = block->position - ray.origin;
    const glm::vec3 b = light.position - ray.origin;
    if (glm::dot(a, a) < glm::dot(b, b)) return false;
    return true;
}

}  // namespace raysteps
