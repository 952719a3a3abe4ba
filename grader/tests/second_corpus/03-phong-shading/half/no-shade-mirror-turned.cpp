#include "steps/03-phong-shading/phong_shading.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal)
{
    // both arrows start at the hit
    return 2.0f * glm::dot(direction, normal) * normal - direction;
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light)
{
    const float cosine = glm::dot(normal, to_light);
    return cosine > 0.0f ? fill.kd * cosine * fill.color * light.color : k_black;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye)
{
    if (glm::dot(normal, to_light) <= 0.0f)
        return k_black;
    const glm::vec3 r = mirror(to_light, normal);
    const float cosine = std::max(glm::dot(r, to_eye), 0.0f);
    return light.color * (fill.ks * std::pow(cosine, fill.shine));
}

Color shade(const HitRecord& hit, std::span<const Light> lights)
{
    // call diffuse and specular here
    return k_black;
}

}  // namespace raysteps
