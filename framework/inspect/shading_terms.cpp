#include "inspect/shading_terms.hpp"

#include <glm/geometric.hpp>

#include "steps/03-phong-shading/phong_shading.hpp"
#include "steps/08-refraction/refraction.hpp"

namespace raysteps {

void ask_light(const HitRecord& hit, const Light& light, LightRecord& record) {
    record.to_light = glm::normalize(light.position - hit.position);
    record.mirrored = mirror(-record.to_light, hit.normal);
    record.l_n = glm::dot(record.to_light, hit.normal);
    record.r_v = glm::dot(record.mirrored, -hit.ray_direction);
    record.diffuse = diffuse(hit.fill, light, hit.normal, record.to_light);
    record.specular = specular(hit.fill, light, hit.normal, record.to_light, -hit.ray_direction);
}

std::optional<glm::vec3> ask_refracted(const HitRecord& hit) {
    const float index = hit.fill.index_of_refraction > 0.0F ? hit.fill.index_of_refraction : 1.0F;
    return refract(hit.ray_direction, hit.normal, hit.front_face ? 1.0F / index : index);
}

}  // namespace raysteps
