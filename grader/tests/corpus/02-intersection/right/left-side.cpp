// The quadratic as in the handout's first formula, b * b - q.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

static bool inner(glm::vec3 from, glm::vec3 to, glm::vec3 p, glm::vec3 n) {
    return glm::dot(n, glm::cross(to - from, p - from)) >= 0.0f;
}

static HitRecord finish(const Ray& ray, float t, const Fill& fill, glm::vec3 normal) {
    HitRecord r;
    r.position = point_at(ray, t);
    r.fill = fill;
    r.ray_direction = ray.direction;
    r.distance = t;
    r.front_face = glm::dot(normal, r.ray_direction) < 0;
    r.normal = r.front_face ? normal : -1.0f * normal;
    return r;
}

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    glm::vec3 n = glm::cross(b_ - a_, c_ - a_);
    float below = glm::dot(n, ray.direction);
    if (below != 0) {
        float t = glm::dot(n, a_ - ray.origin) / below;
        if (t > 0) {
            glm::vec3 p = point_at(ray, t);
            if (inner(a_, b_, p, n) && inner(b_, c_, p, n) && inner(c_, a_, p, n)) {
                return finish(ray, t, fill(), glm::normalize(n));
            }
        }
    }
    return std::nullopt;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    glm::vec3 m = ray.origin - center_;
    float b = glm::dot(m, ray.direction);
    float q = glm::dot(m, m) - radius_ * radius_;
    float disc = b * b - q;
    if (disc >= 0) {
        float t_near = -b - std::sqrt(disc);
        float t_far = -b + std::sqrt(disc);
        float t = t_near > 0 ? t_near : t_far;
        if (t > 0) {
            return finish(ray, t, fill(), glm::normalize(point_at(ray, t) - center_));
        }
    }
    return std::nullopt;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    if (surfaces.empty()) return std::nullopt;
    std::optional<HitRecord> best = surfaces.front()->hit(ray);
    for (std::size_t i = 1; i < surfaces.size(); ++i) {
        std::optional<HitRecord> other = surfaces[i]->hit(ray);
        if (!other) continue;
        if (!best || other->distance < best->distance) best = other;
    }
    return best;
}

}  // namespace raysteps
