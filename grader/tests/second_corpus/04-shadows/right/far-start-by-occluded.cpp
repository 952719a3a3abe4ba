#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

namespace {

struct Way {
    Ray ray;
    float length;
};

// The contract allows 0.0001 to 0.01. This scene's things are large.
Way way_to(const HitRecord& hit, const glm::vec3& target) {
    const glm::dvec3 start = glm::dvec3(hit.position) + 0.008 * glm::dvec3(hit.normal);
    const glm::dvec3 arrow = glm::dvec3(target) - start;
    const double length = glm::length(arrow);
    return {Ray{glm::vec3(start), glm::vec3(arrow / length)}, static_cast<float>(length)};
}

}  // namespace

Ray shadow_ray(const HitRecord& hit, const Light& light) { return way_to(hit, light.position).ray; }

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    const Way way = way_to(hit, light.position);
    const bool blocked = scene.occluded(way.ray, way.length);
    return !blocked;
}

}  // namespace raysteps
