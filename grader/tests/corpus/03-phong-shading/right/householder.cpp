// The mirror as a matrix, I - 2 n n^T. Checks what it is given.
#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raysteps {

namespace {

[[maybe_unused]] bool is_unit(const glm::vec3& v) {
    return std::abs(glm::length(v) - 1.0F) < 0.01F;
}

}  // namespace

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    assert(is_unit(normal));
    const glm::mat3 householder = glm::mat3(1.0F) - 2.0F * glm::outerProduct(normal, normal);
    return householder * direction;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    assert(is_unit(normal) && is_unit(to_light));
    const float cosine = glm::dot(to_light, normal);
    return cosine > 0.0F ? cosine * fill.kd * fill.color * light.color : k_black;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    assert(is_unit(normal) && is_unit(to_light) && is_unit(to_eye));
    if (fill.ks == 0.0F || !(glm::dot(to_light, normal) > 0.0F)) {
        return k_black;
    }
    const glm::vec3 travel = -to_light;
    const float cosine = std::clamp(glm::dot(mirror(travel, normal), to_eye), 0.0F, 1.0F);
    const float strength = fill.ks * std::pow(cosine, fill.shine);
    return {strength * light.color.x, strength * light.color.y, strength * light.color.z};
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    const glm::vec3 to_eye = -hit.ray_direction;
    Color sum = k_black;
    while (!lights.empty()) {
        const Light& light = lights.front();
        lights = lights.subspan(1);
        const float distance = glm::distance(light.position, hit.position);
        if (distance == 0.0F) {
            continue;  // the lamp stands on the very point, there is no direction
        }
        const glm::vec3 to_light = (light.position - hit.position) / distance;
        sum = sum + diffuse(hit.fill, light, hit.normal, to_light);
        sum = sum + specular(hit.fill, light, hit.normal, to_light, to_eye);
    }
    return sum;
}

}  // namespace raysteps
