#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 ab = b_ - a_;
    const glm::vec3 ac = c_ - a_;
    glm::vec3 normal = glm::normalize(glm::cross(ab, ac));
    const glm::vec3 p = glm::cross(ray.direction, ac);
    const float det = glm::dot(ab, p);
    if (det == 0.0F) return std::nullopt;
    const glm::vec3 s = ray.origin - a_;
    const float u = glm::dot(s, p) / det;
    const glm::vec3 q = glm::cross(s, ab);
    const float v = glm::dot(ray.direction, q) / det;
    const float t = glm::dot(ac, q) / det;
    if (u < 0.0F || v < 0.0F || u + v > 1.0F || t <= 0.0F) return std::nullopt;

    HitRecord hit;
    hit.position = point_at(ray, t);
    hit.fill = fill();
    if (glm::dot(normal, ray.direction) > 0.0F) {
        normal = -normal;
    }
    hit.normal = normal;
    hit.front_face = glm::dot(normal, ray.direction) <= 0.0F;
    hit.ray_direction = ray.direction;
    hit.distance = t;
    return hit;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::vec3 m = ray.origin - center_;
    const float b = glm::dot(m, ray.direction);
    const glm::vec3 h = m - b * ray.direction;
    const float rest = radius_ * radius_ - glm::dot(h, h);
    if (rest < 0.0F) return std::nullopt;
    const float near = -b - std::sqrt(rest);
    const float far = -b + std::sqrt(rest);
    if (far <= 0.0F) return std::nullopt;

    HitRecord hit;
    hit.distance = near > 0.0F ? near : far;
    hit.position = point_at(ray, hit.distance);
    hit.fill = fill();
    hit.ray_direction = ray.direction;
    hit.normal = glm::normalize(hit.position - center_);
    hit.front_face = glm::dot(hit.normal, ray.direction) <= 0.0F;
    if (!hit.front_face) hit.normal = -hit.normal;
    return hit;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> closest;
    for (const Surface* surface : surfaces) {
        const auto hit = surface->hit(ray);
        if (!hit) continue;
        if (!closest || hit->distance < closest->distance) closest = hit;
    }
    return closest;
}

}  // namespace raysteps
