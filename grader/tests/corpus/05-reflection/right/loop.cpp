#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    const glm::vec3 v = -hit.ray_direction;  // towards the eye
    const glm::vec3 r = 2.0F * glm::dot(hit.normal, v) * hit.normal - v;
    return Ray{hit.position + k_bounce_threshold * hit.normal, glm::normalize(r)};
}

// No recursion: the handout says that a loop gives the same picture.
Color trace(Tracer& tracer, const Ray& first, int depth) {
    Color sum = k_black;
    float weight = 1.0F;
    Ray ray = first;
    const int limit = tracer.max_ray_depth();
    for (int level = depth; level <= limit; ++level) {
        const std::optional<HitRecord> hit = tracer.closest_hit(ray);
        if (!hit) {
            if (level == 1) {
                sum += weight * tracer.background();
            }
            break;
        }
        sum += weight * tracer.direct_lighting(*hit, level);
        if (hit->fill.ks <= 0.0F) {
            break;
        }
        weight *= hit->fill.ks;
        ray = reflected_ray(*hit);
    }
    return sum;
}

}  // namespace raysteps
