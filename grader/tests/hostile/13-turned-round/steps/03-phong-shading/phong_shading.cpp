#include "steps/03-phong-shading/phong_shading.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>
#include <initializer_list>

namespace raysteps {

// One light whose rays come along to_light, whatever the hit's place.
static Color shade_one(Fill fill, bool highlight, const Light& light, const glm::vec3& normal,
                       const glm::vec3& to_light, const glm::vec3& to_eye) {
    (highlight ? fill.kd : fill.ks) = 0.0F;
    HitRecord hit;
    hit.fill = fill;
    hit.normal = normal;
    hit.ray_direction = -to_eye;
    const Light there[] = {{4.0F * to_light, light.color}};
    return shade(hit, there);
}

Color diffuse(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light) {
    return shade_one(fill, false, light, normal, to_light, normal);
}

Color specular(const Fill& fill, const Light& light, const glm::vec3& normal, const glm::vec3& to_light,
               const glm::vec3& to_eye) {
    return shade_one(fill, true, light, normal, to_light, to_eye);
}

// A highlight of shine 1 is the cosine between the mirrored light and the eye: seen along each axis, it is a
// coordinate.
glm::vec3 mirror(const glm::vec3& direction, const glm::vec3& normal) {
    const float size = glm::length(direction);
    const float side = glm::dot(direction, normal) > 0.0F ? -1.0F : 1.0F;
    glm::vec3 mirrored(0.0F);
    for (int axis = 0; size > 0.0F && axis < 3; ++axis) {
        for (const float sign : {1.0F, -1.0F}) {
            glm::vec3 eye(0.0F);
            eye[axis] = sign;
            const Fill polished{.kd = 0.0F, .ks = 1.0F, .shine = 1.0F};
            const Color seen = specular(polished, Light{}, normal, -side / size * direction, eye);
            mirrored[axis] = seen.r > 0.0F ? sign * seen.r : mirrored[axis];
        }
    }
    return side * size * mirrored;
}

Color shade(const HitRecord& /*hit*/, std::span<const Light> /*lights*/) {
    RAYSTEPS_TODO("03-phong-shading", "shade");
    return k_black;
}

}  // namespace raysteps
