#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace raysteps {

namespace {

// > 0: p is to the left of the way from one point to the other
double side(glm::dvec2 from, glm::dvec2 to, glm::dvec2 p) {
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
}

// leaves out one coordinate
glm::dvec2 flatten(const glm::dvec3& v, int without) {
    if (without == 0) return {v.y, v.z};
    if (without == 1) return {v.x, v.z};
    return {v.x, v.y};
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::dvec3 a(a_), b(b_), c(c_), o(ray.origin), d(ray.direction);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double slope = glm::dot(n, d);
    if (slope == 0.0) return std::nullopt;
    const double t = glm::dot(n, a - o) / slope;
    if (t < 1e-4) return std::nullopt;
    const glm::dvec3 p = o + t * d;

    // Look along the axis that is closest to the normal: there the triangle is widest.
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        if (std::abs(n[k]) > std::abs(n[axis])) axis = k;
    }
    const auto a2 = flatten(a, axis), b2 = flatten(b, axis), c2 = flatten(c, axis), p2 = flatten(p, axis);
    const double s1 = side(a2, b2, p2);
    const double s2 = side(b2, c2, p2);
    const double s3 = side(c2, a2, p2);
    const bool has_left = s1 > 0.0 || s2 > 0.0 || s3 > 0.0;
    const bool has_right = s1 < 0.0 || s2 < 0.0 || s3 < 0.0;
    if (has_left && has_right) return std::nullopt;

    HitRecord hit;
    hit.distance = float(t);
    hit.position = glm::vec3(p);
    hit.ray_direction = ray.direction;
    hit.fill = fill();
    const glm::vec3 own(n / glm::length(n));
    hit.front_face = glm::dot(own, ray.direction) < 0.0F;
    hit.normal = hit.front_face ? own : -own;
    return hit;
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    // In the sphere's own space it has radius 1 and stands at 0.
    const double r = radius_;
    const glm::dvec3 d(ray.direction);
    const glm::dvec3 o = (glm::dvec3(ray.origin) - glm::dvec3(center_)) / r;
    const double a = glm::dot(d, d);
    const double b = glm::dot(o, d);
    const glm::dvec3 nearest = o - (b / a) * d;
    const double rest = 1.0 - glm::dot(nearest, nearest);
    if (rest < 0.0) return std::nullopt;
    const double half = std::sqrt(rest / a);
    double t = r * (-b / a - half);
    if (t < 1e-4) t = r * (-b / a + half);
    if (t < 1e-4) return std::nullopt;

    HitRecord hit;
    hit.distance = float(t);
    hit.position = glm::vec3(glm::dvec3(ray.origin) + t * d);
    hit.ray_direction = ray.direction;
    hit.fill = fill();
    const glm::vec3 own(glm::normalize(o + (t / r) * d));
    hit.front_face = glm::dot(own, ray.direction) < 0.0F;
    hit.normal = hit.front_face ? own : -own;
    return hit;
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> nearest = std::nullopt;
    auto nearer = [&nearest](const HitRecord& hit) { return !nearest || hit.distance < nearest->distance; };
    for (auto it = surfaces.begin(); it != surfaces.end(); ++it) {
        auto hit = (*it)->hit(ray);
        if (hit.has_value() && nearer(hit.value())) nearest = hit;
    }
    return nearest;
}

}  // namespace raysteps
