#include "steps/03-phong-shading/phong_shading.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    return glm::reflect(direction, normal);
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    const float cosine = std::clamp(glm::dot(to_light, normal), 0.0F, 1.0F);
    return (light.color * fill.color) * (fill.kd * cosine);
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    if (glm::dot(to_light, normal) <= 0.0F) {
        return k_black;
    }
    const float cosine = glm::dot(glm::reflect(-to_light, normal), to_eye);
    return fill.ks * std::pow(std::fmax(cosine, 0.0F), fill.shine) * light.color;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    return std::transform_reduce(lights.begin(), lights.end(), k_black, std::plus<Color>(), [&](const Light& light) {
        const glm::vec3 l = glm::normalize(light.position - hit.position);
        return diffuse(hit.fill, light, hit.normal, l) +
               specular(hit.fill, light, hit.normal, l, -hit.ray_direction);
    });
}

}  // namespace raysteps
