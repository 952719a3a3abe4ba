// Mirroring is multiplication by Householder's matrix 1 - 2 n n^T, and the power is taken through exp and log. The
// lights are added up from the last to the first.
#include "steps/03-phong-shading/phong_shading.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raysteps {
namespace {

float power(float base, float exponent) { return base > 0.0F ? std::exp(exponent * std::log(base)) : 0.0F; }

}  // namespace

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    const glm::mat3 householder = glm::mat3(1.0F) - 2.0F * glm::outerProduct(normal, normal);
    return householder * direction;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    const float cosine = std::fmax(0.0F, glm::dot(normal, to_light));
    return cosine * (light.color * (fill.kd * fill.color));
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    const bool light_is_behind = glm::dot(normal, to_light) <= 0.0F;
    if (light_is_behind) {
        return k_black;
    }
    const glm::vec3 highlight = mirror(-to_light, normal);
    return power(glm::dot(highlight, to_eye), fill.shine) * fill.ks * light.color;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    Color sum = k_black;
    for (auto light = lights.rbegin(); light != lights.rend(); ++light) {
        glm::vec3 to_light = light->position - hit.position;
        to_light *= 1.0F / std::sqrt(glm::dot(to_light, to_light));
        const Color from_all_sides = diffuse(hit.fill, *light, hit.normal, to_light);
        const Color highlight = specular(hit.fill, *light, hit.normal, to_light, -hit.ray_direction);
        sum += from_all_sides + highlight;
    }
    return sum;
}

}  // namespace raysteps
