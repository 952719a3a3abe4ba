// Mirroring through projection: the part of the direction along the normal is split off and turned round. The
// highlight mirrors the eye and not the light, which gives the same cosine.
#include "steps/03-phong-shading/phong_shading.hpp"

#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace raysteps {
namespace {

glm::vec3 part_along(const glm::vec3& v, const glm::vec3& axis) {
    return (glm::dot(v, axis) / glm::dot(axis, axis)) * axis;
}

}  // namespace

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    const glm::vec3 across = part_along(direction, normal);
    const glm::vec3 along_surface = direction - across;
    return along_surface - across;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    const Color reflected = fill.color * fill.kd;
    const Color arriving = light.color * glm::max(0.0F, glm::dot(to_light, normal));
    return reflected * arriving;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    if (!(glm::dot(to_light, normal) > 0.0F)) {
        return k_black;
    }
    const glm::vec3 mirrored_eye = mirror(-to_eye, normal);
    const float cosine = glm::clamp(glm::dot(mirrored_eye, to_light), 0.0F, 1.0F);
    return light.color * glm::pow(cosine, fill.shine) * fill.ks;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    Color all_diffuse = k_black;
    Color all_specular = k_black;
    for (const Light& light : lights) {
        const glm::vec3 to_light = glm::normalize(light.position - hit.position);
        all_diffuse += diffuse(hit.fill, light, hit.normal, to_light);
        all_specular += specular(hit.fill, light, hit.normal, to_light, -hit.ray_direction);
    }
    return all_diffuse + all_specular;
}

}  // namespace raysteps
