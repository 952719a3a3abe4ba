// All sums and products in double precision, rounded to float at the end of each function.
#include "steps/03-phong-shading/phong_shading.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace raysteps {
namespace {

using Vec = glm::dvec3;

Vec mirror_exactly(const Vec& direction, const Vec& normal) {
    return direction - 2.0 * glm::dot(normal, direction) * normal;
}

Vec diffuse_exactly(const Fill& fill, const Light& light, const Vec& normal, const Vec& to_light) {
    const double cosine = std::max(0.0, glm::dot(normal, to_light));
    return Vec(light.color) * Vec(fill.color) * (static_cast<double>(fill.kd) * cosine);
}

Vec specular_exactly(const Fill& fill, const Light& light, const Vec& normal, const Vec& to_light, const Vec& to_eye) {
    if (glm::dot(normal, to_light) <= 0.0) {
        return Vec(0.0);
    }
    const double cosine = glm::dot(mirror_exactly(-to_light, normal), to_eye);
    const double highlight = std::pow(std::max(cosine, 0.0), static_cast<double>(fill.shine));
    return Vec(light.color) * (static_cast<double>(fill.ks) * highlight);
}

}  // namespace

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    return glm::vec3(mirror_exactly(Vec(direction), Vec(normal)));
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    return Color(diffuse_exactly(fill, light, Vec(normal), Vec(to_light)));
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    return Color(specular_exactly(fill, light, Vec(normal), Vec(to_light), Vec(to_eye)));
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    const Vec normal(hit.normal);
    const Vec to_eye = -Vec(hit.ray_direction);
    const auto add_light = [&](const Vec& sum, const Light& light) {
        const Vec to_light = glm::normalize(Vec(light.position) - Vec(hit.position));
        return sum + diffuse_exactly(hit.fill, light, normal, to_light) +
               specular_exactly(hit.fill, light, normal, to_light, to_eye);
    };
    return Color(std::accumulate(lights.begin(), lights.end(), Vec(0.0), add_light));
}

}  // namespace raysteps
