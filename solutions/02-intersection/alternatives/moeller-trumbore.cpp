// The triangle by Moeller and Trumbore (1997), without the plane; the sphere by the full quadratic equation
// a t^2 + b t + c = 0, with the root that does not cancel first and the other one by Vieta.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace raysteps {
namespace {

HitRecord make_record(const Ray& ray, float distance, const Fill& fill, const glm::vec3& outward) {
    HitRecord record;
    record.distance = distance;
    record.position = ray.origin + distance * ray.direction;
    record.fill = fill;
    record.ray_direction = ray.direction;
    record.front_face = glm::dot(ray.direction, outward) < 0.0F;
    record.normal = record.front_face ? outward : -outward;
    return record;
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 edge_b = b_ - a_;
    const glm::vec3 edge_c = c_ - a_;
    const glm::vec3 p = glm::cross(ray.direction, edge_c);
    const float determinant = glm::dot(edge_b, p);
    if (determinant == 0.0F) {
        return std::nullopt;
    }
    const float inverse = 1.0F / determinant;
    const glm::vec3 from_a = ray.origin - a_;
    const float u = glm::dot(from_a, p) * inverse;
    if (u < 0.0F || u > 1.0F) {
        return std::nullopt;
    }
    const glm::vec3 q = glm::cross(from_a, edge_b);
    const float v = glm::dot(ray.direction, q) * inverse;
    if (v < 0.0F || u + v > 1.0F) {
        return std::nullopt;
    }
    const float distance = glm::dot(edge_c, q) * inverse;
    if (distance <= 0.0F) {
        return std::nullopt;
    }
    return make_record(ray, distance, fill(), glm::normalize(glm::cross(edge_b, edge_c)));
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::vec3 from_center = ray.origin - center_;
    const float a = glm::dot(ray.direction, ray.direction);
    const float b = 2.0F * glm::dot(from_center, ray.direction);
    const float c = glm::dot(from_center, from_center) - radius_ * radius_;
    const float discriminant = b * b - 4.0F * a * c;
    if (discriminant < 0.0F) {
        return std::nullopt;
    }
    const float q = -0.5F * (b + std::copysign(std::sqrt(discriminant), b));
    float near = q / a;
    float far = q == 0.0F ? near : c / q;
    if (near > far) {
        std::swap(near, far);
    }
    const float distance = near > 0.0F ? near : far;
    if (distance <= 0.0F) {
        return std::nullopt;
    }
    const glm::vec3 position = ray.origin + distance * ray.direction;
    return make_record(ray, distance, fill(), (position - center_) / radius_);
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> best;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        std::optional<HitRecord> candidate = surfaces[i]->hit(ray);
        if (!candidate.has_value()) {
            continue;
        }
        if (!best.has_value() || candidate->distance < best->distance) {
            best = std::move(candidate);
        }
    }
    return best;
}

}  // namespace raysteps
