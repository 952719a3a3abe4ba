#include "steps/05-reflection/reflection.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    // BEGIN SOLUTION reflected_ray
    // TODO: Mirror the direction that arrived, and start a little off the surface.
    // RETURN Ray{hit.position, hit.normal}
    const glm::vec3 direction = mirror(hit.ray_direction, hit.normal);
    return {hit.position + k_bounce_threshold * hit.normal, glm::normalize(direction)};
    // END SOLUTION
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    // BEGIN SOLUTION trace
    // TODO: Stop at the depth limit, deal with a miss, and add the mirrored colour to the light of the hit itself.
    // RETURN k_black
    if (depth > tracer.max_ray_depth()) {
        return k_black;
    }
    const std::optional<HitRecord> hit = tracer.closest_hit(ray);
    if (!hit) {
        return depth == 1 ? tracer.background() : k_black;
    }
    Color color = tracer.direct_lighting(*hit, depth);
    if (hit->fill.ks > 0.0F) {
        color += hit->fill.ks * tracer.trace(reflected_ray(*hit), depth + 1);
    }
    return color;
    // END SOLUTION
}

}  // namespace raysteps
