#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& d, const glm::vec3& n, float eta)
{
    const float c1 = -glm::dot(d, n);
    const float s2 = eta * eta * (1.0f - c1 * c1);
    const float c2 = std::sqrt(1.0f - s2);
    return eta * (d + c1 * n) - c2 * n;
}

Ray transmitted_ray(const HitRecord& hit)
{
    const float index = hit.fill.index_of_refraction;
    float eta = index;
    if (hit.front_face)
        eta = 1.0f / index;

    // off the surface, as in steps 04 and 05
    const glm::vec3 start = hit.position + k_refraction_threshold * hit.normal;
    const auto bent = refract(hit.ray_direction, hit.normal, eta);
    if (bent)
        return {start, *bent};
    return {start, mirror(hit.ray_direction, hit.normal)};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth)
{
    if (hit.fill.transmittance == 0.0f)
        return k_black;
    return tracer.trace(transmitted_ray(hit), depth + 1);
}

}  // namespace raysteps
