// By the unit vector along the surface: sine times tangent minus cosine times normal.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const glm::dvec3 d = direction;
    const glm::dvec3 n = normal;
    const glm::dvec3 along = d - glm::dot(d, n) * n;
    const double sine_before = glm::length(along);
    if (sine_before == 0.0) {
        return direction;  // straight down: not bent
    }
    const double sine = static_cast<double>(eta) * sine_before;
    if (sine > 1.0) {
        return std::nullopt;
    }
    const double cosine = std::sqrt((1.0 - sine) * (1.0 + sine));
    const glm::dvec3 tangent = along / sine_before;
    return glm::vec3(sine * tangent - cosine * n);
}

Ray transmitted_ray(const HitRecord& hit) {
    const float far_enough = 0.0025F;
    const Fill& glass = hit.fill;
    float eta = 1.0F;
    if (glass.index_of_refraction != 0.0F) {
        eta = glass.index_of_refraction;
        if (hit.front_face) eta = 1.0F / eta;
    }
    const auto bent = refract(hit.ray_direction, hit.normal, eta);
    if (!bent) {
        return Ray{hit.position + far_enough * hit.normal, mirror(hit.ray_direction, hit.normal)};
    }
    return Ray{hit.position - far_enough * hit.normal, bent.value()};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    if (hit.fill.transmittance == 0.0F) return k_black;
    const Color arriving = tracer.trace(transmitted_ray(hit), depth + 1);
    Color weighed;
    for (int i = 0; i < 3; ++i) weighed[i] = hit.fill.transmittance * arriving[i];
    return weighed;
}

}  // namespace raysteps
