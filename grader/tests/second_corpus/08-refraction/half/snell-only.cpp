#include "steps/08-refraction/refraction.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    // parts of d along the normal and along the surface
    float cos1 = -glm::dot(direction, normal);
    glm::vec3 along = direction + cos1 * normal;

    float sin2squared = eta * eta * (1 - cos1 * cos1);
    if (sin2squared > 1) {
        return std::nullopt;   // total internal reflection
    }
    float cos2 = std::sqrt(1 - sin2squared);
    return eta * along - cos2 * normal;
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
