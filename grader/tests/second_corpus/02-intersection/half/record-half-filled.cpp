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
    // a t^2 + b t + c = 0
    float a = glm::dot(ray.direction, ray.direction);
    float b = 2 * glm::dot(ray.direction, ray.origin - center_);
    float c = glm::dot(ray.origin - center_, ray.origin - center_) - radius_ * radius_;
    float disc = b * b - 4 * a * c;

    HitRecord record;
    if (disc < 0) {
        return std::nullopt;
    }
    float t1 = (-b - std::sqrt(disc)) / (2 * a);
    float t2 = (-b + std::sqrt(disc)) / (2 * a);
    if (t1 > 0) {
        record.distance = t1;
    } else if (t2 > 0) {
        record.distance = t2;
    } else {
        return std::nullopt;
    }
    record.position = point_at(ray, record.distance);
    // TODO normal, fill, front face
    return record;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> closest = std::nullopt;
    for (const Surface* surface : surfaces) {
        std::optional<HitRecord> hit = surface->hit(ray);
        if (!hit) {
            continue;
        }
        if (!closest || closest->distance > hit->distance) {
            closest = hit;
        }
    }
    return closest;
}

}  // namespace raysteps
