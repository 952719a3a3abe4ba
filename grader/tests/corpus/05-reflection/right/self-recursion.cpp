#include "steps/05-reflection/reflection.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    glm::vec3 n = hit.normal;
    const float length = glm::length(n);
    if (length > 0.0F) {
        n /= length;  // in case somebody hands us one that is not quite unit
    }
    const float along = glm::dot(hit.ray_direction, n);
    glm::vec3 d = hit.ray_direction - along * n;  // the part along the surface ...
    d -= along * n;                               // ... and the other part turned round
    return Ray{hit.position + n * 1e-4F, d / std::sqrt(glm::dot(d, d))};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    if (depth > tracer.max_ray_depth()) return k_black;
    const auto hit = tracer.closest_hit(ray);
    if (!hit && depth == 1) return tracer.background();
    if (!hit) return k_black;
    const Color local = tracer.direct_lighting(*hit, depth);
    if (hit->fill.ks <= 0.0F) return local;
    return local + hit->fill.ks * trace(tracer, reflected_ray(*hit), depth + 1);
}

}  // namespace raysteps
