#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::vec3 start = hit.position + k_shadow_threshold * hit.normal;
    return Ray{start, glm::normalize(light.position - start)};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Ray ray = shadow_ray(hit, light);
    const glm::vec3 way = light.position - ray.origin;
    const float distance = glm::dot(way, way);
    return !scene.occluded(ray, distance);
}

}  // namespace raysteps
