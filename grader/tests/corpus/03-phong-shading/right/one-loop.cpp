// CS148 homework style: shade does it all in one loop and in double, the others are small
#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    return glm::vec3(glm::reflect(glm::dvec3(direction), glm::dvec3(normal)));
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    double nDotL = glm::dot(glm::dvec3(normal), glm::dvec3(to_light));
    return Color(std::max(nDotL, 0.0) * double(fill.kd) * glm::dvec3(fill.color) * glm::dvec3(light.color));
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    const glm::dvec3 n(normal), l(to_light), v(to_eye);
    Color result = k_black;
    if (glm::dot(n, l) > 0.0) {
        double rDotV = glm::dot(glm::reflect(-l, n), v);
        if (rDotV < 0.0) rDotV = 0.0;
        result = Color(double(fill.ks) * std::pow(rDotV, double(fill.shine)) * glm::dvec3(light.color));
    }
    return result;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    const Fill& mat = hit.fill;
    const glm::dvec3 n(hit.normal);
    const glm::dvec3 v = -glm::dvec3(hit.ray_direction);
    const glm::dvec3 p(hit.position);
    glm::dvec3 sum(0.0);
    for (int i = static_cast<int>(lights.size()) - 1; i >= 0; --i) {
        const glm::dvec3 intensity(lights[i].color);
        const glm::dvec3 l = glm::normalize(glm::dvec3(lights[i].position) - p);
        const double nDotL = glm::dot(n, l);
        if (nDotL > 0.0) {
            const glm::dvec3 r = 2.0 * nDotL * n - l;
            const double rDotV = std::max(glm::dot(r, v), 0.0);
            sum += double(mat.kd) * nDotL * glm::dvec3(mat.color) * intensity;
            sum += double(mat.ks) * std::pow(rDotV, double(mat.shine)) * intensity;
        }
    }
    return Color(sum);
}

}  // namespace raysteps
