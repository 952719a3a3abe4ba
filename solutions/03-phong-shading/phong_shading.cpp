#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    // BEGIN SOLUTION mirror
    // TODO: Turn round the part of the direction that runs along the normal, and keep the rest.
    // RETURN glm::vec3(0.0F)
    return direction - 2.0F * glm::dot(direction, normal) * normal;
    // END SOLUTION
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    // BEGIN SOLUTION diffuse
    // TODO: Weigh the product of the two colours with kd and the cosine between normal and light.
    // RETURN k_black
    const float cosine = std::max(glm::dot(to_light, normal), 0.0F);
    return fill.kd * cosine * fill.color * light.color;
    // END SOLUTION
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    // BEGIN SOLUTION specular
    // TODO: Mirror the light's direction of travel, and raise its cosine with the eye to the power of shine.
    // RETURN k_black
    if (glm::dot(to_light, normal) <= 0.0F) {
        return k_black;  // the light is behind the surface
    }
    const glm::vec3 reflected = mirror(-to_light, normal);
    const float cosine = std::max(glm::dot(reflected, to_eye), 0.0F);
    return fill.ks * std::pow(cosine, fill.shine) * light.color;
    // END SOLUTION
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    // BEGIN SOLUTION shade
    // TODO: Add up diffuse and specular light over all the lights.
    // RETURN k_black
    Color sum = k_black;
    for (const Light& light : lights) {
        const glm::vec3 to_light = glm::normalize(light.position - hit.position);
        sum += diffuse(hit.fill, light, hit.normal, to_light);
        sum += specular(hit.fill, light, hit.normal, to_light, -hit.ray_direction);
    }
    return sum;
    // END SOLUTION
}

}  // namespace raysteps
