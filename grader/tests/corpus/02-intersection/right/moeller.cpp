// Moeller and Trumbore; the sphere by the quadratic formula in double, with a not taken for 1.
#include "steps/02-intersection/intersection.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

HitRecord make_record(const Ray& ray, float t, const glm::vec3& outward, const Fill& fill) {
    HitRecord rec;
    rec.distance = t;
    rec.position = ray.origin + t * ray.direction;
    rec.ray_direction = ray.direction;
    rec.fill = fill;
    rec.front_face = glm::dot(outward, ray.direction) < 0.0F;
    rec.normal = rec.front_face ? outward : -outward;
    return rec;
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 edge1 = b_ - a_;
    const glm::vec3 edge2 = c_ - a_;
    const glm::vec3 pvec = glm::cross(ray.direction, edge2);
    const float det = glm::dot(edge1, pvec);
    if (det == 0.0F) return std::nullopt;

    const glm::vec3 tvec = ray.origin - a_;
    const float u = glm::dot(tvec, pvec) / det;
    if (u < 0.0F || u > 1.0F) return std::nullopt;

    const glm::vec3 qvec = glm::cross(tvec, edge1);
    const float v = glm::dot(ray.direction, qvec) / det;
    if (v < 0.0F || u + v > 1.0F) return std::nullopt;

    const float t = glm::dot(edge2, qvec) / det;
    if (!(t > 0.0F)) return std::nullopt;
    return make_record(ray, t, glm::normalize(glm::cross(edge1, edge2)), fill());
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::dvec3 oc = glm::dvec3(ray.origin) - glm::dvec3(center_);
    const glm::dvec3 d(ray.direction);
    const double a = glm::dot(d, d);
    const double half_b = glm::dot(oc, d);
    const double c = glm::dot(oc, oc) - double(radius_) * double(radius_);
    const double discriminant = half_b * half_b - a * c;
    if (discriminant < 0.0) return std::nullopt;
    const double sqrtd = std::sqrt(discriminant);

    constexpr double t_min = 1e-6;
    double root = (-half_b - sqrtd) / a;
    if (root <= t_min) {
        root = (-half_b + sqrtd) / a;
        if (root <= t_min) return std::nullopt;
    }
    const glm::vec3 outward(glm::normalize(oc + root * d));
    return make_record(ray, float(root), outward, fill());
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    HitRecord rec;
    bool hit_anything = false;
    float closest_so_far = INFINITY;
    for (const auto* object : surfaces) {
        const auto temp = object->hit(ray);
        if (temp && temp->distance < closest_so_far) {
            hit_anything = true;
            closest_so_far = temp->distance;
            rec = *temp;
        }
    }
    if (!hit_anything) return std::nullopt;
    return rec;
}

}  // namespace raysteps
