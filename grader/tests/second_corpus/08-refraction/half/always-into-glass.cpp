#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const float cosine = -glm::dot(direction, normal);
    const float sine2 = eta * eta * (1.0F - cosine * cosine);
    if (sine2 > 1.0F) {
        return std::nullopt;
    }
    return glm::normalize(eta * direction + (eta * cosine - std::sqrt(1.0F - sine2)) * normal);
}

Ray transmitted_ray(const HitRecord& hit) {
    // into glass eta is 1 / index, so the result is never empty
    const float eta = 1.0F / hit.fill.index_of_refraction;
    const auto direction = refract(hit.ray_direction, hit.normal, eta);
    return Ray{hit.position - k_refraction_threshold * hit.normal, *direction};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    if (hit.fill.transmittance <= 0.0F) {
        return k_black;
    }
    return hit.fill.transmittance * tracer.trace(transmitted_ray(hit), depth + 1);
}

}  // namespace raysteps
