// r . v without r: with r = 2 (n . l) n - l it is 2 (n . l) (n . v) - l . v.
#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

float cosine(const glm::vec3& a, const glm::vec3& b) { return std::max(0.0F, glm::dot(a, b)); }

}  // namespace

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    const glm::vec3 along = glm::dot(direction, normal) * normal;
    const glm::vec3 rest = direction - along;
    return rest - along;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    Color color = fill.color;
    color *= light.color;
    color *= fill.kd;
    color *= cosine(normal, to_light);
    return color;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    const float nl = cosine(normal, to_light);
    if (nl == 0.0F) {
        return k_black;
    }
    const float rv = 2.0F * nl * glm::dot(normal, to_eye) - glm::dot(to_light, to_eye);
    return light.color * (fill.ks * std::pow(std::max(0.0F, rv), fill.shine));
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    Color total_diffuse{};
    Color total_specular{};
    for (const Light& light : lights) {
        const glm::vec3 l = glm::normalize(light.position - hit.position);
        total_diffuse += diffuse(hit.fill, light, hit.normal, l);
        total_specular += specular(hit.fill, light, hit.normal, l, -1.0F * hit.ray_direction);
    }
    return total_diffuse + total_specular;
}

}  // namespace raysteps
