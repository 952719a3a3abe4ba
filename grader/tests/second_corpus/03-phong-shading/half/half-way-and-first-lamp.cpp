#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    // TODO: Turn round the part of the direction that runs along the normal, and keep the rest.
    RAYSTEPS_TODO("03-phong-shading", "mirror");
    return glm::vec3(0.0F);
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    float c = glm::dot(normal, to_light);
    if (c < 0) c = 0;
    return Color(fill.kd * c * fill.color.r * light.color.r,
                 fill.kd * c * fill.color.g * light.color.g,
                 fill.kd * c * fill.color.b * light.color.b);
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    // half vector, does not need mirror()
    glm::vec3 half = glm::normalize(to_light + to_eye);
    float c = std::max(glm::dot(half, normal), 0.0f);
    return fill.ks * std::pow(c, fill.shine) * light.color;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    if (lights.empty()) return k_black;
    const Light& light = lights[0];   // only the first one for now
    glm::vec3 l = glm::normalize(light.position - hit.position);
    glm::vec3 v = -hit.ray_direction;
    return diffuse(hit.fill, light, hit.normal, l) + specular(hit.fill, light, hit.normal, l, v);
}

}  // namespace raysteps
