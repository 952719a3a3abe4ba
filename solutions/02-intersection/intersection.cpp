#include "steps/02-intersection/intersection.hpp"

#include "core/unfinished.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace raysteps {

// BEGIN SOLUTION
namespace {

HitRecord record_hit(const Surface& surface, const Ray& ray, float distance, const glm::vec3& position,
                     const glm::vec3& outward) {
    const bool front_face = glm::dot(outward, ray.direction) < 0.0F;
    return {position, surface.fill(), front_face ? outward : -outward, ray.direction, distance, front_face};
}

}  // namespace
// END SOLUTION

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    // BEGIN SOLUTION Triangle::intersect
    // TODO: Meet the triangle's plane, then keep the point only if it is on the inner side of all three edges.
    // RETURN std::nullopt
    const glm::vec3 to_b = b_ - a_;
    const glm::vec3 to_c = c_ - a_;
    const glm::vec3 plane_normal = glm::cross(to_b, to_c);
    const float approach = glm::dot(plane_normal, ray.direction);
    if (approach == 0.0F) {
        return std::nullopt;  // the ray runs along the plane
    }
    const float distance = glm::dot(plane_normal, a_ - ray.origin) / approach;
    if (!(distance > 0.0F)) {
        return std::nullopt;
    }
    const glm::vec3 point = point_at(ray, distance);
    // Above 0 on the inner side of an edge: the area between edge and point, times that of the triangle, both of them
    // doubled. The three add up to the square of the latter.
    const glm::vec3 to_point = point - a_;
    const float inside_ca = glm::dot(glm::cross(to_point, to_c), plane_normal);
    const float inside_ab = glm::dot(glm::cross(to_b, to_point), plane_normal);
    const float whole = glm::dot(plane_normal, plane_normal);
    const float inside_bc = whole - inside_ca - inside_ab;
    if (!(inside_ca >= 0.0F && inside_ab >= 0.0F && inside_bc >= 0.0F)) {
        return std::nullopt;
    }
    return record_hit(*this, ray, distance, point, glm::normalize(plane_normal));
    // END SOLUTION
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    // BEGIN SOLUTION Sphere::intersect
    // TODO: Solve for the distances at which the ray meets the sphere, and take the nearer one that is above 0.
    // RETURN std::nullopt
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
    const float distance = nearer > 0.0F ? nearer : to_closest + half_chord;
    if (!(distance > 0.0F)) {
        return std::nullopt;
    }
    const glm::vec3 point = point_at(ray, distance);
    return record_hit(*this, ray, distance, point, glm::normalize(point - center_));
    // END SOLUTION
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    // BEGIN SOLUTION closest_hit
    // TODO: Ask every surface and keep the hit with the smallest distance.
    // RETURN std::nullopt
    std::optional<HitRecord> closest;
    for (const Surface* surface : surfaces) {
        const std::optional<HitRecord> hit = surface->hit(ray);
        if (hit && (!closest || hit->distance < closest->distance)) {
            closest = hit;
        }
    }
    return closest;
    // END SOLUTION
}

}  // namespace raysteps
