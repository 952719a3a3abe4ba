// Barycentric coordinates from dot products, all in double; validates what it gets.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace raysteps {

namespace {

using D3 = glm::dvec3;

bool usable(const Ray& ray) {
    const float length = glm::length(ray.direction);
    return std::isfinite(length) && length > 0.0F && std::isfinite(glm::length(ray.origin));
}

HitRecord record_of(const Surface& surface, const Ray& ray, double t, D3 own_normal) {
    own_normal = glm::normalize(own_normal);
    const glm::vec3 n(own_normal);
    HitRecord r;
    r.position = glm::vec3(D3(ray.origin) + t * D3(ray.direction));
    r.fill = surface.fill();
    r.ray_direction = ray.direction;
    r.distance = static_cast<float>(t);
    if (glm::dot(n, ray.direction) < 0.0F) {
        r.normal = n;
        r.front_face = true;
    } else {
        r.normal = -n;
        r.front_face = false;
    }
    return r;
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    if (!usable(ray)) {
        return std::nullopt;
    }
    const D3 v0 = D3(b_) - D3(a_);
    const D3 v1 = D3(c_) - D3(a_);
    const D3 n = glm::cross(v0, v1);
    const double nd = glm::dot(n, D3(ray.direction));
    if (nd == 0.0) {
        return std::nullopt;  // in the plane or beside it, or no triangle at all
    }
    const double t = glm::dot(n, D3(a_) - D3(ray.origin)) / nd;
    if (!(t > 5e-6)) {
        return std::nullopt;
    }
    const D3 v2 = D3(ray.origin) + t * D3(ray.direction) - D3(a_);
    // areas of the three parts, with sign, in units of |n|^2
    const double whole = glm::dot(n, n);
    const double part_c = glm::dot(glm::cross(v0, v2), n);
    const double part_b = glm::dot(glm::cross(v2, v1), n);
    const double part_a = whole - part_b - part_c;
    if (part_a < 0.0 || part_b < 0.0 || part_c < 0.0) {
        return std::nullopt;
    }
    return record_of(*this, ray, t, n);
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    if (!usable(ray) || !(radius_ > 0.0F)) {
        return std::nullopt;
    }
    const D3 d(ray.direction);
    const D3 m = D3(ray.origin) - D3(center_);
    const double r2 = double(radius_) * double(radius_);
    const double a = glm::dot(d, d);
    const double b = 2.0 * glm::dot(m, d);
    const double c = glm::dot(m, m) - r2;
    const double disc = b * b - 4.0 * a * c;
    if (disc < 0.0) {
        return std::nullopt;
    }
    const double t1 = (-b + std::sqrt(disc)) / (2.0 * a);
    const double t2 = (-b - std::sqrt(disc)) / (2.0 * a);
    double t = std::numeric_limits<double>::infinity();
    if (t1 > 5e-6 && t1 < t) t = t1;
    if (t2 > 5e-6 && t2 < t) t = t2;
    if (std::isinf(t)) {
        return std::nullopt;
    }
    return record_of(*this, ray, t, m + t * d);
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> result;
    float limit = std::numeric_limits<float>::max();
    for (const Surface* surface : surfaces) {
        if (surface == nullptr) {
            continue;
        }
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (!hit || hit->distance >= limit) {
            continue;
        }
        limit = hit->distance;
        result = hit;
    }
    return result;
}

}  // namespace raysteps
