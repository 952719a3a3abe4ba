#include "steps/04-shadows/shadows.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/glm.hpp>

namespace raysteps {

using glm::vec3;
using point3 = glm::vec3;

Ray shadow_ray(const HitRecord& rec, const Light& light) {
    const point3 p = rec.position + 0.002f * rec.normal;
    const vec3 to_light = light.position - p;
    return Ray{.origin = p, .direction = to_light / std::sqrt(glm::dot(to_light, to_light))};
}

bool is_lit(const SceneQuery& world, const HitRecord& rec, const Light& light) {
    const Ray r = shadow_ray(rec, light);
    const vec3 to_light = light.position - r.origin;
    const auto in_the_way = world.closest_hit(r);
    // squares, to save a root
    const bool shadowed = in_the_way && in_the_way->distance * in_the_way->distance < glm::dot(to_light, to_light);
    return !shadowed;
}

}  // namespace raysteps
