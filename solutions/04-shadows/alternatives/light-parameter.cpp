// Distances are measured along the ray, in double precision, with twice the threshold: the light has its own parameter
// t on the ray, and the blocker's must be smaller.
#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {
namespace {

constexpr double k_lift = 2.0 * static_cast<double>(k_shadow_threshold);

double parameter_on(const Ray& ray, const glm::vec3& point) {
    const glm::dvec3 gap = glm::dvec3(point) - glm::dvec3(ray.origin);
    const glm::dvec3 direction(ray.direction);
    return glm::dot(gap, direction) / glm::dot(direction, direction);
}

}  // namespace

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::dvec3 origin = glm::dvec3(hit.position) + k_lift * glm::dvec3(hit.normal);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(light.position) - origin);
    return {glm::vec3(origin), glm::vec3(direction)};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Ray ray = shadow_ray(hit, light);
    if (const auto blocker = scene.closest_hit(ray)) {
        const bool in_between = parameter_on(ray, blocker->position) < parameter_on(ray, light.position);
        return !in_between;
    }
    return true;
}

}  // namespace raysteps
