#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const float c = -glm::dot(direction, normal);
    const float k = 1.0F - eta * eta * (1.0F - c * c);
    if (k < 0.0F) {
        return std::nullopt;
    }
    return eta * direction + (eta * c - std::sqrt(k)) * normal;
}

Ray transmitted_ray(const HitRecord& hit) {
    const float index = hit.fill.index_of_refraction;
    const float eta = hit.front_face ? 1.0F / index : index;
    if (const auto bent = refract(hit.ray_direction, hit.normal, eta)) {
        return {hit.position - k_refraction_threshold * hit.normal, *bent};
    }
    return {hit.position + k_refraction_threshold * hit.normal, mirror(hit.ray_direction, hit.normal)};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    return hit.fill.transmittance > 0.0F ? hit.fill.transmittance * tracer.trace(transmitted_ray(hit), depth + 1)
                                         : k_black;
}

}  // namespace raysteps
