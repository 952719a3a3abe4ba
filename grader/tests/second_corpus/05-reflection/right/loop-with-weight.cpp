// No recursion: the product of all ks so far weighs what the next hit adds.
#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    constexpr float off = 0.0002F;
    const glm::vec3 direction = glm::reflect(hit.ray_direction, hit.normal);
    return Ray{hit.position + off * hit.normal, glm::normalize(direction)};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    Color sum = k_black;
    float weight = 1.0F;
    Ray next = ray;
    for (int level = depth; level <= tracer.max_ray_depth(); ++level) {
        const std::optional<HitRecord> hit = tracer.closest_hit(next);
        if (!hit) {
            if (level == 1) {
                sum = tracer.background();
            }
            break;
        }
        sum += weight * tracer.direct_lighting(*hit, level);
        if (!(hit->fill.ks > 0.0F)) {
            break;
        }
        weight *= hit->fill.ks;
        next = reflected_ray(*hit);
    }
    return sum;
}

}  // namespace raysteps
