#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const float cosine = -glm::dot(direction, normal);
    const float sine_squared = eta * eta * (1.0F - cosine * cosine);
    if (sine_squared > 1.0F) {
        return std::nullopt;
    }
    const glm::vec3 along = eta * (direction + cosine * normal);
    return along - std::sqrt(1.0F - sine_squared) * normal;
}

Ray transmitted_ray(const HitRecord& hit) {
    const float index = hit.fill.index_of_refraction == 0.0F ? 1.0F : hit.fill.index_of_refraction;
    const float eta = hit.front_face ? 1.0F / index : index;
    const glm::vec3 start = hit.position - k_refraction_threshold * hit.normal;
    const auto bent = refract(hit.ray_direction, hit.normal, eta);
    return Ray{start, bent ? *bent : mirror(hit.ray_direction, hit.normal)};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    if (hit.fill.transmittance <= 0.0F) {
        return k_black;
    }
    return hit.fill.transmittance * tracer.trace(transmitted_ray(hit), depth + 1);
}

}  // namespace raysteps
