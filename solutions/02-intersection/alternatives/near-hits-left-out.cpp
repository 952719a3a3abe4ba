// Hits nearer than 0.0001 are left out, and planes that are almost met edge-on.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

namespace {

/// Whether the point, which lies in the plane, is on the inner side of the edge.
bool on_inner_side(const glm::vec3& start, const glm::vec3& end, const glm::vec3& plane_normal,
                   const glm::vec3& point) {
    return glm::dot(glm::cross(end - start, point - start), plane_normal) >= 0.0F;
}

HitRecord record_hit(const Surface& surface, const Ray& ray, float distance, const glm::vec3& position,
                     const glm::vec3& outward) {
    const bool front_face = glm::dot(outward, ray.direction) < 0.0F;
    return {position, surface.fill(), front_face ? outward : -outward, ray.direction, distance, front_face};
}

}  // namespace

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    const glm::vec3 plane_normal = glm::cross(b_ - a_, c_ - a_);
    const float approach = glm::dot(plane_normal, ray.direction);
    if (std::abs(approach) < 1e-8F) {
        return std::nullopt;  // the ray runs along the plane
    }
    const float distance = glm::dot(plane_normal, a_ - ray.origin) / approach;
    if (!(distance > 1e-4F)) {
        return std::nullopt;
    }
    const glm::vec3 point = point_at(ray, distance);
    const bool inside = on_inner_side(a_, b_, plane_normal, point) && on_inner_side(b_, c_, plane_normal, point) &&
                        on_inner_side(c_, a_, plane_normal, point);
    if (!inside) {
        return std::nullopt;
    }
    return record_hit(*this, ray, distance, point, glm::normalize(plane_normal));
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::vec3 from_center = ray.origin - center_;
    const float to_closest = -glm::dot(from_center, ray.direction);
    const glm::vec3 closest = from_center + to_closest * ray.direction;
    // Measured at the closest point, where the numbers are small: b^2 - q would lose its digits far away.
    const float half_chord_squared = radius_ * radius_ - glm::dot(closest, closest);
    if (half_chord_squared < 0.0F) {
        return std::nullopt;
    }
    const float half_chord = std::sqrt(half_chord_squared);
    const float nearer = to_closest - half_chord;
    const float distance = nearer > 1e-4F ? nearer : to_closest + half_chord;
    if (!(distance > 1e-4F)) {
        return std::nullopt;
    }
    const glm::vec3 point = point_at(ray, distance);
    return record_hit(*this, ray, distance, point, glm::normalize(point - center_));
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    std::optional<HitRecord> closest;
    for (const Surface* surface : surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && (!closest || hit->distance < closest->distance)) {
            closest = hit;
        }
    }
    return closest;
}

}  // namespace raysteps
