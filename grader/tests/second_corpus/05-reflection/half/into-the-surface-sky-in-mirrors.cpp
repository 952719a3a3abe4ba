#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    Ray r;
    r.direction = mirror(hit.ray_direction, hit.normal);
    // step back a bit so that we do not hit the same surface again
    r.origin = hit.position - hit.normal * k_bounce_threshold;
    return r;
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    if (depth >= tracer.max_ray_depth()) return k_black;

    std::optional<HitRecord> hit = tracer.closest_hit(ray);
    if (!hit) return tracer.background();

    Color c = tracer.direct_lighting(*hit, depth);
    if (hit->fill.ks > 0.0F) {
        c += hit->fill.ks * trace(tracer, reflected_ray(*hit), depth + 1);
    }
    return c;
}

}  // namespace raysteps
