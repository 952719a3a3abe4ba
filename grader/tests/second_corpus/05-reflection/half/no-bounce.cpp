#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    return Ray{hit.position + k_bounce_threshold * hit.normal, mirror(hit.ray_direction, hit.normal)};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    if (depth > tracer.max_ray_depth()) {
        return k_black;
    }
    const auto hit = tracer.closest_hit(ray);
    if (!hit) {
        return depth == 1 ? tracer.background() : k_black;
    }
    // local light first, mirror comes later
    return tracer.direct_lighting(*hit, depth);
}

}  // namespace raysteps
