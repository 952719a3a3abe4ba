#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    // TODO: Turn round the part of the direction that runs along the normal, and keep the rest.
    RAYSTEPS_TODO("03-phong-shading", "mirror");
    return glm::vec3(0.0F);
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    // TODO: Weigh the product of the two colours with kd and the cosine between normal and light.
    RAYSTEPS_TODO("03-phong-shading", "diffuse");
    return k_black;
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    // TODO: Mirror the light's direction of travel, and raise its cosine with the eye to the power of shine.
    RAYSTEPS_TODO("03-phong-shading", "specular");
    return k_black;
}

Color shade(const HitRecord& hit, std::span<const Light> lights) {
    // TODO: Add up diffuse and specular light over all the lights.
    RAYSTEPS_TODO("03-phong-shading", "shade");
    return k_black;
}

}  // namespace raysteps
