// Asks the functions that put the others together, so that how they do it is told nowhere.
#include "inspect/shading_terms.hpp"

#include <glm/geometric.hpp>
#include <span>

#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps {
namespace {

/// What shade says when the fill lacks one of its shares.
Color shade_without(float Fill::* share, HitRecord hit, const Light& light) {
    hit.fill.*share = 0.0F;
    return shade(hit, std::span(&light, 1));
}

}  // namespace

void ask_light(const HitRecord& hit, const Light& light, LightRecord& record) {
    record.to_light = glm::normalize(light.position - hit.position);
    record.mirrored = -mirror(record.to_light, hit.normal);
    record.l_n = glm::dot(hit.normal, record.to_light);
    record.r_v = -glm::dot(hit.ray_direction, record.mirrored);
    record.diffuse = shade_without(&Fill::ks, hit, light);
    record.specular = shade_without(&Fill::kd, hit, light);
}

std::optional<glm::vec3> ask_refracted(const HitRecord& hit) {
    const glm::vec3 onwards = transmitted_ray(hit).direction;
    return glm::dot(onwards, hit.normal) < 0.0F ? std::optional(onwards) : std::nullopt;
}

}  // namespace raysteps
