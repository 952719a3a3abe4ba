// A recursive helper carries the weight down with it and adds to one sum, and asks before each bounce whether the
// next ray would still be followed. The ray starts two thresholds off the surface.
#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>

namespace raysteps {
namespace {

void gather(Tracer& tracer, const Ray& ray, int depth, float weight, Color& sum) {
    const std::optional<HitRecord> hit = tracer.closest_hit(ray);
    if (!hit) {
        sum += depth == 1 ? weight * tracer.background() : k_black;
        return;
    }
    sum += weight * tracer.direct_lighting(*hit, depth);
    const bool may_go_on = depth + 1 <= tracer.max_ray_depth();
    if (hit->fill.ks > 0.0F && may_go_on) {
        gather(tracer, reflected_ray(*hit), depth + 1, weight * hit->fill.ks, sum);
    }
}

}  // namespace

Ray reflected_ray(const HitRecord& hit) {
    const float cosine = -glm::dot(hit.ray_direction, hit.normal);
    const glm::vec3 leaving = hit.ray_direction + 2.0F * cosine * hit.normal;
    return {hit.position + 2.0F * k_bounce_threshold * hit.normal, leaving / glm::length(leaving)};
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    Color sum = k_black;
    if (depth <= tracer.max_ray_depth()) {
        gather(tracer, ray, depth, 1.0F, sum);
    }
    return sum;
}

}  // namespace raysteps
