// glm's own reflect, channels one by one, and shade does everything in its own loop.
#include "steps/03-phong-shading/phong_shading.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    return glm::reflect(direction, normal);
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    float c = glm::dot(normal, to_light);
    if (c < 0) c = 0;
    Color out;
    for (int i = 0; i < 3; i++) out[i] = fill.color[i] * light.color[i] * fill.kd * c;
    return out;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    const float side = glm::dot(normal, to_light);
    if (side <= 0) return Color(0.0f);
    // mirror the eye rather than the light: the angle is the same
    const glm::vec3 r = glm::reflect(-to_eye, normal);
    float c = glm::dot(r, to_light);
    if (c < 0) c = 0;
    return light.color * (fill.ks * std::pow(c, fill.shine));
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    Color total(0.0f);
    const glm::vec3 v = -hit.ray_direction;
    const Fill& f = hit.fill;
    for (std::size_t i = 0; i < lights.size(); i++) {
        glm::vec3 l = lights[i].position - hit.position;
        l = l / glm::length(l);
        const float nl = glm::dot(hit.normal, l);
        if (nl <= 0) continue;
        total += f.kd * nl * f.color * lights[i].color;
        const glm::vec3 r = 2.0f * nl * hit.normal - l;
        const float rv = std::max(0.0f, glm::dot(r, v));
        total += f.ks * std::pow(rv, f.shine) * lights[i].color;
    }
    return total;
}

}  // namespace raysteps
