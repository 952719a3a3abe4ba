// dielectric, after "Ray Tracing in One Weekend" (without the dice)
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

using dvec = glm::dvec3;

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float etai_over_etat) {
    const double ratio = etai_over_etat;
    const dvec uv = glm::normalize(dvec(direction));
    const dvec n = glm::normalize(dvec(normal));

    const double cos_theta = std::fmin(glm::dot(-uv, n), 1.0);
    const double sin_theta = std::sqrt(1.0 - cos_theta * cos_theta);
    const bool cannot_refract = ratio * sin_theta > 1.0;
    if (cannot_refract) return {};

    const dvec r_out_perp = ratio * (uv + cos_theta * n);
    const dvec r_out_parallel = -std::sqrt(std::fabs(1.0 - glm::dot(r_out_perp, r_out_perp))) * n;
    return glm::vec3(glm::normalize(r_out_perp + r_out_parallel));
}

Ray transmitted_ray(const HitRecord& rec) {
    float ir = rec.fill.index_of_refraction;
    if (ir == 0) ir = 1;
    const float refraction_ratio = rec.front_face ? (1.0F / ir) : ir;

    if (auto refracted = refract(rec.ray_direction, rec.normal, refraction_ratio))
        return {rec.position - 0.0001F * rec.normal, *refracted};

    const glm::vec3 v = rec.ray_direction;
    const glm::vec3 reflected = v - 2 * glm::dot(v, rec.normal) * rec.normal;
    return {rec.position + 0.0001F * rec.normal, glm::normalize(reflected)};
}

Color transmitted_light(Tracer& tracer, const HitRecord& rec, int depth) {
    const float attenuation = rec.fill.transmittance;
    if (attenuation == 0) return Color(0, 0, 0);
    return attenuation * tracer.trace(transmitted_ray(rec), depth + 1);
}

}  // namespace raysteps
