// Moeller and Trumbore in doubles; the sphere by its nearest point, in doubles.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace raysteps {

namespace {

HitRecord record_at(const Ray& ray, double t, const glm::dvec3& own_normal, const Fill& fill) {
    const bool front = glm::dot(own_normal, glm::dvec3(ray.direction)) <= 0.0;
    HitRecord r;
    r.position = glm::vec3(glm::dvec3(ray.origin) + t * glm::dvec3(ray.direction));
    r.fill = fill;
    r.normal = glm::vec3(front ? own_normal : -own_normal);
    r.ray_direction = ray.direction;
    r.distance = static_cast<float>(t);
    r.front_face = front;
    return r;
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::dvec3 a(a_), d(ray.direction), o(ray.origin);
    const glm::dvec3 ab = glm::dvec3(b_) - a;
    const glm::dvec3 ac = glm::dvec3(c_) - a;
    const glm::dvec3 p = glm::cross(d, ac);
    const double det = glm::dot(ab, p);
    if (det == 0.0) {
        return std::nullopt;
    }
    const glm::dvec3 s = o - a;
    const double v = glm::dot(s, p) / det;
    const glm::dvec3 q = glm::cross(s, ab);
    const double w = glm::dot(d, q) / det;
    if (v < 0.0 || w < 0.0 || v + w > 1.0) {
        return std::nullopt;
    }
    const double t = glm::dot(ac, q) / det;
    if (!(static_cast<float>(t) > 0.0F)) {
        return std::nullopt;
    }
    return record_at(ray, t, glm::normalize(glm::cross(ab, ac)), fill());
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::dvec3 d = ray.direction;
    const glm::dvec3 to_center = glm::dvec3(center_) - glm::dvec3(ray.origin);
    const double middle = glm::dot(to_center, d);
    const glm::dvec3 off = to_center - middle * d;
    const double radius = radius_;
    const double half_chord_squared = radius * radius - glm::dot(off, off);
    if (half_chord_squared < 0.0) {
        return std::nullopt;
    }
    const double half_chord = std::sqrt(half_chord_squared);
    for (const double t : {middle - half_chord, middle + half_chord}) {
        if (static_cast<float>(t) > 0.0F) {
            const glm::dvec3 p = glm::dvec3(ray.origin) + t * d;
            return record_at(ray, t, glm::normalize(p - glm::dvec3(center_)), fill());
        }
    }
    return std::nullopt;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> nearest;
    for (const Surface* const surface : surfaces) {
        if (auto hit = surface->hit(ray); hit && (!nearest || hit->distance < nearest->distance)) {
            nearest = std::move(hit);
        }
    }
    return nearest;
}

}  // namespace raysteps
