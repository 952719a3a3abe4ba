// Each ray is moved into coordinates in which the question is easy: for the triangle the inverse of the matrix of its
// edges and the ray gives all three unknowns at once; the sphere becomes one of radius 1 about the origin.
#include "steps/02-intersection/intersection.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raysteps {

std::optional<HitRecord> Triangle::intersect(const Ray& ray) const {
    // origin + t direction = a + u (b - a) + v (c - a)
    const glm::mat3 unknowns(b_ - a_, c_ - a_, -ray.direction);
    if (glm::determinant(unknowns) == 0.0F) {
        return std::nullopt;
    }
    const glm::vec3 solution = glm::inverse(unknowns) * (ray.origin - a_);
    const float u = solution.x;
    const float v = solution.y;
    const float t = solution.z;
    const bool inside = u >= 0.0F && v >= 0.0F && u + v <= 1.0F;
    if (!inside || t <= 0.0F) {
        return std::nullopt;
    }
    const glm::vec3 own_normal = glm::normalize(glm::cross(b_ - a_, c_ - a_));
    const bool faces_ray = glm::dot(own_normal, ray.direction) < 0.0F;
    return HitRecord{point_at(ray, t), fill(), faces_ray ? own_normal : -own_normal, ray.direction, t, faces_ray};
}

std::optional<HitRecord> Sphere::intersect(const Ray& ray) const {
    const glm::vec3 origin = (ray.origin - center_) / radius_;
    const float to_closest = -glm::dot(origin, ray.direction);
    const float passed_at = glm::length(origin + to_closest * ray.direction);
    if (passed_at > 1.0F) {
        return std::nullopt;
    }
    const float half_chord = std::sqrt((1.0F - passed_at) * (1.0F + passed_at));
    const float enter = to_closest - half_chord;
    const float leave = to_closest + half_chord;
    const float t = enter > 0.0F ? enter : leave;
    if (!(t > 0.0F)) {
        return std::nullopt;
    }
    const glm::vec3 outward = glm::normalize(origin + t * ray.direction);
    const bool entering = enter > 0.0F;
    const float distance = t * radius_;
    return HitRecord{point_at(ray, distance), fill(), entering ? outward : -outward, ray.direction, distance, entering};
}

std::optional<HitRecord> closest_hit(const SurfaceList& surfaces, const Ray& ray) {
    HitRecord closest;
    bool found = false;
    for (const Surface* surface : surfaces) {
        if (const auto hit = surface->hit(ray); hit && (!found || closest.distance > hit->distance)) {
            closest = *hit;
            found = true;
        }
    }
    if (found) {
        return closest;
    }
    return std::nullopt;
}

}  // namespace raysteps
