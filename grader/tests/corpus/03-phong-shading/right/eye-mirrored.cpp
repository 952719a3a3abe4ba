#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    auto mirrored = direction;
    mirrored -= normal * (2.F * glm::dot(normal, direction));
    return mirrored;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    const float facing = glm::dot(normal, to_light);
    if (facing <= 0.F) return k_black;
    return fill.color * light.color * fill.kd * facing;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    if (glm::dot(normal, to_light) <= 0.F) return k_black;
    // The angle is the same whether the light or the look is mirrored.
    const glm::vec3 look = -to_eye;
    const float c = std::fmin(1.F, std::fmax(0.F, glm::dot(mirror(look, normal), to_light)));
    return light.color * std::pow(c, fill.shine) * fill.ks;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    Color sum = k_black;
    for (const auto& light : lights) {
        const glm::vec3 way = light.position - hit.position;
        const glm::vec3 to_light = way / std::sqrt(glm::dot(way, way));
        if (glm::dot(to_light, hit.normal) <= 0.F) continue;  // behind the surface
        sum += diffuse(hit.fill, light, hit.normal, to_light);
        sum += specular(hit.fill, light, hit.normal, to_light, -hit.ray_direction);
    }
    return sum;
}

}  // namespace raysteps
