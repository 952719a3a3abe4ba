// The ray that goes on starts as close to the surface as it may.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const float cosine_in = -glm::dot(direction, normal);
    const float sine_out_squared = eta * eta * (1.0F - cosine_in * cosine_in);
    if (sine_out_squared > 1.0F) {
        return std::nullopt;
    }
    const float cosine_out = std::sqrt(1.0F - sine_out_squared);
    return glm::normalize(eta * direction + (eta * cosine_in - cosine_out) * normal);
}

Ray transmitted_ray(const HitRecord& hit) {
    const float index = hit.fill.index_of_refraction > 0.0F ? hit.fill.index_of_refraction : 1.0F;
    const float eta = hit.front_face ? 1.0F / index : index;
    const glm::vec3 offset = 1e-4F * hit.normal;
    if (const std::optional<glm::vec3> direction = refract(hit.ray_direction, hit.normal, eta)) {
        return {hit.position - offset, *direction};
    }
    return {hit.position + offset, glm::normalize(mirror(hit.ray_direction, hit.normal))};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    if (!(hit.fill.transmittance > 0.0F)) {
        return k_black;
    }
    return hit.fill.transmittance * tracer.trace(transmitted_ray(hit), depth + 1);
}

}  // namespace raysteps
