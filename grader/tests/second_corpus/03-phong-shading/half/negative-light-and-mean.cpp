#include "steps/03-phong-shading/phong_shading.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& d, const glm::vec3& n) { return d - 2.0F * glm::dot(d, n) * n; }

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& n, const glm::vec3& l) {
    return fill.kd * glm::dot(n, l) * (fill.color * light.color);
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v) {
    const glm::vec3 r = mirror(-l, n);
    const float rv = glm::dot(r, v);
    if (rv <= 0.0F) {
        return k_black;
    }
    return fill.ks * std::pow(rv, fill.shine) * light.color;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    Color total = k_black;
    for (const Light& light : lights) {
        const glm::vec3 l = glm::normalize(light.position - hit.position);
        total += diffuse(hit.fill, light, hit.normal, l);
        total += specular(hit.fill, light, hit.normal, l, -hit.ray_direction);
    }
    // so that many lamps are not too bright
    if (!lights.empty()) {
        total /= static_cast<float>(lights.size());
    }
    return total;
}

}  // namespace raysteps
