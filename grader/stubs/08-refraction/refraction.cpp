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
    // TODO: Refract into or out of the glass; where that is impossible, mirror on the same side.
    RAYSTEPS_TODO("08-refraction", "transmitted_ray");
    return Ray{hit.position, hit.ray_direction};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    // TODO: Follow the transmitted ray and weigh what it brings with the transmittance.
    RAYSTEPS_TODO("08-refraction", "transmitted_light");
    return k_black;
}

}  // namespace raysteps
