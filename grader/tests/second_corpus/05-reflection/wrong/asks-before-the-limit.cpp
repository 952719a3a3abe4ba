#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    return Ray{hit.position + k_bounce_threshold * hit.normal,
               glm::normalize(mirror(hit.ray_direction, hit.normal))};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    const std::optional<HitRecord> hit = tracer.closest_hit(ray);
    if (!hit) {
        return depth == 1 ? tracer.background() : k_black;
    }
    if (depth > tracer.max_ray_depth()) {
        return k_black;
    }
    Color color = tracer.direct_lighting(*hit, depth);
    if (hit->fill.ks > 0.0F) {
        color += hit->fill.ks * tracer.trace(reflected_ray(*hit), depth + 1);
    }
    return color;
}

}  // namespace raysteps
