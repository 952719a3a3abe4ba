// A loop that follows the chain of mirrors and keeps the weight, instead of a recursion.
#include "steps/05-reflection/reflection.hpp"

#include "steps/03-phong-shading/phong_shading.hpp"

#include <glm/glm.hpp>

namespace raysteps {

Ray reflected_ray(const HitRecord& hit) {
    const glm::vec3 d = hit.ray_direction;
    const glm::vec3 n = hit.normal;
    const float along = glm::dot(d, n);
    Ray out;
    out.direction = glm::normalize(d - n * along - n * along);
    out.origin = hit.position + n * k_bounce_threshold;
    return out;
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    Color sum(0.0f);
    float weight = 1.0f;
    Ray now = ray;
    for (int d = depth; d <= tracer.max_ray_depth(); d++) {
        auto hit = tracer.closest_hit(now);
        if (!hit) {
            if (d == 1) sum += tracer.background();
            break;
        }
        sum += weight * tracer.direct_lighting(*hit, d);
        if (hit->fill.ks <= 0) break;
        weight *= hit->fill.ks;
        now = reflected_ray(*hit);
    }
    return sum;
}

}  // namespace raysteps
