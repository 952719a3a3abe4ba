// Whitted's construction of 1980: the direction is stretched until it crosses the surface at height 1, and the
// refracted one is put together from it and the normal. The critical angle is tested first, by its cosine.
#include "steps/08-refraction/refraction.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {
namespace {

/// Whether the angle to the normal is above the critical one, whose sine is 1 / eta.
bool reflects_totally(float cosine, float eta) {
    if (eta <= 1.0F) {
        return false;
    }
    const float critical_sine = 1.0F / eta;
    const float critical_cosine = std::sqrt((1.0F - critical_sine) * (1.0F + critical_sine));
    return cosine < critical_cosine;
}

}  // namespace

std::optional<glm::vec3> refract(const glm::vec3& direction, const glm::vec3& normal, float eta) {
    const float cosine = std::abs(glm::dot(direction, normal));
    if (reflects_totally(cosine, eta)) {
        return std::nullopt;
    }
    const float relative_index = 1.0F / eta;
    // Whitted's v' = v / |v . n|, here multiplied through by |v . n|, so that grazing rays stay finite.
    const glm::vec3 along_surface = direction + cosine * normal;
    const float under_root = relative_index * relative_index - glm::dot(along_surface, along_surface);
    const float stretch = 1.0F / std::sqrt(std::fmax(under_root, 1e-12F));
    return glm::normalize(stretch * along_surface - normal);
}

Ray transmitted_ray(const HitRecord& hit) {
    const Fill& glass = hit.fill;
    const float index = glass.index_of_refraction == 0.0F ? 1.0F : glass.index_of_refraction;
    const float n1 = hit.front_face ? 1.0F : index;
    const float n2 = hit.front_face ? index : 1.0F;
    if (const auto refracted = refract(hit.ray_direction, hit.normal, n1 / n2)) {
        return Ray{hit.position - k_refraction_threshold * hit.normal, *refracted};
    }
    const glm::vec3 mirrored = mirror(hit.ray_direction, hit.normal);
    return Ray{hit.position + k_refraction_threshold * hit.normal, mirrored};
}

Color transmitted_light(Tracer& tracer, const HitRecord& hit, int depth) {
    if (hit.fill.transmittance <= 0.0F) {
        return Color(0.0F);
    }
    const Ray onward = transmitted_ray(hit);
    Color light = tracer.trace(onward, depth + 1);
    light *= hit.fill.transmittance;
    return light;
}

}  // namespace raysteps
