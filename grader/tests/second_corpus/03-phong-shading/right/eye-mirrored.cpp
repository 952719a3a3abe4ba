// The eye is mirrored in place of the light: r . v is the same number. All in doubles, channel by channel.
#include "steps/03-phong-shading/phong_shading.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

double dot64(const glm::vec3& a, const glm::vec3& b) { return glm::dot(glm::dvec3(a), glm::dvec3(b)); }

}  // namespace

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    const glm::vec3 along_normal = glm::dot(direction, normal) * normal;
    const glm::vec3 along_floor = direction - along_normal;
    return along_floor - along_normal;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    const double cosine = dot64(normal, to_light);
    Color result = k_black;
    if (cosine > 0.0) {
        for (int channel = 0; channel < 3; ++channel) {
            result[channel] = static_cast<float>(double(fill.kd) * cosine * double(fill.color[channel]) *
                                                 double(light.color[channel]));
        }
    }
    return result;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    const double nl = dot64(normal, to_light);
    if (nl <= 0.0) return k_black;
    const double nv = dot64(normal, to_eye);
    const double lv = dot64(to_light, to_eye);
    double rv = 2.0 * nl * nv - lv;
    if (rv < 0.0) rv = 0.0;
    const double weight = double(fill.ks) * std::pow(rv, double(fill.shine));
    return glm::vec3(weight * glm::dvec3(light.color));
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    Color dull = k_black;
    Color shiny = k_black;
    const glm::vec3 v = -hit.ray_direction;
    for (std::size_t i = lights.size(); i-- > 0;) {
        const glm::vec3 way = lights[i].position - hit.position;
        const glm::vec3 l = way / glm::length(way);
        dull += diffuse(hit.fill, lights[i], hit.normal, l);
        shiny += specular(hit.fill, lights[i], hit.normal, l, v);
    }
    return dull + shiny;
}

}  // namespace raysteps
