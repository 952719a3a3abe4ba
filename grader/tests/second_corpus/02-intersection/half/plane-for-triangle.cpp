#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 n = glm::normalize(glm::cross(b_ - a_, c_ - a_));
    const float slope = glm::dot(n, ray.direction);
    if (slope == 0.0F) {
        return std::nullopt;
    }
    const float t = glm::dot(n, a_ - ray.origin) / slope;
    if (t <= 0.0F) {
        return std::nullopt;
    }
    // still to do: is it inside?
    HitRecord record;
    record.position = point_at(ray, t);
    record.fill = fill();
    record.normal = n;
    record.ray_direction = ray.direction;
    record.distance = t;
    return record;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::vec3 m = ray.origin - center_;
    const float b = glm::dot(m, ray.direction);
    const glm::vec3 h = m - b * ray.direction;
    const float d2 = radius_ * radius_ - glm::dot(h, h);
    if (d2 < 0.0F) {
        return std::nullopt;
    }
    const float near = -b - std::sqrt(d2);
    const float far = -b + std::sqrt(d2);
    const float t = near > 0.0F ? near : far;
    if (t <= 0.0F) {
        return std::nullopt;
    }
    HitRecord record;
    record.position = point_at(ray, t);
    record.fill = fill();
    record.normal = glm::normalize(record.position - center_);
    record.ray_direction = ray.direction;
    record.distance = t;
    return record;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    float nearest = std::numeric_limits<float>::infinity();
    std::optional<HitRecord> result = std::nullopt;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const auto hit = surfaces[i]->hit(ray);
        if (hit.has_value() && hit->distance < nearest) {
            nearest = hit->distance;
            result = hit;
        }
    }
    return result;
}

}  // namespace raysteps
