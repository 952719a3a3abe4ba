#include "steps/08-refraction/refraction.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    // TODO: Find the refracted direction by Snell's law, or nothing where its sine would be above 1.
    RAYSTEPS_TODO("08-refraction", "refract");
    return std::nullopt;
}

Ray transmitted_ray(const HitRecord& hit) {
    const float index = hit.fill.index_of_refraction == 0.0F ? 1.0F : hit.fill.index_of_refraction;
    const float eta = hit.front_face ? 1.0F / index : index;
    if (const auto direction = refract(hit.ray_direction, hit.normal, eta)) {
        return Ray{hit.position - k_refraction_threshold * hit.normal, *direction};
    }
    return Ray{hit.position + k_refraction_threshold * hit.normal, mirror(hit.ray_direction, hit.normal)};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    Color light = k_black;
    if (hit.fill.transmittance > 0.0F) {
        light = hit.fill.transmittance * tracer.trace(transmitted_ray(hit), depth + 1);
    }
    return light;
}

}  // namespace raysteps
