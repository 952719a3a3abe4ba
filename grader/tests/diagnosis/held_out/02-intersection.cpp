// Moeller-Trumbore for the triangle, the school formula for the sphere, a loop with an index.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 e1 = b_ - a_;
    const glm::vec3 e2 = c_ - a_;
    const glm::vec3 p = glm::cross(ray.direction, e2);
    const float det = glm::dot(e1, p);
    if (det == 0.0f) return {};
    const float inv = 1.0f / det;
    const glm::vec3 s = ray.origin - a_;
    const float u = glm::dot(s, p) * inv;
    if (u < 0.0f || u > 1.0f) return {};
    const glm::vec3 q = glm::cross(s, e1);
    const float v = glm::dot(ray.direction, q) * inv;
    if (v < 0.0f || u + v > 1.0f) return {};
    const float t = glm::dot(e2, q) * inv;
    if (t <= 0.0f) return {};
    HitRecord rec;
    rec.distance = t;
    rec.position = ray.origin + t * ray.direction;
    rec.normal = glm::normalize(glm::cross(e1, e2));
    rec.front_face = glm::dot(rec.normal, ray.direction) < 0;
    if (!rec.front_face) rec.normal = -rec.normal;
    rec.ray_direction = ray.direction;
    rec.fill = fill();
    return rec;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::dvec3 d(ray.direction);
    const glm::dvec3 oc = glm::dvec3(ray.origin) - glm::dvec3(center_);
    const double a = glm::dot(d, d);
    const double b = 2.0 * glm::dot(oc, d);
    const double c = glm::dot(oc, oc) - double(radius_) * radius_;
    const double disc = b * b - 4 * a * c;
    if (disc < 0) return {};
    double t = (-b - std::sqrt(disc)) / (2 * a);
    if (t <= 0) t = (-b + std::sqrt(disc)) / (2 * a);
    if (t <= 0) return {};
    HitRecord rec;
    rec.distance = float(t);
    rec.position = ray.origin + float(t) * ray.direction;
    rec.normal = glm::normalize(rec.position - center_);
    rec.front_face = c > 0;
    if (!rec.front_face) rec.normal *= -1.0f;
    rec.ray_direction = ray.direction;
    rec.fill = fill();
    return rec;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> best;
    float nearest = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < surfaces.size(); i++) {
        auto hit = surfaces[i]->hit(ray);
        if (!hit) continue;
        if (hit->distance < nearest) {
            nearest = hit->distance;
            best = hit;
        }
    }
    return best;
}

}  // namespace raysteps
