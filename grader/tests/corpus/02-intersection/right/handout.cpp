#include "steps/02-intersection/intersection.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 n = glm::cross(b_ - a_, c_ - a_);
    const float nd = glm::dot(n, ray.direction);
    if (nd == 0.0F) {
        return std::nullopt;
    }
    const float t = glm::dot(n, a_ - ray.origin) / nd;
    if (t <= 0.0F) {
        return std::nullopt;
    }
    const glm::vec3 p = point_at(ray, t);
    if (glm::dot(glm::cross(b_ - a_, p - a_), n) < 0.0F) {
        return std::nullopt;
    }
    if (glm::dot(glm::cross(c_ - b_, p - b_), n) < 0.0F) {
        return std::nullopt;
    }
    if (glm::dot(glm::cross(a_ - c_, p - c_), n) < 0.0F) {
        return std::nullopt;
    }
    HitRecord record;
    record.position = p;
    record.fill = fill();
    record.normal = glm::normalize(n);
    record.ray_direction = ray.direction;
    record.distance = t;
    record.front_face = nd < 0.0F;
    if (!record.front_face) {
        record.normal = -record.normal;
    }
    return record;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::vec3 m = ray.origin - center_;
    const float b = glm::dot(m, ray.direction);
    const glm::vec3 h = m - b * ray.direction;
    const float under_root = radius_ * radius_ - glm::dot(h, h);
    if (under_root < 0.0F) {
        return std::nullopt;
    }
    const float root = std::sqrt(under_root);
    float t = -b - root;
    if (t <= 0.0F) {
        t = -b + root;
    }
    if (t <= 0.0F) {
        return std::nullopt;
    }
    HitRecord record;
    record.position = point_at(ray, t);
    record.fill = fill();
    record.normal = glm::normalize(record.position - center_);
    record.ray_direction = ray.direction;
    record.distance = t;
    record.front_face = true;
    if (glm::dot(record.normal, ray.direction) >= 0.0F) {
        record.normal = -record.normal;
        record.front_face = false;
    }
    return record;
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
