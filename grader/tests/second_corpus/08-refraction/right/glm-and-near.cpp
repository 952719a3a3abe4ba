#include "steps/08-refraction/refraction.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    // GLM gives (0, 0, 0) where nothing gets through.
    const glm::dvec3 bent = glm::refract(glm::dvec3(direction), glm::dvec3(normal), static_cast<double>(eta));
    if (bent == glm::dvec3(0.0)) {
        return std::nullopt;
    }
    return glm::vec3(glm::normalize(bent));
}

Ray transmitted_ray(const HitRecord& hit) {
    constexpr float off = 0.0002F;
    float index = hit.fill.index_of_refraction;
    if (index == 0.0F) {
        index = 1.0F;
    }
    const auto bent = refract(hit.ray_direction, hit.normal, hit.front_face ? 1.0F / index : index);
    Ray next;
    next.origin = bent ? hit.position - off * hit.normal : hit.position + off * hit.normal;
    next.direction = bent ? *bent : glm::normalize(glm::reflect(hit.ray_direction, hit.normal));
    return next;
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    const float share = hit.fill.transmittance;
    return share > 0.0F ? tracer.trace(transmitted_ray(hit), depth + 1) * share : k_black;
}

}  // namespace raysteps
