// No recursion: a loop follows the ray from mirror to mirror and keeps the product of the weights on the way.
#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    Ray ray;
    ray.direction = glm::normalize(mirror(hit.ray_direction, hit.normal));
    ray.origin = hit.position + hit.normal * k_bounce_threshold;
    return ray;
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    Color sum = k_black;
    float weight = 1.0F;
    Ray current = ray;
    for (int bounce = depth; bounce <= tracer.max_ray_depth(); ++bounce) {
        const std::optional<HitRecord> hit = tracer.closest_hit(current);
        if (!hit) {
            if (bounce == 1) {
                sum += weight * tracer.background();
            }
            break;
        }
        sum += weight * tracer.direct_lighting(*hit, bounce);
        if (!(hit->fill.ks > 0.0F)) {
            break;
        }
        weight *= hit->fill.ks;
        current = reflected_ray(*hit);
    }
    return sum;
}

}  // namespace raysteps
