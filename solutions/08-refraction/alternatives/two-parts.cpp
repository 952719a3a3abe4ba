// The refracted direction in two parts, along the surface and across it: the first is scaled by eta, the second fills
// up the length to 1. In double precision; the ray starts along its own direction and not along the normal.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {
namespace {

using Vec = glm::dvec3;

/// A start that is the threshold away from the surface, or nearly so where the ray grazes it.
glm::vec3 start_of(const HitRecord& hit, const glm::vec3& direction) {
    const float steepness = std::abs(glm::dot(direction, hit.normal));
    return hit.position + k_refraction_threshold / std::fmax(steepness, 0.2F) * direction;
}

}  // namespace

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const Vec n(normal);
    const Vec d(direction);
    const Vec along = d - glm::dot(d, n) * n;
    const Vec along_out = static_cast<double>(eta) * along;
    const double length_squared = glm::dot(along_out, along_out);
    if (length_squared > 1.0) {
        return std::nullopt;
    }
    const Vec across_out = -std::sqrt(1.0 - length_squared) * n;
    return glm::vec3(glm::normalize(along_out + across_out));
}

Ray transmitted_ray(const HitRecord& hit) {
    const float index = hit.fill.index_of_refraction > 0.0F ? hit.fill.index_of_refraction : 1.0F;
    const float eta = hit.front_face ? 1.0F / index : index;
    const glm::vec3 mirrored = glm::normalize(mirror(hit.ray_direction, hit.normal));
    const glm::vec3 direction = refract(hit.ray_direction, hit.normal, eta).value_or(mirrored);
    return {start_of(hit, direction), direction};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    Color sum = k_black;
    if (hit.fill.transmittance > 0.0F) {
        sum += tracer.trace(transmitted_ray(hit), depth + 1) * hit.fill.transmittance;
    }
    return sum;
}

}  // namespace raysteps
