#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    return direction - 2.0F * glm::dot(direction, normal) * normal;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    const float cosine = std::max(glm::dot(to_light, normal), 0.0F);
    return fill.kd * cosine * fill.color * light.color;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    // TODO: Mirror the light's direction of travel, and raise its cosine with the eye to the power of shine.
    RAYSTEPS_TODO("03-phong-shading", "specular");
    return k_black;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    Color sum = k_black;
    for (const Light& light : lights) {
        const glm::vec3 to_light = glm::normalize(light.position - hit.position);
        sum += diffuse(hit.fill, light, hit.normal, to_light);
        sum += specular(hit.fill, light, hit.normal, to_light, -hit.ray_direction);
    }
    return sum;
}

}  // namespace raysteps
