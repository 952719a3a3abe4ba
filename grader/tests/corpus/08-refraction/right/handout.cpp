#include "steps/08-refraction/refraction.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const float cos1 = -glm::dot(direction, normal);
    const float sin2_squared = eta * eta * (1.0F - cos1 * cos1);
    if (sin2_squared > 1.0F) {
        return std::nullopt;
    }
    const float cos2 = std::sqrt(1.0F - std::max(sin2_squared, 0.0F));
    return glm::normalize(eta * (direction + cos1 * normal) - cos2 * normal);
}

Ray transmitted_ray(const HitRecord& hit) {
    const float given = hit.fill.index_of_refraction;
    const float index = given == 0.0F ? 1.0F : given;
    const float eta = hit.front_face ? 1.0F / index : index;
    const std::optional<glm::vec3> bent = refract(hit.ray_direction, hit.normal, eta);
    if (!bent) {
        return Ray{hit.position + k_refraction_threshold * hit.normal,
                   glm::normalize(mirror(hit.ray_direction, hit.normal))};
    }
    return Ray{hit.position - k_refraction_threshold * hit.normal, *bent};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    if (hit.fill.transmittance <= 0.0F) {
        return k_black;
    }
    return hit.fill.transmittance * tracer.trace(transmitted_ray(hit), depth + 1);
}

}  // namespace raysteps
