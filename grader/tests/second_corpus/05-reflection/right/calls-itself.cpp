#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

namespace {

Color mirrored(Tracer& tracer, const HitRecord& hit, int depth) {
    return hit.fill.ks > 0.0F ? hit.fill.ks * trace(tracer, reflected_ray(hit), depth + 1) : k_black;
}

}  // namespace

Ray reflected_ray(const HitRecord& hit) {
    const float along = glm::dot(hit.ray_direction, hit.normal);
    const glm::vec3 out = glm::normalize(hit.ray_direction - (along + along) * hit.normal);
    return {hit.position + 0.0025F * hit.normal, out};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    const bool too_deep = depth > tracer.max_ray_depth();
    const auto hit = too_deep ? std::nullopt : tracer.closest_hit(ray);
    if (hit) {
        const Color reflected = mirrored(tracer, *hit, depth);
        return reflected + tracer.direct_lighting(*hit, depth);
    }
    return !too_deep && depth == 1 ? tracer.background() : k_black;
}

}  // namespace raysteps
