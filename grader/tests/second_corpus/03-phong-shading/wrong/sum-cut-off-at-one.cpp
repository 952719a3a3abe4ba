#include "steps/03-phong-shading/phong_shading.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    return direction - 2.0F * glm::dot(direction, normal) * normal;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    const float cosine = std::max(glm::dot(normal, to_light), 0.0F);
    return cosine * fill.kd * (fill.color * light.color);
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    if (glm::dot(normal, to_light) <= 0.0F) {
        return k_black;
    }
    const float cosine = std::max(glm::dot(mirror(-to_light, normal), to_eye), 0.0F);
    return fill.ks * std::pow(cosine, fill.shine) * light.color;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    Color sum = k_black;
    for (const Light& light : lights) {
        const glm::vec3 to_light = glm::normalize(light.position - hit.position);
        sum += diffuse(hit.fill, light, hit.normal, to_light);
        sum += specular(hit.fill, light, hit.normal, to_light, -hit.ray_direction);
    }
    return glm::min(sum, k_white);  // a pixel cannot be more than white
}

}  // namespace raysteps
