#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    return {hit.position + hit.normal * k_bounce_threshold, glm::normalize(mirror(hit.ray_direction, hit.normal))};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    const int limit = tracer.max_ray_depth();
    if (depth > limit) {
        return k_black;
    }

    const std::optional<HitRecord> found = tracer.closest_hit(ray);
    if (!found.has_value()) {
        if (depth > 1) {
            return k_black;
        }
        return tracer.background();
    }

    const HitRecord& hit = *found;
    Color total = tracer.direct_lighting(hit, depth);
    const bool shiny = hit.fill.ks > 0.0F;
    const bool last = depth == limit;  // what comes after is black anyway: no need to ask
    if (shiny && !last) {
        const Color mirrored = tracer.trace(reflected_ray(hit), depth + 1);
        for (int i = 0; i < 3; ++i) {
            total[i] += hit.fill.ks * mirrored[i];
        }
    }
    return total;
}

}  // namespace raysteps
