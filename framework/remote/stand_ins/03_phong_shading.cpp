#include "remote/functions.hpp"
#include "steps/03-phong-shading/phong_shading.hpp"

namespace raysteps {

using remote::ask;
using remote::FunctionId;

[[maybe_unused]] static const bool asked = remote::stand_in(FunctionId::mirror);

glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    return ask<&mirror>(FunctionId::mirror, direction, normal);
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    return ask<&diffuse>(FunctionId::diffuse, fill, light, normal, to_light);
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    return ask<&specular>(FunctionId::specular, fill, light, normal, to_light, to_eye);
}

Color shade(const HitRecord& hit, std::span<const Light> lights) { return ask<&shade>(FunctionId::shade, hit, lights); }

}  // namespace raysteps
