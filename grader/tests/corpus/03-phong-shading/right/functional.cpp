#include "steps/03-phong-shading/phong_shading.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    return -2.0F * glm::dot(normal, direction) * normal + direction;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    const auto weight = fill.kd * std::clamp(glm::dot(normal, to_light), 0.0F, 1.0F);
    return weight * light.color * fill.color;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    const bool behind = !(glm::dot(normal, to_light) > 0.0F);
    const auto towards_eye = std::max(glm::dot(mirror(-to_light, normal), to_eye), 0.0F);
    return behind ? k_black : Color(light.color * fill.ks * std::pow(towards_eye, fill.shine));
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    const auto of_one = [&hit](const Light& light) {
        const auto l = glm::normalize(light.position - hit.position);
        return diffuse(hit.fill, light, hit.normal, l) + specular(hit.fill, light, hit.normal, l, -hit.ray_direction);
    };
    return std::transform_reduce(lights.begin(), lights.end(), k_black, std::plus<>{}, of_one);
}

}  // namespace raysteps
