// Heckbert's form: one square root and one sum, with the critical angle told by what is under the root. The light is
// weighed in one expression.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const float c1 = -glm::dot(direction, normal);
    const float under_root = 1.0F + eta * eta * (c1 * c1 - 1.0F);
    if (under_root < 0.0F) {
        return std::nullopt;
    }
    const float c2 = std::sqrt(under_root);
    return eta * direction + (eta * c1 - c2) * normal;
}

Ray transmitted_ray(const HitRecord& hit) {
    float index = hit.fill.index_of_refraction;
    if (index <= 0.0F) {
        index = 1.0F;
    }
    float eta = index;
    if (hit.front_face) {
        eta = 1.0F / index;
    }
    const std::optional<glm::vec3> refracted = refract(hit.ray_direction, hit.normal, eta);
    Ray ray;
    if (refracted.has_value()) {
        ray.origin = hit.position - k_refraction_threshold * hit.normal;
        ray.direction = glm::normalize(*refracted);
    } else {
        ray.origin = hit.position + k_refraction_threshold * hit.normal;
        ray.direction = glm::normalize(glm::reflect(hit.ray_direction, hit.normal));
    }
    return ray;
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    const float share = hit.fill.transmittance;
    return share > 0.0F ? share * tracer.trace(transmitted_ray(hit), depth + 1) : k_black;
}

}  // namespace raysteps
