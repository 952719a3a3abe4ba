// Asks only usable questions, and looks at the answer twice.
#include "steps/04-shadows/shadows.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace raysteps {

namespace {

constexpr float k_off_the_surface = 5.0F * k_shadow_threshold;

glm::dvec3 unit_or(const glm::dvec3& v, const glm::vec3& otherwise) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(otherwise);
}

}  // namespace

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::vec3 start = hit.position + k_off_the_surface * hit.normal;
    const glm::dvec3 way = glm::dvec3(light.position) - glm::dvec3(start);
    return Ray{start, glm::vec3(unit_or(way, hit.normal))};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Ray ray = shadow_ray(hit, light);
    const float distance = glm::distance(light.position, ray.origin);
    if (!(distance > 0.0F) || !std::isfinite(distance)) {
        return true;  // no room for anything between
    }
    const std::optional<HitRecord> first = scene.closest_hit(ray);
    const bool free_by_closest = !first.has_value() || first->distance >= distance;
    const bool free_by_occluded = !scene.occluded(ray, distance);
    return free_by_closest && free_by_occluded;
}

}  // namespace raysteps
