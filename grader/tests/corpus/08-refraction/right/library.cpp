// glm has it all; only where nothing gets out has to be found first.
#include "steps/08-refraction/refraction.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const float c = glm::dot(direction, normal);
    const float k = 1.0F - eta * eta * (1.0F - c * c);
    if (k < 0.0F) return std::nullopt;
    return glm::normalize(glm::refract(direction, normal, eta));
}

namespace {

struct Step {
    glm::vec3 direction;
    float side;  // of the normal
};

Step next_step(const HitRecord& hit, float eta) {
    if (const auto through = refract(hit.ray_direction, hit.normal, eta)) return {*through, -1.0F};
    return {glm::normalize(glm::reflect(hit.ray_direction, hit.normal)), 1.0F};
}

float index_of(const Fill& fill) { return fill.index_of_refraction != 0.0F ? fill.index_of_refraction : 1.0F; }

}  // namespace

Ray transmitted_ray(const HitRecord& hit) {
    const float index = index_of(hit.fill);
    const Step step = next_step(hit, hit.front_face ? 1.0F / index : index / 1.0F);
    return Ray{hit.position + step.side * k_refraction_threshold * hit.normal, step.direction};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    const float t = hit.fill.transmittance;
    return t == 0.0F ? k_black : tracer.trace(transmitted_ray(hit), depth + 1) * t;
}

}  // namespace raysteps
