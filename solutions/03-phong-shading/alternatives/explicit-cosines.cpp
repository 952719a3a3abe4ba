// The four cosines are computed by name, and r . v comes from them, without a reflected vector:
// r . v = 2 (n . l)(n . v) - l . v. Colours are multiplied channel by channel in loops.
#include "steps/03-phong-shading/phong_shading.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    const float into_surface = direction.x * normal.x + direction.y * normal.y + direction.z * normal.z;
    glm::vec3 mirrored;
    for (int axis = 0; axis < 3; ++axis) {
        mirrored[axis] = direction[axis] - 2.0F * into_surface * normal[axis];
    }
    return mirrored;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    const float cosine = glm::dot(normal, to_light);
    if (cosine <= 0.0F) {
        return k_black;
    }
    Color result;
    for (int channel = 0; channel < 3; ++channel) {
        result[channel] = fill.kd * fill.color[channel] * light.color[channel] * cosine;
    }
    return result;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    const float light_cosine = glm::dot(normal, to_light);
    const float eye_cosine = glm::dot(normal, to_eye);
    const float between = glm::dot(to_light, to_eye);
    const float highlight_cosine = 2.0F * light_cosine * eye_cosine - between;
    if (light_cosine <= 0.0F || highlight_cosine <= 0.0F) {
        return k_black;
    }
    const float strength = fill.ks * std::pow(highlight_cosine, fill.shine);
    return {strength * light.color.r, strength * light.color.g, strength * light.color.b};
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    const glm::vec3 to_eye = -hit.ray_direction;
    Color sum(0.0F);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[i];
        const glm::vec3 path = light.position - hit.position;
        const glm::vec3 to_light = path / glm::length(path);
        sum = sum + diffuse(hit.fill, light, hit.normal, to_light) +
              specular(hit.fill, light, hit.normal, to_light, to_eye);
    }
    return sum;
}

}  // namespace raysteps
