// The function calls itself and not the renderer's way to it; the cases are told apart one by one, and the light of a
// mirror is mixed from two colours at the end. The ray starts along its own direction.
#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    const glm::vec3 direction = glm::normalize(glm::reflect(hit.ray_direction, hit.normal));
    // Far enough along the ray to be the threshold above the surface, but never far away from the hit.
    const float cosine = glm::max(glm::dot(direction, hit.normal), 0.2F);
    return {hit.position + (k_bounce_threshold / cosine) * direction, direction};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    const int deepest = tracer.max_ray_depth();
    if (depth > deepest) {
        return k_black;
    }
    const std::optional<HitRecord> hit = tracer.closest_hit(ray);
    if (!hit && depth == 1) {
        return tracer.background();
    }
    if (!hit) {
        return k_black;
    }
    const Color own = tracer.direct_lighting(*hit, depth);
    if (hit->fill.ks <= 0.0F || depth == deepest) {
        return own;
    }
    const Color mirrored = trace(tracer, reflected_ray(*hit), depth + 1);
    return own + mirrored * hit->fill.ks;
}

}  // namespace raysteps
