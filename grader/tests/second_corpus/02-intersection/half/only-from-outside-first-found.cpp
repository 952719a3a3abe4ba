#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

// Moeller-Trumbore
std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    glm::vec3 e1 = b_ - a_;
    glm::vec3 e2 = c_ - a_;
    glm::vec3 p = glm::cross(ray.direction, e2);
    float det = glm::dot(e1, p);
    if (det == 0.0f) return std::nullopt;

    glm::vec3 s = ray.origin - a_;
    float u = glm::dot(s, p) / det;
    if (u < 0.0f || u > 1.0f) return std::nullopt;

    glm::vec3 q = glm::cross(s, e1);
    float v = glm::dot(ray.direction, q) / det;
    if (v < 0.0f || u + v > 1.0f) return std::nullopt;

    float t = glm::dot(e2, q) / det;
    if (!(t > 0.0f)) return std::nullopt;

    HitRecord rec;
    rec.distance = t;
    rec.position = ray.origin + t * ray.direction;
    rec.fill = fill();
    rec.ray_direction = ray.direction;
    rec.normal = glm::normalize(glm::cross(e1, e2));
    rec.front_face = det > 0.0f;
    if (!rec.front_face) rec.normal = -rec.normal;
    return rec;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    glm::vec3 m = ray.origin - center_;
    float b = glm::dot(m, ray.direction);
    float q = glm::dot(m, m) - radius_ * radius_;
    float disc = b * b - q;
    if (disc < 0.0f) return std::nullopt;

    float t = -b - std::sqrt(disc);
    if (t <= 0.0f) return std::nullopt;   // sphere is behind us

    HitRecord rec;
    rec.distance = t;
    rec.position = ray.origin + t * ray.direction;
    rec.fill = fill();
    rec.ray_direction = ray.direction;
    rec.normal = (rec.position - center_) / radius_;
    return rec;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    for (const Surface* s : surfaces) {
        auto h = s->hit(ray);
        if (h) return h;
    }
    return std::nullopt;
}

}  // namespace raysteps
