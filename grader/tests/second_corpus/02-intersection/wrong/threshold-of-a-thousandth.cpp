#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

constexpr float k_epsilon = 1e-3F;  // against self-intersection

HitRecord make_record(const Ray& ray, float distance, const glm::vec3& normal, const Fill& fill) {
    HitRecord record;
    record.position = point_at(ray, distance);
    record.fill = fill;
    record.ray_direction = ray.direction;
    record.distance = distance;
    record.front_face = glm::dot(normal, ray.direction) < 0.0F;
    record.normal = record.front_face ? normal : -normal;
    return record;
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 n = glm::cross(b_ - a_, c_ - a_);
    const float denominator = glm::dot(n, ray.direction);
    if (denominator == 0.0F) {
        return std::nullopt;
    }
    const float t = glm::dot(n, a_ - ray.origin) / denominator;
    if (t < k_epsilon) {
        return std::nullopt;
    }
    const glm::vec3 p = point_at(ray, t);
    if (glm::dot(glm::cross(b_ - a_, p - a_), n) < 0.0F || glm::dot(glm::cross(c_ - b_, p - b_), n) < 0.0F ||
        glm::dot(glm::cross(a_ - c_, p - c_), n) < 0.0F) {
        return std::nullopt;
    }
    return make_record(ray, t, glm::normalize(n), fill());
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::vec3 m = ray.origin - center_;
    const float b = glm::dot(m, ray.direction);
    const glm::vec3 h = m - b * ray.direction;
    const float square = radius_ * radius_ - glm::dot(h, h);
    if (square < 0.0F) {
        return std::nullopt;
    }
    const float root = std::sqrt(square);
    float t = -b - root;
    if (t < k_epsilon) {
        t = -b + root;
        if (t < k_epsilon) {
            return std::nullopt;
        }
    }
    return make_record(ray, t, glm::normalize(point_at(ray, t) - center_), fill());
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> closest;
    for (const Surface* surface : surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && (!closest || hit->distance < closest->distance)) {
            closest = hit;
        }
    }
    return closest;
}

}  // namespace raysteps
