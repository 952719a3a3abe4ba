// The origin is lifted by a tenth of the threshold only, and what the ray still meets within the threshold is taken
// for the surface itself: the search goes on behind it, for as long as the light is not reached.
#include "steps/04-shadows/shadows.hpp"

#include <glm/geometric.hpp>

namespace raysteps {
namespace {

constexpr float k_lift = 0.1F * k_shadow_threshold;
constexpr int k_max_steps = 8;

}  // namespace

Ray shadow_ray(const HitRecord& hit, const Light& light) {
    const glm::vec3 origin = hit.position + k_lift * hit.normal;
    const glm::vec3 way = light.position - origin;
    return {origin, way / glm::length(way)};
}

bool is_lit(const SceneQuery& scene, const HitRecord& hit, const Light& light) {
    if (glm::dot(light.position - hit.position, hit.normal) <= 0.0F) {
        return false;  // the surface has its back to the light
    }
    Ray ray = shadow_ray(hit, light);
    float walked = 0.0F;
    float left = glm::distance(ray.origin, light.position);
    for (int step = 0; step < k_max_steps; ++step) {
        const std::optional<HitRecord> blocker = scene.closest_hit(ray);
        if (!blocker || blocker->distance >= left) {
            return true;
        }
        walked += blocker->distance;
        if (walked > k_shadow_threshold) {
            return false;
        }
        left -= blocker->distance;
        ray.origin = blocker->position + k_lift * ray.direction;
    }
    return false;
}

}  // namespace raysteps
