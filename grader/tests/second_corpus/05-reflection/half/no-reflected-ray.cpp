#include "steps/05-reflection/reflection.hpp"

#include "core/unfinished.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    // TODO: Mirror the direction that arrived, and start a little off the surface.
    RAYSTEPS_TODO("05-reflection", "reflected_ray");
    return Ray{hit.position, hit.normal};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    if (depth > tracer.max_ray_depth())
        return k_black;

    std::optional<HitRecord> hit = tracer.closest_hit(ray);

    if (!hit.has_value()) {
        if (depth == 1) {
            return tracer.background();
        } else {
            return k_black;
        }
    }

    Color color = tracer.direct_lighting(hit.value(), depth);
    if (hit->fill.ks > 0.0f) {
        Ray bounce = reflected_ray(hit.value());
        color += hit->fill.ks * tracer.trace(bounce, depth + 1);
    }
    return color;
}

}  // namespace raysteps
