// Snell's law with real angles, in double precision: the angle to the normal is turned into the refracted one by asin,
// and the direction is put together in the plane of the two.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const glm::dvec3 inwards = -glm::dvec3(normal);
    const glm::dvec3 sideways = glm::cross(inwards, glm::cross(glm::dvec3(direction), inwards));
    const double sine_in = glm::length(sideways);
    const double cosine_in = glm::dot(glm::dvec3(direction), inwards);
    const double angle_in = std::atan2(sine_in, cosine_in);
    const double sine_out = static_cast<double>(eta) * std::sin(angle_in);
    if (sine_out > 1.0) {
        return std::nullopt;
    }
    if (sine_in == 0.0) {
        return direction;  // straight on
    }
    const double angle_out = std::asin(sine_out);
    return glm::vec3(std::cos(angle_out) * inwards + std::sin(angle_out) * (sideways / sine_in));
}

Ray transmitted_ray(const HitRecord& hit) {
    const float index = hit.fill.index_of_refraction != 0.0F ? hit.fill.index_of_refraction : 1.0F;
    const float outside = 1.0F;
    const float eta = hit.front_face ? outside / index : index / outside;
    const std::optional<glm::vec3> direction = refract(hit.ray_direction, hit.normal, eta);
    const float side = direction ? -1.0F : 1.0F;
    const glm::vec3 origin = hit.position + side * 2.0F * k_refraction_threshold * hit.normal;
    return {origin, glm::normalize(direction ? *direction : mirror(hit.ray_direction, hit.normal))};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    const bool is_glass = hit.fill.transmittance > 0.0F;
    if (!is_glass) {
        return k_black;
    }
    const Color behind = tracer.trace(transmitted_ray(hit), depth + 1);
    return {hit.fill.transmittance * behind.r, hit.fill.transmittance * behind.g, hit.fill.transmittance * behind.b};
}

}  // namespace raysteps
