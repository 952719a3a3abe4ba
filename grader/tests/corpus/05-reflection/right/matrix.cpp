#include "steps/05-reflection/reflection.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raysteps {

// Linear algebra: a mirror is the Householder matrix I - 2 n n^T.
static glm::mat3 householder(const glm::vec3& n) { return glm::mat3(1.0F) - 2.0F * glm::outerProduct(n, n); }

Ray reflected_ray(const HitRecord& hit) {
    const glm::vec3 out = householder(hit.normal) * hit.ray_direction;
    const glm::vec3 start = hit.position + hit.normal * 0.003F;
    return Ray{start, glm::normalize(out)};
}

static Color mirrored(Tracer& tracer, const HitRecord& hit, int depth) {
    if (!(hit.fill.ks > 0.0F)) return k_black;
    const Ray next = reflected_ray(hit);
    return hit.fill.ks * tracer.trace(next, depth + 1);
}

static Color missed(const Tracer& tracer, int depth) {
    switch (depth) {
        case 1: return tracer.background();
        default: return k_black;
    }
}

Color trace(Tracer& tracer, const Ray& ray, int depth) {
    if (tracer.max_ray_depth() < depth) return k_black;
    const auto hit = tracer.closest_hit(ray);
    return hit ? mirrored(tracer, *hit, depth) + tracer.direct_lighting(*hit, depth) : missed(tracer, depth);
}

}  // namespace raysteps
