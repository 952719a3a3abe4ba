#include "steps/02-intersection/intersection.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    // TODO: Meet the triangle's plane, then keep the point only if it is on the inner side of all three edges.
    RAYSTEPS_TODO("02-intersection", "Triangle::intersect");
    return std::nullopt;
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
    record.front_face = glm::dot(record.normal, ray.direction) < 0.0F;
    if (!record.front_face) {
        record.normal = -record.normal;
    }
    return record;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> best;
    for (const Surface* surface : surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && (!best || hit->distance < best->distance)) {
            best = hit;
        }
    }
    return best;
}

}  // namespace raysteps
