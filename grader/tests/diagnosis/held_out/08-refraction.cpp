// The direction is taken apart: the part across the surface is stretched by eta, the part along the normal follows.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/glm.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const float along = glm::dot(direction, normal);
    const glm::vec3 across = direction - along * normal;
    const glm::vec3 bent = eta * across;
    const float rest = 1.0f - glm::dot(bent, bent);
    if (rest < 0) return {};
    return glm::normalize(bent - std::sqrt(rest) * normal);
}

Ray transmitted_ray(const HitRecord& hit) {
    float n = hit.fill.index_of_refraction;
    if (n == 0) n = 1;
    float eta = n;
    if (hit.front_face) eta = 1 / n;
    auto inside = refract(hit.ray_direction, hit.normal, eta);
    Ray out;
    if (inside) {
        out.direction = *inside;
        out.origin = hit.position - hit.normal * k_refraction_threshold;
    } else {
        out.direction = glm::normalize(glm::reflect(hit.ray_direction, hit.normal));
        out.origin = hit.position + hit.normal * k_refraction_threshold;
    }
    return out;
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    const float t = hit.fill.transmittance;
    if (t <= 0) return Color(0.0f);
    Color c = tracer.trace(transmitted_ray(hit), depth + 1);
    c *= t;
    return c;
}

}  // namespace raysteps
