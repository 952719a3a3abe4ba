// With the angles themselves, as in school.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(direction));
    const glm::dvec3 n = glm::normalize(glm::dvec3(normal));

    const double cosine = -glm::dot(d, n);
    const glm::dvec3 along = d + cosine * n;
    const double sine = glm::length(along);
    if (sine < 1e-12) {
        return glm::vec3(d);  // straight in: nothing bends
    }

    const double angle1 = std::atan2(sine, cosine);
    const double sine2 = static_cast<double>(eta) * std::sin(angle1);
    if (sine2 > 1.0) {
        return std::nullopt;
    }
    const double angle2 = std::asin(sine2);
    const glm::dvec3 tangent = along / sine;
    return glm::vec3(std::sin(angle2) * tangent - std::cos(angle2) * n);
}

Ray transmitted_ray(const HitRecord& hit) {
    double n1 = 1.0;
    double n2 = hit.fill.index_of_refraction == 0.0F ? 1.0 : hit.fill.index_of_refraction;
    if (!hit.front_face) {
        std::swap(n1, n2);
    }

    Ray ray;
    const auto bent = refract(hit.ray_direction, hit.normal, static_cast<float>(n1 / n2));
    if (bent.has_value()) {
        ray.direction = bent.value();
        ray.origin = hit.position - 0.003F * hit.normal;
    } else {
        ray.direction = glm::normalize(mirror(hit.ray_direction, hit.normal));
        ray.origin = hit.position + 0.003F * hit.normal;
    }
    return ray;
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    Color light(0.0F);
    if (hit.fill.transmittance > 0.0F) {
        const Ray onwards = transmitted_ray(hit);
        light = tracer.trace(onwards, depth + 1);
        light *= hit.fill.transmittance;
    }
    return light;
}

}  // namespace raysteps
