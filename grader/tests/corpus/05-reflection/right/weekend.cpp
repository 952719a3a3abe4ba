// after "Ray Tracing in One Weekend"
#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

using vec3 = glm::vec3;
using color = Color;

static vec3 unit_vector(const vec3& v) { return v / glm::length(v); }

static vec3 bounce_off(const vec3& v, const vec3& n) { return v - 2.0F * glm::dot(v, n) * n; }

Ray reflected_ray(const HitRecord& rec) {
    const vec3 direction = unit_vector(bounce_off(rec.ray_direction, rec.normal));
    return Ray{rec.position + 0.0002F * rec.normal, direction};  // a little off, 0.01 would be the most
}

color trace(Tracer& world, const Ray& r, int depth) {
    // If we've exceeded the ray bounce limit, no more light is gathered.
    if (depth > world.max_ray_depth()) return color(0, 0, 0);

    if (auto rec = world.closest_hit(r)) {
        color attenuated(0, 0, 0);
        if (rec->fill.ks > 0)  // scatter
            attenuated = rec->fill.ks * world.trace(reflected_ray(*rec), depth + 1);
        return attenuated + world.direct_lighting(*rec, depth);
    }

    if (depth != 1) return color(0, 0, 0);
    return world.background();
}

}  // namespace raysteps
